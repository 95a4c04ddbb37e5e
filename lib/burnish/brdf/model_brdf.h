// Banks, Blinn-Phong and Ward, named with their parameters: "ward:ax=0.2,ay=0.5,ks=1".
//
//   ward:ax,ay,ks,kd           f_r of ward.h                         0.2, 0.2, 1, 0 where they are left out
//   blinn-phong:ax,ay,n,ks,kd  L_o = k_s F(N, e) of blinn_phong.h    1, 1, 32, 1, 0
//   banks:ks,kd                L_o of banks.h                        1, 0
//
// Grey, with the tangent along x. k_d is the albedo of a diffuse part beside it: f_r = k_d/π.
#pragma once

#include <memory>
#include <string>

#include "burnish/brdf/brdf.h"

namespace burnish {

// "ward:…" rather than a file: whether there is a name of a model, or of something like it, before a colon.
bool is_model_source(const std::string& source);
// kUsage for an unknown model or parameter, one given twice, and for α ≤ 0, n < 0, k < 0.
std::shared_ptr<const Brdf> model_brdf(const std::string& source);

}  // namespace burnish
