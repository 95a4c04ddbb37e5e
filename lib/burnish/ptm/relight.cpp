#include "burnish/ptm/relight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {

bool is_from_above(Vec3d light) {
  const double size = length(light);
  return size > 1e-6 && std::isfinite(size) && light.z > 0;
}

RelightStats relight(const PtmRows& rows, Vec3d light, const FileRef& file, FileType type, SampleType sample,
                     const Progress& progress) {
  if (!is_from_above(light))
    throw Error(ErrorKind::kUsage, "light: expected a direction from above the surface, z > 0, got " +
                                       number_text(light.x) + "," + number_text(light.y) + "," + number_text(light.z));
  const double size = length(light), u = light.x / size, v = light.y / size;
  const PtmShape& shape = rows.shape();
  const auto lit = [&](const PtmBand& band, std::size_t texel) {
    std::array<float, 3> rgb;
    if (band.type == PtmType::kRgb) {
      for (int c = 0; c < 3; c++) rgb[c] = float(evaluate(band.polynomial(texel, c), u, v) / 255);
    } else {
      const double brightness = evaluate(band.polynomial(texel), u, v) / 255;
      for (int c = 0; c < 3; c++) rgb[c] = float(band.colour[texel * 3 + c] * brightness / 255);
    }
    return rgb;
  };
  RelightStats stats;
  ImageWriter writer(file, type, sample, shape.width, shape.height, 3);
  for_each_texel<std::array<float, 3>>(
      rows, lit,
      [&](int count, const std::vector<std::array<float, 3>>& texels) {
        if (is_integer(sample))
          for (const auto& rgb : texels)
            stats.clipped_samples += std::ranges::count_if(rgb, [](float c) { return c < 0 || c > 1; });
        writer.write_rows(count, texels[0].data());
      },
      progress);
  writer.close();
  return stats;
}

}  // namespace burnish
