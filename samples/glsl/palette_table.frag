#version 300 es
// Quantized normal map, first of two passes: shades the palette, not the pixels (Tarini et al. 2000, section 5.1).
//
//   f(n) = ambient k_a + sum over lights of color (k_d (n.l)+ + k_s ((r.v)+)^e where n.l > 0),   r = 2 (n.l) n - l
//
// Draw screen.vert into a table of 256 x ceil(N / 256) texels, RGBA16F: texel (i mod 256, i div 256) becomes the colour
// of entry i. Again when light, view or object have moved; once for each material, with its interval (section 6).
// Whatever depends on the normal alone can stand in the place of f: environments, cartoons. With `#define BLENDED` an
// entry is the light reflected on top, and in alpha how bright the diffuse light is, for a base colour between them.
//
//   unit 0  palette  RGB32F, nearest, 256 x ceil(N / 256): x y z of each entry, `burnish:palette` of the KTX2 file
//
//   burnish-quantize rocks_n.png -n 2048 -o rocks_q.exr
//   burnish-mipmap rocks_q.exr --source rocks_n.png -o rocks.ktx2
precision highp float;

uniform sampler2D palette;
uniform ivec2 entries;  // first and count, of `burnish:materials`

// Vectors in the space of the palette, `burnish:space`: of the object, or of the flat surface that the map lies on.
// Unit, towards viewer and lights as they are seen from the object's origin.
uniform vec3 viewer;
uniform int light_count;
uniform vec3 lights[4];
uniform vec3 light_colors[4];
uniform vec3 ambient;
uniform vec3 ambient_color, diffuse_color, specular_color;  // k_a, k_d, k_s
uniform float exponent;

out vec4 color;  // linear

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int i = texel.y * 256 + texel.x;
  if (i < entries.x || i >= entries.x + entries.y) discard;
  vec3 n = texelFetch(palette, texel, 0).xyz;
  vec3 diffuse = ambient * ambient_color, specular = vec3(0);
  for (int k = 0; k < light_count; k++) {
    float lit = dot(n, lights[k]);
    if (lit <= 0.0) continue;
    float shine = max(dot(2.0 * lit * n - lights[k], viewer), 0.0);
    diffuse += light_colors[k] * diffuse_color * lit;
    specular += light_colors[k] * specular_color * (exponent > 0.0 ? pow(shine, exponent) : 1.0);
  }
#ifdef BLENDED
  color = vec4(specular, dot(diffuse, vec3(0.2126, 0.7152, 0.0722)));
#else
  color = vec4(diffuse + specular, 1.0);
#endif
}
