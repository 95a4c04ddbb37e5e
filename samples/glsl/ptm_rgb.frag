#version 300 es
// Polynomial texture map with a polynomial a colour (Malzbender, Gelb & Wolters 2001; Rost, OpenGL Shading Language,
// 14.4.3), u and v being x and y of the direction towards the light in the surface's frame:
//
//   a0 u^2 + a1 v^2 + a2 u v + a3 u + a4 v + a5,   a = (texel - bias) scale
//
//   unit 0 to 2  abc[3]        RGB8: abc_red.png, abc_green.png, abc_blue.png: a0 a1 a2
//   unit 3 to 5  def[3]        RGB8: def_red.png, def_green.png, def_blue.png: a3 a4 a5
//   unit 6       light_factor  RGB16F, linear, clamp to edge: over n.l from -1 to 1; a white texel where there is none
//
//   burnish-ptm fit coin.lp --type rgb -o coin/
//   burnish-lut light-factor -o light_factor.exr
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D abc[3], def[3];
uniform vec3 abc_scale, abc_bias, def_scale, def_bias;  // of ptm.json
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
  vec3 a[3] = vec3[](texture(abc[0], place).rgb, texture(abc[1], place).rgb, texture(abc[2], place).rgb);
  vec3 d[3] = vec3[](texture(def[0], place).rgb, texture(def[1], place).rgb, texture(def[2], place).rgb);
  mat3 local = local_frame();
  vec3 sum = vec3(0);
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]) * local, lit;
    vec3 squares = vec3(l.x * l.x, l.y * l.y, l.x * l.y), lines = vec3(l.xy, 1.0);
    for (int c = 0; c < 3; c++)
      lit[c] = dot((a[c] - abc_bias) * abc_scale, squares) + dot((d[c] - def_bias) * def_scale, lines);
    sum += light_colors[k] * factor(l.z) * linear(lit);
  }
  color = vec4(srgb(sum), 1.0);
}
