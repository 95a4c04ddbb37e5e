// What the verbs of burnish-ptm share.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "burnish/core/attributes.h"
#include "burnish/ptm/files/open_ptm.h"
#include "burnish/ptm/files/ptm_textures.h"
#include "burnish/ptm/ptm_rows.h"
#include "cli/options.h"
#include "cli/tool.h"

namespace burnish::cli {

struct Verb {
  CLI::App* app;              // what its options stand on
  std::function<Json()> run;  // returns the report's stats
};

// Declares a verb; the options that all tools have may stand behind it too.
CLI::App& add_verb(Tool& tool, const std::string& name, const std::string& summary, const std::string& example);

// Each declares a verb and its options.
Verb add_brdf(Tool& tool);
Verb add_convert(Tool& tool);
Verb add_fit(Tool& tool);
Verb add_info(Tool& tool);
Verb add_normals(Tool& tool);
Verb add_relight(Tool& tool);

// A map that is read.
struct PtmInput {
  std::unique_ptr<PtmRows> rows;
  std::string format;  // OpenPtm's, or "textures"
  PtmType made_of;     // of textures, which are RGB, what they were made of
  Json description;    // of textures their ptm.json

  // What ptm.json of textures made of it says beside their size and range.
  Attributes members() const;
};
void add_input(CLI::App& verb, std::string& path);
PtmInput open_input(Tool& tool, const std::string& path);
PtmInput open_input(const FileRef& file);  // .ptm or .exr
bool is_texture_prefix(const std::string& path);

// -o of what writes coefficients.
struct PtmOutput {
  std::string path, output_type;
  int jpeg_quality = 0;  // of JPEG planes in a .ptm; 0: none are

  void add_to(CLI::App& verb);
};

// Where coefficients go: .ptm, .exr or textures.
class PtmTarget {
 public:
  // Reserves the files. kUnsupported for any other name.
  PtmTarget(Tool& tool, const PtmOutput& output);

  // `normal`: G of the lights (light_matrix.h), for what is rounded. `also`: further members of ptm.json.
  void write(const PtmRows& rows, const std::array<PtmCoefficients<double>, kPtmTerms>& normal,
             const Attributes& also = {}) const;
  bool holds_floats() const { return type_ == Type::kExr; }
  // A mip chain, in floats and, unless it holds those, the first level in bytes.
  void write(std::span<const Ptm> levels, std::span<const PtmBytes> bytes, const Attributes& also) const;
  // kUnsupported for more levels than it holds.
  void require_levels(const PtmShape& base, int count) const;
  // Whether bytes are stored as they are: in a .ptm without JPEG planes.
  bool keeps_bytes() const { return type_ == Type::kPtm && jpeg_quality_ == 0; }
  // What was written, as a reader sees it.
  std::unique_ptr<PtmRows> stored() const;

 private:
  enum class Type { kPtm, kExr, kTextures };
  static Type type_of(const PtmOutput& output);

  Type type_;
  int jpeg_quality_;
  FileRef file_;
  PtmTextureFiles textures_;
};

}  // namespace burnish::cli
