#include "burnish/palette/fit/fit_palette.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/palette/codebook.h"
#include "burnish/palette/fit/cube_fit.h"
#include "burnish/palette/fit/imagequant_engine.h"
#include "burnish/palette/fit/median_cut.h"
#include "burnish/palette/mapper.h"
#include "burnish/palette/palette_order.h"

namespace burnish {

Palette palette_of(std::vector<std::vector<Vec3f>> groups, const std::vector<int>& materials, NormalSpace space) {
  Palette palette;
  palette.space = space;
  for (std::size_t g = 0; g < groups.size(); g++) {
    std::vector<Vec3f>& entries = groups[g];
    if (entries.empty()) continue;
    std::ranges::sort(entries, {}, [](Vec3f v) { return std::tuple(curve_position(v), v.x, v.y, v.z); });
    palette.materials.push_back({materials[g], int(palette.normals.size()), int(entries.size())});
    palette.normals.insert(palette.normals.end(), entries.begin(), entries.end());
  }
  return palette;
}

namespace {

// At most n entries, at least one of each material.
Palette fit_entries(const Histogram& histogram, const PaletteOptions& options, NormalSpace space, int n,
                    const Progress& progress = {}) {
  const auto& points = histogram.groups;
  const auto sorted = [&](std::vector<std::vector<Vec3f>> groups) {
    return palette_of(std::move(groups), histogram.material, space);
  };
  require_an_entry_each(points.size(), n);
  if (options.encoding != MaterialEncoding::kSplit)
    return sorted(fit_in_cube(points, MaterialCube(options.encoding, int(points.size())), options.engine, n));
  if (options.engine == Engine::kSpherical) return sorted(fit_codebook(points, n, progress).groups);
  const std::vector<int> share = share_entries(points, n);
  std::vector<std::vector<Vec3f>> groups;
  for (std::size_t g = 0; g < points.size(); g++)
    groups.push_back(options.engine == Engine::kMedianCut ? fit_median_cut(points[g], share[g])
                                                          : fit_imagequant(points[g], share[g]));
  return sorted(std::move(groups));
}

// The smallest palette within the target: between a size that fails and the next, which does not. Errors fall with the
// root of the size, so a measured palette foretells where to look next; where that narrows too little, the middle is
// taken.
Palette fit_to_error(const Histogram& histogram, const PaletteOptions& options, NormalSpace space,
                     const Progress& progress) {
  const double target_deg = *options.target_error_deg;
  const int most = options.engine == Engine::kImagequant ? kImagequantMost : kMaxPaletteSize;
  const int least = std::max<int>(1, int(histogram.groups.size()));
  struct Measured {
    int size;
    double rms_deg;
    Palette palette;
  };
  const auto measure = [&](int n) {
    Measured m{n, 0, fit_entries(histogram, options, space, n)};
    m.rms_deg = nearest_angles(histogram, m.palette, entry_ranges(m.palette, histogram.material, "palette")).rms_deg();
    return m;
  };
  const auto foretold = [&](const Measured& m) {
    const double ratio = target_deg > 0 ? m.rms_deg / target_deg : most;
    return std::min(double(most), m.size * ratio * ratio);
  };

  Measured good = measure(std::clamp(256, least, most));
  int fails = least - 1;
  while (good.rms_deg > target_deg) {
    if (good.size >= most)
      throw Error(ErrorKind::kThreshold,
                  "target-error: expected an RMS angle of at most " + number_text(target_deg) + " degrees, got " +
                      number_text(good.rms_deg) + " with " + std::to_string(most) + " normals, which is the most " +
                      (options.engine == Engine::kImagequant ? "for imagequant" : "there can be"));
    fails = good.size;
    good = measure(std::clamp(int(foretold(good) * 1.02) + 1, fails + 1, most));
  }
  double guess = foretold(good);
  const int interval_at_first = good.size - fails;
  for (bool halve = false; good.size - fails > 1;) {
    const int interval = good.size - fails;
    const int n = halve ? fails + interval / 2 : std::clamp(int(guess), fails + 1, good.size - 1);
    Measured m = measure(n);
    guess = foretold(m);
    if (m.rms_deg > target_deg) fails = n;
    else good = std::move(m);
    halve = !halve && (good.size - fails) * 2 > interval;
    report_progress(progress, 1 - double(good.size - fails) / interval_at_first);
  }
  return std::move(good.palette);
}

}  // namespace

void require_sane(const PaletteOptions& o) {
  const auto usage = [](const std::string& message) { throw Error(ErrorKind::kUsage, message); };
  if (o.normals < 2 || o.normals > kMaxPaletteSize)
    usage("normals: expected 2 to 65536, got " + std::to_string(o.normals));
  if (o.target_error_deg && !(*o.target_error_deg >= 0 && *o.target_error_deg <= 180))
    usage("target-error: expected degrees from 0 to 180, got " + number_text(*o.target_error_deg));
  if (o.engine == Engine::kImagequant && !o.target_error_deg && o.normals > kImagequantMost)
    throw Error(ErrorKind::kUnsupported,
                "engine: imagequant holds at most 256 normals, not " + std::to_string(o.normals));
}

void require_encodable(MaterialEncoding encoding, std::size_t materials, const std::string& files) {
  if (encoding == MaterialEncoding::kSubcubes && materials > kMostSubcubes)
    throw Error(ErrorKind::kUnsupported, "material-encoding: subcubes holds at most 4 materials, not " +
                                             std::to_string(materials) + " as in " + files);
}

Palette fit_palette(const Histogram& histogram, const PaletteOptions& options, NormalSpace space,
                    const std::string& files, const Progress& progress) {
  if (options.target_error_deg) return fit_to_error(histogram, options, space, progress);
  if (const std::size_t materials = histogram.material.size(); std::size_t(options.normals) < materials)
    throw Error(ErrorKind::kMalformed, "normals: expected at least one for each of the " + std::to_string(materials) +
                                           " materials in " + files + ", got " + std::to_string(options.normals));
  return fit_entries(histogram, options, space, options.normals, progress);
}

}  // namespace burnish
