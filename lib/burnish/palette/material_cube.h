// Material and normal as one colour of the RGB(A) cube (Tarini et al., section 6), and back.
//
// What colour quantizers see: 8 bits a component, a normal's component v being c = ½v + ½ of 255, rounded half up, +y
// up. Materials are numbered by ascending id among those that occur, k = 0 … m − 1, so that a cube is read with the ids
// it was made of.
//
//   kAlpha     colour (c_x, c_y, c_z, a_k): the material as a fourth component. a_k falls evenly from 255 for k = 0 to
//              96 for k = m − 1 (to 256 − m beyond 160 materials): apart enough that a cell seldom holds two materials,
//              and of four at least far enough from 0 for quantizers that multiply by alpha, as libimagequant does,
//              which see the normals of a small alpha as one.
//   kSubcubes  c' = ⌊c/2⌋ + 128·bit per component, bits 000, 011, 101, 110 for k = 0 … 3: four of the eight half-size
//              cubes, no two of which share a face. A component keeps 7 bits and comes back as 2(c' − 128·bit) + ½.
//
// Any colour has a meaning, those that quantizers mix too: its material is the one of the nearest alpha, of the cube
// whose centre is nearest (in a tie the smaller k), its normal what then comes of the components, made unit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

// kSplit: none of these; each material has a share of the entries, which are fitted on the sphere.
enum class MaterialEncoding { kSplit, kAlpha, kSubcubes };

constexpr int kMostSubcubes = 4;

// Red, green, blue and alpha, each 0 … 255, not necessarily whole; alpha 255 where the colour has none.
using Colour = std::array<float, 4>;

class MaterialCube {
 public:
  // Of so many materials. kUnsupported for more than 4 in subcubes.
  MaterialCube(MaterialEncoding encoding, int materials);

  int channels() const { return encoding_ == MaterialEncoding::kAlpha ? 4 : 3; }

  // Whole numbers.
  Colour encode(int material, Vec3f normal) const;

  struct Meaning {
    int material;
    Vec3f normal;  // unit; (0,0,1) where the colour has no direction
  };
  Meaning decode(const Colour& colour) const;

 private:
  float alpha(int material) const;

  MaterialEncoding encoding_;
  int materials_;
};

}  // namespace burnish
