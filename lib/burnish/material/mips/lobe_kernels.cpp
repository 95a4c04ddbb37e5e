#include "burnish/material/mips/lobe_kernels.h"

#include "burnish/core/vector_math.h"
#include "burnish/material/mips/lobe_response.h"

namespace burnish::kernels {
namespace {

constexpr int kLanes = PairBlock::kPairs;

// The frame, in floats.
struct Axes {
  Vec3f t, b, n;
  explicit Axes(const LocalFrame& f) : t(f.t), b(f.b), n(f.n) {}
};

[[gnu::always_inline]] inline float cosine(Vec3f a, const float (&of)[3][kLanes], int i) {
  return a.x * of[0][i] + a.y * of[1][i] + a.z * of[2][i];
}

[[gnu::always_inline]] inline Cosines cosines(const Axes& f, const PairBlock& p, int i) {
  return {cosine(f.t, p.l, i), cosine(f.n, p.l, i), cosine(f.t, p.v, i), cosine(f.n, p.v, i),
          cosine(f.t, p.h, i), cosine(f.b, p.h, i), cosine(f.n, p.h, i)};
}

template <typename Model>
[[gnu::always_inline]] inline void reflectance_of(const Lobe& lobe, std::span<const PairBlock> pairs, float* out) {
  const Axes f(lobe.frame);
  const Model model(lobe);
  const float k_s = float(lobe.k_s);
  for (const PairBlock& p : pairs) {
    for (int i = 0; i < kLanes; i++) out[i] = k_s * model(cosines(f, p, i)).value;
    out += kLanes;
  }
}

// Every lane has sums of its own, so that their order does not depend on the vector unit.
template <typename Model>
[[gnu::always_inline]] inline LobeSums sums_of(const Lobe& lobe, std::span<const PairBlock> pairs,
                                               const float* __restrict scale, const float* __restrict wanted) {
  const Axes f(lobe.frame);
  const Model model(lobe);
  float gg[kLanes] = {}, gw[kLanes] = {}, gd[kShape][kLanes] = {}, wd[kShape][kLanes] = {};
  float dd[kShape][kShape][kLanes] = {};
  for (const PairBlock& p : pairs) {
    float g[kLanes], d[kShape][kLanes];
    for (int i = 0; i < kLanes; i++) {
      const Cosines c = cosines(f, p, i);
      const float b_l = cosine(f.b, p.l, i), b_v = cosine(f.b, p.v, i);
      const Response r = model(c);
      g[i] = scale[i] * r.value;
      // A turn ω of the frame moves t, b and n by ω × t, ω × b, ω × n.
      d[0][i] = scale[i] * (c.n_h * r.by_b_h - c.b_h * r.by_n_h - b_l * r.by_n_l - b_v * r.by_n_v);
      d[1][i] = scale[i] * (c.t_h * r.by_n_h - c.n_h * r.by_t_h + c.t_l * r.by_n_l - c.n_l * r.by_t_l +
                            c.t_v * r.by_n_v - c.n_v * r.by_t_v);
      d[2][i] = scale[i] * (c.b_h * r.by_t_h - c.t_h * r.by_b_h + b_l * r.by_t_l + b_v * r.by_t_v);
      d[3][i] = scale[i] * r.by_ln_alpha_x;
      d[4][i] = scale[i] * r.by_ln_alpha_y;
    }
    for (int i = 0; i < kLanes; i++) gg[i] += g[i] * g[i], gw[i] += g[i] * wanted[i];
    for (int j = 0; j < kShape; j++) {
      for (int i = 0; i < kLanes; i++) gd[j][i] += g[i] * d[j][i], wd[j][i] += wanted[i] * d[j][i];
      for (int k = 0; k <= j; k++)
        for (int i = 0; i < kLanes; i++) dd[j][k][i] += d[j][i] * d[k][i];
    }
    scale += kLanes, wanted += kLanes;
  }
  const auto total = [](const float(&lanes)[kLanes]) {
    double sum = 0;
    for (const float lane : lanes) sum += lane;
    return sum;
  };
  LobeSums sums{total(gg), total(gw), {}, {}, {}};
  for (int j = 0; j < kShape; j++) {
    sums.gd[j] = total(gd[j]), sums.wd[j] = total(wd[j]);
    for (int k = 0; k <= j; k++) sums.dd[j][k] = total(dd[j][k]);
  }
  return sums;
}

using Pairs = std::span<const PairBlock>;

BURNISH_VECTOR_UNITS void ward_reflectance(const Lobe& o, Pairs p, float* out) {
  reflectance_of<WardResponse>(o, p, out);
}
BURNISH_VECTOR_UNITS void blinn_phong_reflectance(const Lobe& o, Pairs p, float* out) {
  reflectance_of<BlinnPhongResponse>(o, p, out);
}
BURNISH_VECTOR_UNITS void banks_reflectance(const Lobe& o, Pairs p, float* out) {
  reflectance_of<BanksResponse>(o, p, out);
}
BURNISH_VECTOR_UNITS LobeSums ward_sums(const Lobe& o, Pairs p, const float* scale, const float* wanted) {
  return sums_of<WardResponse>(o, p, scale, wanted);
}
BURNISH_VECTOR_UNITS LobeSums blinn_phong_sums(const Lobe& o, Pairs p, const float* scale, const float* wanted) {
  return sums_of<BlinnPhongResponse>(o, p, scale, wanted);
}
BURNISH_VECTOR_UNITS LobeSums banks_sums(const Lobe& o, Pairs p, const float* scale, const float* wanted) {
  return sums_of<BanksResponse>(o, p, scale, wanted);
}

}  // namespace

void reflectance(MaterialModel model, const Lobe& lobe, Pairs pairs, float* out) {
  switch (model) {
    case MaterialModel::kBanks:
      return banks_reflectance(lobe, pairs, out);
    case MaterialModel::kBlinnPhong:
      return blinn_phong_reflectance(lobe, pairs, out);
    default:
      return ward_reflectance(lobe, pairs, out);
  }
}

LobeSums lobe_sums(MaterialModel model, const Lobe& lobe, Pairs pairs, const float* scale, const float* wanted) {
  switch (model) {
    case MaterialModel::kBanks:
      return banks_sums(lobe, pairs, scale, wanted);
    case MaterialModel::kBlinnPhong:
      return blinn_phong_sums(lobe, pairs, scale, wanted);
    default:
      return ward_sums(lobe, pairs, scale, wanted);
  }
}

}  // namespace burnish::kernels
