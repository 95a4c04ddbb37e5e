// The functions that shading looks up in tables, with their parameters and domains.
//
//   banks-r        R(s) = √(1 − s), or R*(s) = 1 − s       Kautz & Seidel, section 3.1
//   blinn-phong-f  F(N, e) = (√e)^N                        section 3.2
//   ward-s         S(p) = 1/√p                             section 3.3
//   ward-e         E(m, d) = exp(−2m/(1 + d))              section 3.3
//   strand         of a = L·T and b = V·T: the diffuse term in three channels, the specular one in a fourth
//                                                          Isidoro & Brennan
//   light-factor   F(c) = A + (light − A) w(c), RGB        Rost, OpenGL Shading Language, 14.4.1
#pragma once

#include <string>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

enum class LookupKind { kBanksR, kBlinnPhongF, kWardS, kWardE, kStrand, kLightFactor };
const char* name(LookupKind kind);

struct Range {
  double least = 0, most = 1;
  friend bool operator==(const Range&, const Range&) = default;
};

struct LookupFunction {
  LookupKind kind = LookupKind::kBanksR;
  std::vector<Range> domain;                // one per argument
  bool approximate = false;                 // banks-r: R* in R's place
  double exponent = 16;                     // strand: n > 0
  Vec3d light{1, 1, 1};                     // light-factor; ≥ 0, as is all of it
  double ambient = 0.1, transition = 0.25;  // light-factor; the transition in units of the cosine

  int arguments() const { return int(domain.size()); }  // 1 or 2
  int channels() const;                                 // 1, 3 (light-factor) or 4 (strand)
  // One value a channel. `y` is not looked at where there is one argument.
  void evaluate(double x, double y, double* out) const;
};

// What an option left out stands for.
std::vector<Range> default_domain(LookupKind kind);
// kUsage unless the domain is where the function is finite, its ends are finite and in order, in single precision too,
// in which lookups are made, and the parameters are in their ranges.
void require_valid(const LookupFunction& function);

}  // namespace burnish
