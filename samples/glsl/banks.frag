#version 300 es
// Banks' fibres along the tangent (Kautz & Seidel 2000, section 3.1):
//
//   L_o = k_s (n.l)+ (R((v.t)^2) R((l.t)^2) - (v.t)(l.t))+,   R(s) = sqrt(1 - s)
//
// With `#define APPROXIMATE` R*(s) = 1 - s takes the place of R and of its table.
//
//   unit 0  t_map       _t: t, alpha k_s
//   unit 1  b_map       _b: b (not needed by this model)
//   unit 2  n_map       _n: n
//   unit 3  base_color  SRGB8_ALPHA8; a white texel where there is none
//   unit 4  banks_r     R16F, linear, clamp to edge
//
//   burnish-material --model banks --direction brushed_t.exr --normal brushed_n.png --encode float --extension exr \
//     -o brushed
//   burnish-lut banks-r -o banks_r.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D t_map, b_map, n_map;
uniform vec4 t_scale, t_bias, b_scale, b_bias, n_scale, n_bias;  // true = stored * `burnish:scale` + `burnish:bias`
uniform sampler2D base_color;
#ifndef APPROXIMATE
uniform sampler2D banks_r;
uniform vec4 banks_r_domain;  // `burnish:domain`; 0, 1 of the argument that is not there
#endif

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

// An argument's address in a table of edge sampling, whose first and last texel hold the ends of the domain.
vec2 address(sampler2D table, vec2 x, vec4 domain) {
  vec2 texels = vec2(textureSize(table, 0));
  return ((x - domain.xz) / (domain.yw - domain.xz) * (texels - 1.0) + 0.5) / texels;
}

#ifdef APPROXIMATE
float root(float s) { return 1.0 - s; }
#else
float root(float s) { return texture(banks_r, address(banks_r, vec2(s, 0.0), banks_r_domain)).r; }
#endif

float specular(vec4 t, vec4 b, vec4 n, vec3 l, vec3 v) {
  float vt = dot(v, t.xyz), lt = dot(l, t.xyz);
  return t.a * max(dot(n.xyz, l), 0.0) * max(root(vt * vt) * root(lt * lt) - vt * lt, 0.0);
}

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

void main() {
  vec4 t = texture(t_map, place) * t_scale + t_bias, b = texture(b_map, place) * b_scale + b_bias,
       n = texture(n_map, place) * n_scale + n_bias;
  vec3 base = texture(base_color, place).rgb;
  mat3 local = local_frame();
  vec3 v = towards(viewer) * local, sum = ambient * ambient_color * base;
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local;
    vec3 diffuse = diffuse_color * base * max(dot(n.xyz, l), 0.0);
    sum += light_colors[k] * (diffuse + specular_color * specular(t, b, n, l, v));
  }
  color = vec4(srgb(sum), 1.0);
}
