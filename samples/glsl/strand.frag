#version 300 es
// Strands, the surface smooth or its directions made orthogonal to the bumps beforehand (Isidoro & Brennan 2002,
// shaders 1 and 2), up to four lights, with a = l.t and b = v.t:
//
//   base k_d sqrt(1 - a^2) + k_s (sqrt(1 - a^2) sqrt(1 - b^2) - a b)+^n
//
//   unit 0  direction_map  RGBA16F of an EXR, or RGB8 of a PNG: t
//   unit 1  base_color     SRGB8_ALPHA8; a white texel where there is none
//   unit 2  strand         RGBA16F, linear, repeat: the diffuse term in rgb, the specular one in alpha
//
//   burnish-tangents flow.png --from flow --normal bumps_n.png -o grooves_t.exr
//   burnish-lut strand --exponent 40 --layout offset-half -o strand.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D direction_map;
uniform vec2 direction_coding;  // scale and bias: (2, -1) of a PNG, (1, 0) of an EXR
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
  vec3 base = texture(base_color, place).rgb;
  mat3 local = local_frame();
  vec3 v = towards(viewer) * local, sum = ambient * ambient_color * base;
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local;
    vec4 lit = texture(strand, 0.5 * vec2(dot(l, t), dot(v, t)));  // the layout adds the other half
    sum += light_colors[k] * (diffuse_color * base * lit.r + specular_color * lit.a);
  }
  color = vec4(srgb(sum), 1.0);
}
