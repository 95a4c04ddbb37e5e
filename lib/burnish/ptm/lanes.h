// Eight floats side by side, which compilers keep in vector registers of whatever length there are: functions that
// use them are marked BURNISH_VECTOR_UNITS (core/vector_math.h). Operators work on each; comparisons choose with ?:.
#pragma once

#include <cstring>

namespace burnish::kernels {

inline constexpr int kLanes = 8;
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));

[[gnu::always_inline]] inline void load(const float* from, Lanes& to) { std::memcpy(&to, from, sizeof to); }
[[gnu::always_inline]] inline void store(const Lanes& from, float* to) { std::memcpy(to, &from, sizeof from); }

// To whole numbers, for |x| < 2²²: beyond 1.5 · 2²³ floats hold no others.
[[gnu::always_inline]] inline void round(Lanes& x) {
  constexpr float kLarge = 12582912.0f;
  x = (x + kLarge) - kLarge;
}

}  // namespace burnish::kernels
