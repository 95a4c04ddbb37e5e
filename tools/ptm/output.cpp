#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/image_chain.h"
#include "burnish/ptm/files/open_ptm.h"
#include "burnish/ptm/files/ptm_exr.h"
#include "burnish/ptm/files/ptm_file.h"
#include "burnish/ptm/round_ptm.h"
#include "ptm/ptm.h"

namespace burnish::cli {

CLI::App& add_verb(Tool& tool, const std::string& name, const std::string& summary, const std::string& example) {
  CLI::App* verb = tool.app().add_subcommand(name, summary);
  verb->fallthrough();
  verb->footer("Example:\n" + example);
  return *verb;
}

void PtmOutput::add_to(CLI::App& verb) {
  verb.add_option("-o,--output", path,
                  "What to write: a .ptm, an .exr of the coefficients as floats, or six 8-bit textures and their "
                  "ptm.json behind a PREFIX that ends in '/'; '-' is standard output")
      ->required()
      ->type_name("OUT");
  add_choice<std::string>(verb, "--output-type", output_type, {{"ptm", "ptm"}, {"exr", "exr"}},
                          "Type of what goes to standard output");
  verb.add_option("--jpeg", jpeg_quality, "Compress a .ptm: JPEG planes of that quality")
      ->check(in_range(1, 100))
      ->type_name("QUALITY");
}

PtmTarget::Type PtmTarget::type_of(const PtmOutput& output) {
  const std::string& path = output.path;
  const std::string extension =
      path == "-" ? "." + output.output_type : std::filesystem::path(path).extension().string();
  if (path == "-" && output.output_type.empty())
    throw file_error(ErrorKind::kUsage, kStandardOutput, "needs --output-type ptm or exr");
  if (path != "-" && !output.output_type.empty())
    throw file_error(ErrorKind::kUsage, path, "--output-type " + output.output_type + " is for standard output");
  if (path.ends_with('/')) return Type::kTextures;
  if (extension == ".ptm") return Type::kPtm;
  if (extension == ".exr") return Type::kExr;
  throw file_error(ErrorKind::kUnsupported, path,
                   "a polynomial texture map is written as .ptm, .exr or textures behind a PREFIX/, not " +
                       (extension.empty() ? "a file without extension" : "'" + extension + "'") + " (--output)");
}

PtmTarget::PtmTarget(Tool& tool, const PtmOutput& output) : type_(type_of(output)), jpeg_quality_(output.jpeg_quality) {
  if (jpeg_quality_ && type_ != Type::kPtm) throw file_error(ErrorKind::kUsage, output.path, "--jpeg is for a .ptm");
  if (type_ != Type::kTextures) {
    file_ = tool.write(output.path);
    return;
  }
  tool.make_directory(output.path);
  const auto names = ptm_texture_names();
  for (std::size_t i = 0; i < textures_.images.size(); i++) textures_.images[i] = tool.write(output.path + names[i]);
  textures_.json = tool.write(output.path + names.back());
}

void PtmTarget::write(const PtmRows& rows, const std::array<PtmCoefficients<double>, kPtmTerms>& normal,
                      const Attributes& also) const {
  if (type_ == Type::kExr) write_ptm_exr(file_, rows);
  else if (type_ == Type::kTextures) write_ptm_textures(textures_, rows, normal, also);
  else if (const PtmBytes* bytes = rows.bytes()) write_ptm(file_, *bytes, jpeg_quality_);
  else write_ptm(file_, rounded(rows, normal), jpeg_quality_);
}

void PtmTarget::write(std::span<const Ptm> levels, std::span<const PtmBytes> bytes, const Attributes& also) const {
  if (type_ == Type::kExr) write_ptm_exr_chain(file_, levels);
  else write(PtmInBytes(bytes[0]), {}, also);
}

void PtmTarget::require_levels(const PtmShape& base, int count) const {
  if (type_ == Type::kExr) return require_chain(file_, base.width, base.height, count);
  if (count > 1)
    throw file_error(
        ErrorKind::kUnsupported, type_ == Type::kPtm ? file_.name : textures_.json.name,
        "holds one level, not " + std::to_string(count) + " (EXR holds all; --split writes a file or PREFIX/ a level)");
}

std::unique_ptr<PtmRows> PtmTarget::stored() const {
  if (type_ == Type::kTextures) return read_ptm_textures(textures_).rows;
  return open_ptm(file_).rows;
}

}  // namespace burnish::cli
