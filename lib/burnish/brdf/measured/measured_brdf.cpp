#include "burnish/brdf/measured/measured_brdf.h"

#include "burnish/brdf/measured/readers.h"
#include "burnish/core/error.h"
#include "burnish/core/whole_file.h"

namespace burnish {

std::shared_ptr<const Brdf> read_measured_brdf(const FileRef& file) {
  if (file.name.ends_with(".binary")) return parse_merl(read_file(file), file.name);
  if (file.name.ends_with(".brdf")) return parse_cornell(read_file(file), file.name);
  if (file.name.ends_with(".mbsdf")) return parse_mbsdf(read_file(file), file.name);
  throw file_error(
      ErrorKind::kUsage, file.name,
      "expected a model such as ward:ax=0.2,ay=0.5, or measurements in a .binary (MERL), .brdf (Cornell) or "
      ".mbsdf (NVIDIA)");
}

}  // namespace burnish
