#include "burnish/render/lighting/environment.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/portable_math.h"
#include "burnish/core/texel_check.h"
#include "burnish/render/lookup.h"
#include "burnish/render/transform.h"

namespace burnish {

std::shared_ptr<const Panorama> Panorama::read(const FileRef& file) {
  ImageReader reader(file);
  Image image = reader.read_level(0);
  if (image.channels == 2)
    throw file_error(ErrorKind::kMalformed, file.name, "expected a panorama of 1, 3 or 4 channels, got 2");
  // Below 0 there may be rings that a resampling filter left: they are taken as they are.
  const auto finite = [](float x) { return std::isfinite(x); };
  require_samples(file.name, image.data, image.width, image.channels, 0, image.channels, finite, "finite light");
  Panorama panorama(std::move(image));
  panorama.integer_ = reader.integer();
  return std::make_shared<const Panorama>(std::move(panorama));
}

Vec3d Panorama::at(Vec3d d) const {
  const double u = 0.5 + portable::atan2(d.x, -d.z) / (2 * kPi),
               v = 0.5 + portable::asin(std::clamp(d.y, -1.0, 1.0)) / kPi;
  const BilinearTaps taps = bilinear_taps(u, v, image_.width, image_.height, {.repeat_v = false});
  Vec3d sum;
  for (int i = 0; i < 4; i++) {
    const float* s = image_.at(taps.texel[i].x, taps.texel[i].y);
    const int g = image_.channels >= 3 ? 1 : 0;
    sum += Vec3d{s[0], s[g], s[2 * g]} * taps.weight[i];
  }
  return sum;
}

Shaded Environment::shade(Vec3d n, const Illumination& in) const {
  const Vec3d d = mirrored(in.to_viewer, n);
  return {{}, specular * panorama->at(turn_rad == 0 ? d : rotation_about({0, 1, 0}, -turn_rad).apply(d))};
}

}  // namespace burnish
