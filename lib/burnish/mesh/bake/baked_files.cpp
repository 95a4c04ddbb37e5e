#include "burnish/mesh/bake/baked_files.h"

#include <algorithm>

#include "burnish/core/error.h"

namespace burnish {

void write_baked_normals(const NormalMapTarget& target, NormalSpace space, int width, int height,
                         const std::vector<Vec3f>& normals) {
  require_encodable(target.coding, target.sample, target.file.name);
  ImageWriter writer(target.file, target.type, target.sample, width, height, 3, space_attributes(space));
  const bool stored = is_integer(target.sample);
  std::vector<float> row(std::size_t(width) * 3);  // room for samples of any type
  for (int y = 0; y < height; y++) {
    encode_normals(normals.data() + std::size_t(y) * width, width, target.coding, target.sample, row.data());
    if (stored) writer.write_rows_stored(1, row.data());
    else writer.write_rows(1, row.data());
  }
  writer.close();
}

void write_displacement(const FileRef& file, FileType type, const Image& displacement, double most) {
  if (type == FileType::kExr) return write_image(file, type, SampleType::kFloat, displacement);
  if (type != FileType::kPng && type != FileType::kTiff)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     std::string("a displacement map is written as EXR, PNG or TIFF, not ") + name(type));
  const double scale = most > 0 ? 2 * most : 1;
  Image stored = displacement;
  for (float& d : stored.data) d = float(d / scale + 0.5);
  write_image(file, type, SampleType::kUint16, stored,
              {{"burnish:scale", std::vector<double>{scale}}, {"burnish:bias", std::vector<double>{-scale / 2}}});
}

void write_mask(const FileRef& file, FileType type, const ByteImage& flags) {
  Image mask(flags.width, flags.height);
  std::ranges::transform(flags.data, mask.data.begin(), [](std::uint8_t flag) { return flag ? 1.f : 0.f; });
  write_image(file, type, default_sample_type(type), mask);
}

}  // namespace burnish
