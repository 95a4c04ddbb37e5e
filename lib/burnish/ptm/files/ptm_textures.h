// A polynomial texture map as a shader samples it: six 8-bit textures and their ptm.json (Rost, OpenGL Shading
// Language, 14.4.3).
//
//   abc_red.png, abc_green.png, abc_blue.png   a₀, a₁, a₂ of u², v², uv
//   def_red.png, def_green.png, def_blue.png   a₃, a₄, a₅ of u, v, 1
//   coefficient = (texel − bias) · scale        texel in [0,1], light in [0,1]
//
// ptm.json holds width, height, type, and abc_scale, abc_bias, def_scale, def_bias, three numbers each, of all colours
// alike. The shader has a polynomial a colour: an LRGB map's colour is multiplied in, and `type` says that it was one.
// The bytes are those of an RGB .ptm: the six of a colour are rounded together.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "burnish/core/attributes.h"
#include "burnish/core/file_ref.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct PtmTextureFiles {
  std::array<FileRef, 6> images;  // abc and def of red, of green, of blue
  FileRef json;
};
// What stands behind PREFIX, in that order: "abc_red.png", … "ptm.json".
std::array<std::string, 7> ptm_texture_names();

// `normal`: G (light_matrix.h). `also`: further members of ptm.json, behind the others. Errors as rounded() and
// write_image().
void write_ptm_textures(const PtmTextureFiles& files, const PtmRows& rows,
                        const std::array<PtmCoefficients<double>, kPtmTerms>& normal, const Attributes& also = {});

struct PtmTextures {
  std::unique_ptr<PtmRows> rows;    // RGB
  PtmType made_of = PtmType::kRgb;  // "type"
  JsonText description;             // all of ptm.json
};
// kMalformed where a member is missing or another than above, or coefficients are beyond floats, where an image has
// another size, channels or samples. Textures of other programs may have biases between the steps of bytes.
PtmTextures read_ptm_textures(const PtmTextureFiles& files);

}  // namespace burnish
