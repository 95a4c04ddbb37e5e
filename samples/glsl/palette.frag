#version 300 es
// Quantized normal map, second of two passes: index -> colour, by the table that palette_table.frag has shaded (Tarini
// et al. 2000, section 5.1). Colours are filtered, never indices: an index between two normals is no normal.
//
// With `#define EXACT` or `#define APPROXIMATE`, and `#define BLENDED` in the first pass, a base colour c is blended
// with the brightness a of the diffuse light and what is reflected on top, s (section 7):
//
//   exact        c a + (1 - c a) s
//   approximate  c a + (1 - c) s
//
//   unit 0  index_map    R8UI or R16UI, nearest: the texels of the KTX2 file, all levels
//   unit 1  color_table  RGBA16F, nearest, 256 x ceil(N / 256): what palette_table.frag made
//   unit 2  base_color   SRGB8_ALPHA8, for blending only
//
//   burnish-quantize rocks_n.png -n 2048 -o rocks_q.exr
//   burnish-mipmap rocks_q.exr --source rocks_n.png -o rocks.ktx2
precision highp float;
precision highp int;

in vec2 place;

uniform highp usampler2D index_map;
uniform sampler2D color_table;
#if defined(EXACT) || defined(APPROXIMATE)
uniform sampler2D base_color;
#endif
uniform bool bilinear;
uniform int levels;  // 1: only the base

out vec4 color;

vec4 color_at(vec2 texel, int level) {
  vec2 size = vec2(textureSize(index_map, level));
  uint i = texelFetch(index_map, ivec2(texel - size * floor(texel / size)), level).r;  // repeats
  return texelFetch(color_table, ivec2(i & 255u, i >> 8), 0);
}

vec4 looked_up(int level) {
  vec2 at = place * vec2(textureSize(index_map, level));
  if (!bilinear) return color_at(floor(at), level);
  vec2 corner = floor(at - 0.5), share = at - 0.5 - corner;
  return mix(mix(color_at(corner, level), color_at(corner + vec2(1, 0), level), share.x),
             mix(color_at(corner + vec2(0, 1), level), color_at(corner + vec2(1, 1), level), share.x), share.y);
}

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

void main() {
  vec2 size = vec2(textureSize(index_map, 0)), right = dFdx(place) * size, down = dFdy(place) * size;
  float lambda = clamp(0.5 * log2(max(max(dot(right, right), dot(down, down)), 1e-12)), 0.0, float(levels - 1));
  int finer = int(lambda);
  vec4 light = looked_up(finer);
  if (lambda > float(finer)) light = mix(light, looked_up(finer + 1), lambda - float(finer));
#ifdef EXACT
  vec3 lit = texture(base_color, place).rgb * light.a;
  light.rgb = lit + (1.0 - lit) * light.rgb;
#endif
#ifdef APPROXIMATE
  vec3 base = texture(base_color, place).rgb;
  light.rgb = base * light.a + (1.0 - base) * light.rgb;
#endif
  color = vec4(srgb(light.rgb), 1.0);
}
