#version 300 es
// Normal map, not quantized: what palette.frag is held against, at the cost of shading each pixel.
//
//   ambient k_a + sum over lights of color (k_d (n.l)+ + k_s ((r.v)+)^e where n.l > 0),   r = 2 (n.l) n - l
//
//   unit 0  normal_map  RGB8 of a PNG, or RGB16F of an EXR
//
//   burnish-normals rocks.tif -o rocks_n.png --height 10cm --size 2m --wrap repeat
precision highp float;

in vec3 world_point;
in mat3 frame;
in vec2 place;

uniform sampler2D normal_map;
uniform vec2 normal_coding;  // scale and bias: (2, -1) of a PNG, (1, 0) of an EXR
uniform bool object_space;

// In the world: (x, y, z, 1) is where it stands, (x, y, z, 0) the direction towards it.
uniform vec4 viewer;
uniform int light_count;
uniform vec4 lights[4];
uniform vec3 light_colors[4];
uniform vec3 ambient;
uniform vec3 ambient_color, diffuse_color, specular_color;  // k_a, k_d, k_s
uniform float exponent;
uniform mat4 model;

out vec4 color;

vec3 towards(vec4 it) { return normalize(it.xyz - it.w * world_point); }

// Linear light as screens show it (IEC 61966-2-1). Leave it out where the frame buffer is sRGB.
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308))));
}

void main() {
  vec3 stored = normalize(texture(normal_map, place).xyz * normal_coding.x + normal_coding.y);
  vec3 n = normalize(object_space ? mat3(model) * stored : frame * stored);
  vec3 v = towards(viewer), sum = ambient * ambient_color;
  for (int k = 0; k < light_count; k++) {
    vec3 l = towards(lights[k]);
    float lit = dot(n, l);
    if (lit <= 0.0) continue;
    float shine = max(dot(2.0 * lit * n - l, v), 0.0);
    sum += light_colors[k] * (diffuse_color * lit + specular_color * (exponent > 0.0 ? pow(shine, exponent) : 1.0));
  }
  color = vec4(srgb(sum), 1.0);
}
