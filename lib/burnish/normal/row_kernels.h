// The arithmetic of rows of normals, for whatever vector unit the machine has.
//
// No result depends on the vector unit: nothing is contracted, and sums run in lanes whose number is fixed. Arrays do
// not overlap.
#pragma once

#include <cstdint>

#include "burnish/core/vec3.h"

namespace burnish::kernels {

// out = factor · (a − b)
void differences(const float* a, const float* b, float factor, int count, float* out);
// out += factor · (a − b)
void add_differences(const float* a, const float* b, float factor, int count, float* out);
// out += factor · in
void add_scaled(const float* in, float factor, int count, float* out);

// Unit vectors, a component an array.
struct Vectors {
  float *x, *y, *z;
};

// n = (−a, −b, 1)/‖·‖ of slopes a = scale_u · u, b = scale_v · v; with l = √(a² + b² + 1), the tangent of half the
// angle between n and z is √(a² + b²)/(1 + l), which is exact near 0 too.
void normals_of_slopes(const float* u, const float* v, float scale_u, float scale_v, int count, Vectors out,
                       float* tangents);

struct Tilts {
  double sum = 0;      // of the angles, in radians; each within 1e-7
  float steepest = 0;  // the largest of the tangents
};
// Of tangents of half angles in [0,1]; NaN where one is.
Tilts tilts(const float* tangents, int count);

// (x, y, z) one after the other.
void interleave(Vectors in, int count, Vec3f* out);

// Components c of [−1, 1] as (½c + ½) · most, y times y_sign: to integers rounded half up.
void encode_biased(const Vec3f* in, int count, float y_sign, std::uint8_t* out);
void encode_biased(const Vec3f* in, int count, float y_sign, std::uint16_t* out);
void encode_biased(const Vec3f* in, int count, float y_sign, float* out);

}  // namespace burnish::kernels
