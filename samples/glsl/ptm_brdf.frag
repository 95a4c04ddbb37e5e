#version 300 es
// BRDF PTM: the reflectance of a homogeneous surface in six small textures (Rost, OpenGL Shading Language, 14.4.2 and
// 14.4.3, its listings), h = (l + v) / |l + v|:
//
//   looked up at (T.h, B.h), u = l.T', v = l.B',   T' = T - (T.h) h normalised, B' = h x T'
//   a0 u^2 + a1 v^2 + a2 u v + a3 u + a4 v + a5,   a = (texel - bias) scale
//
// With `#define LIGHT_VIEW` looked up at (T.v, B.v), u = T.l, v = B.l: `--parameters light-view`.
//
//   unit 0 to 2  abc[3]        RGB8, linear, clamp to edge: abc_red.png, abc_green.png, abc_blue.png: a0 a1 a2
//   unit 3 to 5  def[3]        RGB8, linear, clamp to edge: def_red.png, def_green.png, def_blue.png: a3 a4 a5
//   unit 6       light_factor  RGB16F, linear, clamp to edge: light over n.l from -1 to 1
//
//   burnish-ptm brdf ward:ax=0.2,ay=0.5,ks=1 -o ward/
//   burnish-lut light-factor -o light_factor.exr
precision highp float;

in vec3 world_point;
in mat3 frame;

uniform sampler2D abc[3], def[3];
uniform vec3 abc_scale, abc_bias, def_scale, def_bias;  // of ptm.json
uniform float noise_factor;                             // of ptm.json: keeps lookups off the rim
uniform sampler2D light_factor;

// In the world: (x, y, z, 1) is where it stands, (x, y, z, 0) the direction towards it.
uniform vec4 viewer;
uniform int light_count;
uniform vec4 lights[4];
uniform vec3 light_colors[4];

out vec4 color;

// The surface's frame, orthonormal at this point: `world * local_frame()` is a direction of the world in it.
mat3 local_frame() {
  vec3 n = normalize(frame[2]), t = normalize(frame[0] - n * dot(n, frame[0])), b = cross(n, t);
  return mat3(t, dot(b, frame[1]) < 0.0 ? -b : b, n);
}

vec3 towards(vec4 it) { return normalize(it.xyz - it.w * world_point); }

// What n.l lets through, n being the surface's own normal.
vec3 factor(float cosine) {
  float texels = float(textureSize(light_factor, 0).x);
  return texture(light_factor, vec2((0.5 * (cosine + 1.0) * (texels - 1.0) + 0.5) / texels, 0.5)).rgb;
}

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

// Where the textures are looked up, each from -1 to 1, and u and v behind it.
vec4 coordinates(vec3 l, vec3 v) {
#ifdef LIGHT_VIEW
  return vec4(v.xy, l.xy);
#else
  vec3 h = normalize(l + v), left = vec3(1, 0, 0) - h * h.x;
  if (!(dot(left, left) > 1e-12)) return vec4(h.xy, dot(l, cross(vec3(0, 1, 0), h)), l.y);
  vec3 t = normalize(left);
  return vec4(h.xy, dot(l, t), dot(l, cross(h, t)));
#endif
}

void main() {
  mat3 local = local_frame();
  vec3 v = towards(viewer) * local, sum = vec3(0);
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local, lit;
    if (!(length(l + v) > 1e-6)) continue;
    vec4 at = coordinates(l, v);
    vec2 place = 0.5 * noise_factor * at.xy + 0.5, uv = at.zw;
    vec3 a[3] = vec3[](texture(abc[0], place).rgb, texture(abc[1], place).rgb, texture(abc[2], place).rgb);
    vec3 d[3] = vec3[](texture(def[0], place).rgb, texture(def[1], place).rgb, texture(def[2], place).rgb);
    for (int c = 0; c < 3; c++)
      lit[c] = dot((a[c] - abc_bias) * abc_scale, vec3(uv * uv, uv.x * uv.y)) +
               dot((d[c] - def_bias) * def_scale, vec3(uv, 1.0));
    sum += light_colors[k] * factor(l.z) * max(lit, 0.0);
  }
  color = vec4(srgb(sum), 1.0);
}
