// The reflectance of one texel: a model's lobe, in its frame.
//
// What the models say of its width and its brightness, in terms that they share:
//
//                width² of the halfway vector's slope   peak                    energy, up to a factor of the model
//   ward         ½α²                                    k_s / (4π α_x α_y)      k_s
//   blinn-phong  α² / (N+4)                             k_s                     k_s α_x α_y / (N+2)
//   banks        none: α is 1 and means nothing         k_s                     k_s
#pragma once

#include "burnish/brdf/local_frame.h"
#include "burnish/material/material_textures.h"

namespace burnish {

struct Lobe {
  LocalFrame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double alpha_x = 1, alpha_y = 1;  // above 0
  double k_s = 0;
  double exponent = 0;  // blinn-phong's N
};

// Variance of the slope for α = 1, along t and along b; α times its root is a standard deviation.
inline double unit_variance(MaterialModel model, double exponent) {
  return model == MaterialModel::kBlinnPhong ? 1 / (exponent + 4) : 0.5;
}
inline double peak(MaterialModel model, const Lobe& o) {
  return model == MaterialModel::kWard ? o.k_s / (4 * kPi * o.alpha_x * o.alpha_y) : o.k_s;
}
// energy = k_s · unit_energy
inline double unit_energy(MaterialModel model, const Lobe& o) {
  return model == MaterialModel::kBlinnPhong ? o.alpha_x * o.alpha_y / (o.exponent + 2) : 1;
}

// A texel of material textures, and back. lobe_at() throws Error, kMalformed, where its vectors make no frame, an α is
// below 10⁻⁶, or k_s or N below 0; the message begins with the texel.
Lobe lobe_at(const MaterialTextures& textures, int level, int x, int y);
void put_lobe(const Lobe& lobe, MaterialTextures& textures, int level, int x, int y);

}  // namespace burnish
