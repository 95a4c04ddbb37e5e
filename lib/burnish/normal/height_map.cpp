#include "burnish/normal/height_map.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"
#include "burnish/normal/band_fitter.h"
#include "burnish/normal/height_bands.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

HeightMapStats convert_height_map(const FileRef& file, const HeightMapOptions& options, const NormalMapTarget& target,
                                  const Progress& progress) {
  if (!std::isfinite(options.height)) throw Error(ErrorKind::kUsage, "height: expected a finite number");
  if (!std::isfinite(options.mid_level)) throw Error(ErrorKind::kUsage, "mid-level: expected a finite number");
  if (!(options.size_u >= 0 && options.size_v >= 0 && std::isfinite(options.size_u + options.size_v)))
    throw Error(ErrorKind::kUsage, "size: expected positive numbers");
  require_encodable(target.coding, target.sample, target.file.name);
  const Neighborhood neighborhood = make_neighborhood(options.neighbors, options.weights);
  HeightBands source(file, options, neighborhood.radius);
  HeightMapStats stats;
  stats.width = source.width();
  stats.height = source.height();
  const BandFitter fitter(neighborhood, options, stats.width, stats.height, target, file.name);
  ImageWriter writer(target.file, target.type, target.sample, stats.width, stats.height, 3,
                     space_attributes(NormalSpace::kTangent));

  double tilt_sum = 0, steepest = 0;
  std::size_t taking_part = 0;
  const bool stored = is_integer(target.sample);
  const auto read = [&] { return source.done() ? nullptr : std::make_shared<HeightBand>(source.next()); };
  const auto fit = [&](const std::shared_ptr<HeightBand>& band) {
    return std::make_shared<NormalBand>(fitter.fit(*band));
  };
  const auto write = [&](const std::shared_ptr<NormalBand>& band) {
    if (stored) writer.write_rows_stored(band->rows, band->samples.get());
    else writer.write_rows(band->rows, reinterpret_cast<const float*>(band->samples.get()));
    tilt_sum += band->tilt_sum;
    steepest = std::max(steepest, band->steepest);
    taking_part += band->taking_part;
    stats.degenerate_texels += band->degenerate;
    report_progress(progress, double(band->first + band->rows) / stats.height);
  };
  constexpr std::size_t kBandsInFlight = 4;
  parallel_pipeline(kBandsInFlight, read, fit, write);
  writer.close();
  stats.max_slope_deg = degrees(2 * portable::atan(steepest));
  stats.mean_tilt_deg = taking_part ? degrees(tilt_sum / double(taking_part)) : 0;
  stats.colour_channels_differ = source.colour_channels_differ();
  return stats;
}

}  // namespace burnish
