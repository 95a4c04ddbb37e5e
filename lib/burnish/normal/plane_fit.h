// Least-squares planes through a texel and its neighbours (Tarini et al., section 4.1).
//
// In a frame with x right, y up and d the displacement, the plane a₀x + a₁y + a₂ minimises Σ wᵢ(a₀xᵢ + a₁yᵢ + a₂ − dᵢ)²
// over the texel and its q neighbours; the normal is (−a₀, −a₁, 1)/‖·‖. Positions are in texels here: a₀ and a₁ are
// displacement per texel. (The paper's X has q rows; the texel itself takes part here as one more, as the contract
// says. For a whole symmetric neighbourhood that changes a₂ only.)
//
// Where the whole neighbourhood exists, its symmetry decouples the normal equations and each slope is a fixed
// convolution:
//   a₀ = Σ wᵢxᵢdᵢ / Σ wᵢxᵢ²
// which for the square neighbourhoods is a derivative along one axis times a smoothing along the other. Where some
// texels are missing, the 3×3 system is solved; centring on the weighted means leaves 2×2 of it.
#pragma once

#include <vector>

namespace burnish {

enum class FitWeights {
  kUniform,
  kGaussian,  // exp(−(x² + y²)/2σ²), σ = r/2 texels, r the radius of the neighbourhood
};

struct Neighborhood {
  struct Tap {
    int x, y;  // right, up
    float weight;
  };
  int radius;
  std::vector<Tap> taps;  // the texel itself included

  // The convolution: slope = Σ_j smoothing[|j|] Σ_i derivative[i]·(d(+i, j) − d(−i, j)), i from 1, j over ±radius.
  std::vector<float> derivative;  // [0] unused
  std::vector<float> smoothing;   // {1} alone where the neighbourhood is a cross
};

// q = 4 (right, left, above, below), 8, 24, 48, 80 (3×3 to 9×9 without the centre). kUsage for any other.
Neighborhood make_neighborhood(int q, FitWeights weights);

struct PlaneSlope {
  double a0 = 0, a1 = 0;    // per texel, right and up
  bool determined = false;  // false: fewer than three points off a line, and a0 = a1 = 0
};

// The plane through those taps that exist; `displacement` and `exists` are parallel to neighborhood.taps.
PlaneSlope fit_plane(const Neighborhood& neighborhood, const float* displacement, const bool* exists);

}  // namespace burnish
