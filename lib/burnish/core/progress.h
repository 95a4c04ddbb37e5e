// How far a long computation has come, told to whoever wants to know.
#pragma once

#include <functional>

namespace burnish {

// Called with a fraction in [0, 1], never decreasing, from the thread that started the computation. May be empty.
using Progress = std::function<void(double)>;

inline void report_progress(const Progress& progress, double fraction) {
  if (progress) progress(fraction);
}

// The progress of a step that goes from one fraction of the whole to another.
inline Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [=](double f) { progress(from + f * (to - from)); };
}

}  // namespace burnish
