#version 300 es
// What all surface shaders here share: where a point is, its tangent frame, and its place in the maps.
//
// Tangent space is right-handed: t along +u, b along +v, n out of the surface. Texture coordinates run to the right and
// up; images are uploaded as they are, row 0 (the top row) first, without UNPACK_FLIP_Y_WEBGL: it lies at place.y = 0.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;  // w: 1, or -1 where texture coordinates are mirrored
layout(location = 3) in vec2 uv;

uniform mat4 model;  // turns, moves, scales alike in all directions
uniform mat4 view_projection;

out vec3 world_point;
out mat3 frame;  // t, b, n in the world
out vec2 place;

void main() {
  vec4 world = model * vec4(position, 1.0);
  mat3 turn = mat3(model);
  vec3 n = turn * normal, t = turn * tangent.xyz;
  world_point = world.xyz;
  frame = mat3(t, cross(n, t) * tangent.w, n);
  place = vec2(uv.x, 1.0 - uv.y);
  gl_Position = view_projection * world;
}
