#version 300 es
// Strands on a bump map: the direction is made orthogonal to the normal at each pixel (Isidoro & Brennan 2002,
// shader 3), up to four lights, with t = (T - N (T.N)) / |T - N (T.N)|, a = l.t and b = v.t:
//
//   saturate(saturate(base k_d sqrt(1 - a^2)) + gloss k_s (sqrt(1 - a^2) sqrt(1 - b^2) - a b)+^n)
//
//   unit 0  direction_map  RGBA16F of an EXR, or RGB8 of a PNG: T
//   unit 1  normal_map     RGB8 of a PNG, or RGBA16F of an EXR: N
//   unit 2  base_color     SRGB8_ALPHA8, gloss in alpha; a white texel where there is none
//   unit 3  strand         RGBA16F, linear, clamp to edge: the diffuse term in rgb, the specular one in alpha
//
//   burnish-tangents flow.png --from flow -o grooves_t.exr
//   burnish-normals bumps.png -o bumps_n.png --height 5mm --size 1m --wrap repeat
//   burnish-lut strand --exponent 40 --layout cube-z -o strand.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D direction_map, normal_map;
uniform vec2 direction_coding, normal_coding;  // scale and bias: (2, -1) of a PNG, (1, 0) of an EXR
uniform sampler2D base_color;
uniform sampler2D strand;

// In the world: (x, y, z, 1) is where it stands, (x, y, z, 0) the direction towards it.
uniform vec4 viewer;
uniform int light_count;
uniform vec4 lights[4];
uniform vec3 light_colors[4];
uniform vec3 ambient;
uniform vec3 ambient_color, diffuse_color, specular_color;

out vec4 color;

// The surface's frame, orthonormal at this point: `world * local_frame()` is a direction of the world in it.
mat3 local_frame() {
  vec3 n = normalize(frame[2]), t = normalize(frame[0] - n * dot(n, frame[0])), b = cross(n, t);
  return mat3(t, dot(b, frame[1]) < 0.0 ? -b : b, n);
}

vec3 towards(vec4 it) { return normalize(it.xyz - it.w * world_point); }

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

void main() {
  vec3 t = texture(direction_map, place).xyz * direction_coding.x + direction_coding.y;
  vec3 n = normalize(texture(normal_map, place).xyz * normal_coding.x + normal_coding.y);
  vec4 base = texture(base_color, place);
  t -= n * dot(t, n);
  t = dot(t, t) > 0.0 ? normalize(t) : t;
  mat3 local = local_frame();
  vec3 v = towards(viewer) * local, sum = ambient * ambient_color * base.rgb;
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local;
    vec2 at = vec2(dot(l, t), -dot(v, t));  // rows of the cube's face run downwards
    vec4 lit = texture(strand, 0.5 * at + 0.5);
    vec3 diffuse = clamp(diffuse_color * base.rgb * lit.r, 0.0, 1.0);
    sum += light_colors[k] * clamp(diffuse + specular_color * base.a * lit.a, 0.0, 1.0);
  }
  color = vec4(srgb(sum), 1.0);
}
