// The arithmetic of colour tables over many normals at once, for whatever vector unit the machine has.
//
// Directions meet normals in double precision, since a highlight multiplies their error by its exponent; colours are
// single. Results do not depend on the vector unit: there is no contraction, and no sum runs across lanes.
#pragma once

#include <cstddef>
#include <optional>

#include "burnish/core/vec3.h"

namespace burnish::kernels {

// Unit normals, a component an array.
struct Normals {
  const double *x, *y, *z;
};

// out = max(0, n·l)
void lambert(Normals n, Vec3d l, std::size_t count, float* out);

// What is reflected of a light: Lambert's cosine, and the base of the highlight's power with its complement to 1, which
// keeps its digits where the base is near 1.
struct Reflection {
  float *lambert, *base, *complement;
};
// Phong: base = max(0, r·v), r·v = 2 (n·l)(n·v) − l·v; 0 where the light grazes or comes from behind.
void reflect(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out);
// The angle between r and v doubled: base = max(0, 2 (r·v)² − 1), and 0 where r·v ≤ 0.
void reflect_doubled(Normals n, Vec3d l, Vec3d v, std::size_t count, Reflection out);

// A colour for each entry, a channel an array.
struct Colours {
  float *r, *g, *b;
};

// What follows adds to what `out` holds; where there is a start, to that instead, so that no pass is spent on writing
// it.

// out += factor · share
void add(const float* share, float factor, std::optional<float> start, std::size_t count, float* out);
// out += colour · share
void add(const float* share, Vec3f colour, std::optional<Vec3f> start, std::size_t count, Colours out);
// out += diffuse · lambert + specular · base^exponent for bases in [0,1]; the power is within 1.5e-7 of the exact
// value, and 0 for a base of 0. The exponent is above 0.
void add_highlight(const float* lambert, const float* base, const float* complement, Vec3f diffuse, Vec3f specular,
                   float exponent, std::optional<Vec3f> start, std::size_t count, Colours out);

}  // namespace burnish::kernels
