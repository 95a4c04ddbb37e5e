// Register combiners, as far as dot products and their squares need them (NV_register_combiners, NVIDIA OpenGL
// Extension Specifications 1999; Kautz & Seidel, section 4.1).
//
// A register holds sign and eight bits: k/255 for k from −255 to 255. An 8-bit texture or colour i/255 expanded by
// 2c − 1 is one of these. A general combiner forms A·B, C·D and their sum, scales by 1, 2 or 4, clamps to [−1,1] and
// rounds to the nearest value; the final combiner subtracts from one and clamps to [0,1]. The specification leaves the
// precision inside a stage open: here it is exact until the output.
#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/core/vec3.h"

namespace burnish::combiners {

// The nearest value of a register, clamped.
inline float held(float v) { return std::round(std::clamp(v, -1.f, 1.f) * 255) / 255; }
// The same for textures, colours and the frame buffer, which have no sign.
inline float held_unsigned(float v) { return std::round(std::clamp(v, 0.f, 1.f) * 255) / 255; }

// Input mapping EXPAND_NORMAL: 2 max(0, c) − 1.
inline float expand_normal(float c) { return 2 * std::max(0.f, c) - 1; }
inline Vec3f expand_normal(Vec3f c) { return {expand_normal(c.x), expand_normal(c.y), expand_normal(c.z)}; }

// One output of a general combiner stage: the dot product of two inputs.
inline float dot_stage(Vec3f a, Vec3f b, float scale) { return held(dot(a, b) * scale); }
// The output that sums both products.
inline float sum_stage(float a, float b, float c, float d, float scale) { return held((a * b + c * d) * scale); }
// The final combiner's (1 − A)·C, A and C taken for unsigned.
inline float final_one_minus(float a, float c) { return held_unsigned((1 - std::max(0.f, a)) * std::max(0.f, c)); }

}  // namespace burnish::combiners
