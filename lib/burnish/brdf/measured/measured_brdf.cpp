#include "burnish/brdf/measured/measured_brdf.h"

#include <fstream>
#include <iterator>

#include "burnish/brdf/measured/readers.h"
#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr std::size_t kLargestFile = std::size_t(1) << 30;

std::string whole_file(const FileRef& file) {
  require_readable(file);
  std::ifstream in(file.path, std::ios::binary | std::ios::ate);
  if (const std::streamoff size = in.tellg(); size > std::streamoff(kLargestFile))
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected at most 1073741824 bytes of measurements, got " + std::to_string(size));
  in.seekg(0);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return bytes;
}

}  // namespace

std::shared_ptr<const Brdf> read_measured_brdf(const FileRef& file) {
  if (file.name.ends_with(".binary")) return parse_merl(whole_file(file), file.name);
  if (file.name.ends_with(".brdf")) return parse_cornell(whole_file(file), file.name);
  if (file.name.ends_with(".mbsdf")) return parse_mbsdf(whole_file(file), file.name);
  throw file_error(
      ErrorKind::kUsage, file.name,
      "expected a model such as ward:ax=0.2,ay=0.5, or measurements in a .binary (MERL), .brdf (Cornell) or "
      ".mbsdf (NVIDIA)");
}

}  // namespace burnish
