#include "burnish/normal/row_kernels.h"

#include <cmath>

#include "burnish/core/vector_math.h"

namespace burnish::kernels {
namespace {

constexpr int kLanes = 16;

// 2 · atan of [0,1] to 4e-8 (Abramowitz & Stegun 4.4.49): for the report, where libm's would cost more than the fit.
[[gnu::always_inline]] inline float twice_arc_tangent(float x) {
  const float y = x * x;
  return 2 * x *
         (1 +
          y * (-0.3333314528f +
               y * (0.1999355085f +
                    y * (-0.1420889944f +
                         y * (0.1065626393f + y * (-0.0752896400f +
                                                   y * (0.0429096138f + y * (-0.0161657367f + y * 0.0028662257f))))))));
}

template <typename T>
[[gnu::always_inline]] inline void encode(const Vec3f* __restrict in, int count, float y_sign, float most, float half,
                                          T* __restrict out) {
  const float half_y = 0.5f * y_sign;
  for (int i = 0; i < count; i++) {
    out[3 * i + 0] = static_cast<T>((0.5f * in[i].x + 0.5f) * most + half);
    out[3 * i + 1] = static_cast<T>((half_y * in[i].y + 0.5f) * most + half);
    out[3 * i + 2] = static_cast<T>((0.5f * in[i].z + 0.5f) * most + half);
  }
}

}  // namespace

BURNISH_VECTOR_UNITS void differences(const float* __restrict a, const float* __restrict b, float factor, int count,
                                      float* __restrict out) {
  for (int x = 0; x < count; x++) out[x] = factor * (a[x] - b[x]);
}

BURNISH_VECTOR_UNITS void add_differences(const float* __restrict a, const float* __restrict b, float factor, int count,
                                          float* __restrict out) {
  for (int x = 0; x < count; x++) out[x] += factor * (a[x] - b[x]);
}

BURNISH_VECTOR_UNITS void add_scaled(const float* __restrict in, float factor, int count, float* __restrict out) {
  for (int x = 0; x < count; x++) out[x] += factor * in[x];
}

BURNISH_VECTOR_UNITS void normals_of_slopes(const float* __restrict u, const float* __restrict v, float scale_u,
                                            float scale_v, int count, Vectors out, float* __restrict tangents) {
  float* __restrict x = out.x, * __restrict y = out.y, * __restrict z = out.z;
  for (int i = 0; i < count; i++) {
    const float a = u[i] * scale_u, b = v[i] * scale_v, steepness2 = a * a + b * b;
    const float l = std::sqrt(steepness2 + 1.f), inverse = 1.f / l;
    x[i] = -a * inverse, y[i] = -b * inverse, z[i] = inverse;
    tangents[i] = std::sqrt(steepness2) / (1.f + l);
  }
}

BURNISH_VECTOR_UNITS Tilts tilts(const float* __restrict tangents, int count) {
  float sum[kLanes] = {}, steepest[kLanes] = {};
  const int whole = count / kLanes * kLanes;
  for (int i = 0; i < whole; i += kLanes)
    for (int k = 0; k < kLanes; k++) {
      const float t = tangents[i + k];
      sum[k] += twice_arc_tangent(t);
      steepest[k] = steepest[k] > t ? steepest[k] : t;
    }
  for (int i = whole; i < count; i++) {
    sum[i - whole] += twice_arc_tangent(tangents[i]);
    steepest[i - whole] = steepest[i - whole] > tangents[i] ? steepest[i - whole] : tangents[i];
  }
  Tilts all;
  for (int k = 0; k < kLanes; k++) {
    all.sum += double(sum[k]);
    all.steepest = all.steepest > steepest[k] ? all.steepest : steepest[k];
  }
  return all;
}

BURNISH_VECTOR_UNITS void interleave(Vectors in, int count, Vec3f* __restrict out) {
  const float* __restrict x = in.x, * __restrict y = in.y, * __restrict z = in.z;
  for (int i = 0; i < count; i++) out[i].x = x[i], out[i].y = y[i], out[i].z = z[i];
}

BURNISH_VECTOR_UNITS void encode_biased(const Vec3f* __restrict in, int count, float y_sign,
                                        std::uint8_t* __restrict out) {
  encode(in, count, y_sign, 255.f, 0.5f, out);
}
BURNISH_VECTOR_UNITS void encode_biased(const Vec3f* __restrict in, int count, float y_sign,
                                        std::uint16_t* __restrict out) {
  encode(in, count, y_sign, 65535.f, 0.5f, out);
}
BURNISH_VECTOR_UNITS void encode_biased(const Vec3f* __restrict in, int count, float y_sign, float* __restrict out) {
  encode(in, count, y_sign, 1.f, 0.f, out);
}

}  // namespace burnish::kernels
