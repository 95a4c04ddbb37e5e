#version 300 es
// Blinn and Phong's model, made anisotropic by longer tangents (Kautz & Seidel 2000, section 3.2), with
// h = (l + v) / |l + v|:
//
//   L_o = k_s F(N, e) where h.n > 0, else 0,   e = (1 - (h.t/ax)^2 - (h.b/ay)^2)+,   F(N, e) = sqrt(e)^N
//
// With `#define EQUATION_1` L_o = k_s e, their equation 1, which needs no table.
//
//   unit 0  t_map          _t: t/ax, alpha k_s
//   unit 1  b_map          _b: b/ay, alpha N/128 (N by burnish:scale)
//   unit 2  n_map          _n: n
//   unit 3  base_color     SRGB8_ALPHA8; a white texel where there is none
//   unit 4  blinn_phong_f  R16F, linear, clamp to edge; N to the right, e downwards
//
//   burnish-material --model blinn-phong --alpha-x 0.3 --alpha-y 0.9 --exponent 12 --direction brushed_t.exr \
//     --normal brushed_n.png --encode float --extension exr -o brushed
//   burnish-lut blinn-phong-f -o blinn_phong_f.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D t_map, b_map, n_map;
uniform vec4 t_scale, t_bias, b_scale, b_bias, n_scale, n_bias;  // true = stored * `burnish:scale` + `burnish:bias`
uniform sampler2D base_color;
#ifndef EQUATION_1
uniform sampler2D blinn_phong_f;
uniform vec4 blinn_phong_f_domain;  // `burnish:domain`
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

float specular(vec4 t, vec4 b, vec4 n, vec3 l, vec3 v) {
  vec3 sum = l + v, h = dot(sum, sum) > 0.0 ? normalize(sum) : sum;
  if (!(dot(n.xyz, h) > 0.0)) return 0.0;
  float x = dot(h, t.xyz), y = dot(h, b.xyz), e = max(1.0 - x * x - y * y, 0.0);
#ifdef EQUATION_1
  return t.a * e;
#else
  return t.a * texture(blinn_phong_f, address(blinn_phong_f, vec2(b.a, e), blinn_phong_f_domain)).r;
#endif
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
