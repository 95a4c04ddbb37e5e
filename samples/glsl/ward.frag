#version 300 es
// Ward's model (Kautz & Seidel 2000, section 3.3), where light and view are above the surface, h = (l + v) / |l + v|:
//
//   L_o = k_s / (4 pi ax ay) S(p) E(m, d) (n.l)
//   S(p) = 1 / sqrt(p),               p = (l.n)(v.n)
//   E(m, d) = exp(-2 m / (1 + d)),    m = (h.t/ax)^2 + (h.b/ay)^2,   d = h.n
//
//   unit 0  t_map       _t: t/ax
//   unit 1  b_map       _b: b/ay
//   unit 2  n_map       _n: n, alpha k_s / (4 pi ax ay) (by burnish:scale)
//   unit 3  base_color  SRGB8_ALPHA8; a white texel where there is none
//   unit 4  ward_s      R16F, linear, clamp to edge
//   unit 5  ward_e      R16F, linear, clamp to edge; m to the right, d downwards
//
//   burnish-material --model ward --alpha-x 0.15 --alpha-y 0.5 --ks 0.5 --direction brushed_t.exr \
//     --normal brushed_n.png --encode float --extension exr -o brushed
//   burnish-lut ward-s -o ward_s.exr
//   burnish-lut ward-e -o ward_e.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D t_map, b_map, n_map;
uniform vec4 t_scale, t_bias, b_scale, b_bias, n_scale, n_bias;  // true = stored * `burnish:scale` + `burnish:bias`
uniform sampler2D base_color;
uniform sampler2D ward_s, ward_e;
uniform vec4 ward_s_domain, ward_e_domain;  // `burnish:domain`; 0, 1 of an argument that is not there

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
  float lit = dot(n.xyz, l), seen = dot(n.xyz, v);
  if (!(lit > 0.0 && seen > 0.0)) return 0.0;
  vec3 h = normalize(l + v);
  float x = dot(h, t.xyz), y = dot(h, b.xyz);
  float s = texture(ward_s, address(ward_s, vec2(lit * seen, 0.0), ward_s_domain)).r;
  float e = texture(ward_e, address(ward_e, vec2(x * x + y * y, dot(n.xyz, h)), ward_e_domain)).r;
  return n.a * s * e * lit;
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
