#version 300 es
// Polynomial texture map with one polynomial and a colour (Malzbender, Gelb & Wolters 2001), u and v being x and y of
// the direction towards the light in the surface's frame:
//
//   rgb (a0 u^2 + a1 v^2 + a2 u v + a3 u + a4 v + a5),   a = (texel - bias) scale
//
//   unit 0  abc           RGB8: a0 a1 a2, the first three bytes of each texel's six in an LRGB .ptm file
//   unit 1  def           RGB8: a3 a4 a5, the other three
//   unit 2  rgb           RGB8: the colours behind them
//   unit 3  light_factor  RGB16F, linear, clamp to edge: light over n.l from -1 to 1; a white texel where there is none
//
// The file's rows run bottom to top: upload its last row first.
//
//   burnish-ptm fit coin.lp -o coin.ptm
//   burnish-lut light-factor -o light_factor.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D abc, def, rgb;
uniform vec3 abc_scale, abc_bias, def_scale, def_bias;  // of the file's head; its biases are 255 times these
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

// Photographs are in sRGB; above 1 its curve goes on.
vec3 linear(vec3 c) {
  c = max(c, 0.0);
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, vec3(lessThanEqual(c, vec3(0.04045))));
}

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

void main() {
  vec3 a = (texture(abc, place).rgb - abc_bias) * abc_scale, d = (texture(def, place).rgb - def_bias) * def_scale;
  vec3 base = texture(rgb, place).rgb;
  mat3 local = local_frame();
  vec3 sum = vec3(0);
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local;
    float lit = dot(a, vec3(l.x * l.x, l.y * l.y, l.x * l.y)) + dot(d, vec3(l.xy, 1.0));
    sum += light_colors[k] * factor(l.z) * linear(base * lit);
  }
  color = vec4(srgb(sum), 1.0);
}
