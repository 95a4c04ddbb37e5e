#include "burnish/brdf/measured/measured_brdf.h"

#include "burnish/brdf/measured/readers.h"
#include "burnish/core/error.h"
#include "burnish/core/whole_file.h"

namespace burnish {

void require_measurements(const std::string& name) {
  for (const char* ending : {".binary", ".brdf", ".mbsdf"})
    if (name.ends_with(ending)) return;
  throw file_error(
      ErrorKind::kUsage, name,
      "expected a model such as ward:ax=0.2,ay=0.5, or measurements in a .binary (MERL), .brdf (Cornell) or "
      ".mbsdf (NVIDIA)");
}

std::shared_ptr<const Brdf> read_measured_brdf(const FileRef& file) {
  require_measurements(file.name);
  if (file.name.ends_with(".binary")) return parse_merl(read_file(file), file.name);
  if (file.name.ends_with(".brdf")) return parse_cornell(read_file(file), file.name);
  return parse_mbsdf(read_file(file), file.name);
}

}  // namespace burnish
