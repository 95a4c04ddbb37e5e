#include "burnish/palette/imagequant_engine.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "burnish/core/error.h"

#ifdef BURNISH_WITH_IMAGEQUANT
#include <libimagequant.h>
#endif

namespace burnish {

#ifdef BURNISH_WITH_IMAGEQUANT

namespace {

struct Destroy {
  void operator()(liq_attr* p) const { liq_attr_destroy(p); }
  void operator()(liq_histogram* p) const { liq_histogram_destroy(p); }
  void operator()(liq_result* p) const { liq_result_destroy(p); }
};

}  // namespace

bool has_imagequant() { return true; }

std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>& points, int n) {
  if (n > kImagequantMost)
    throw Error(ErrorKind::kUnsupported, "the engine imagequant holds at most 256 normals, not " + std::to_string(n));
  if (n == 1) {  // the library starts at 2
    Vec3d sum;
    for (const WeightedNormal& p : points) sum += Vec3d(p.normal) * double(p.weight);
    return {length(sum) > 1e-9 ? Vec3f(normalized(sum)) : points[0].normal};
  }
  constexpr double kLinearGamma = 0.57;  // of the library's own making: its internal gamma cancels it
  const auto check = [](liq_error e) {
    if (e != LIQ_OK) throw Error(ErrorKind::kInternal, "libimagequant: error " + std::to_string(e));
  };
  const std::unique_ptr<liq_attr, Destroy> attr(liq_attr_create());
  check(liq_set_max_colors(attr.get(), n));
  check(liq_set_speed(attr.get(), 1));
  const std::unique_ptr<liq_histogram, Destroy> histogram(liq_histogram_create(attr.get()));
  const auto byte = [](float v) { return static_cast<unsigned char>((0.5f * v + 0.5f) * 255.f + 0.5f); };
  std::vector<liq_histogram_entry> entries;
  for (const WeightedNormal& p : points)
    entries.push_back({{byte(p.normal.x), byte(p.normal.y), byte(p.normal.z), 255}, unsigned(std::max(1.f, p.weight))});
  check(liq_histogram_add_colors(histogram.get(), attr.get(), entries.data(), int(entries.size()), kLinearGamma));
  liq_result* raw = nullptr;
  check(liq_histogram_quantize(histogram.get(), attr.get(), &raw));
  const std::unique_ptr<liq_result, Destroy> result(raw);
  const liq_palette* palette = liq_get_palette(result.get());
  std::vector<Vec3f> out;
  for (unsigned i = 0; i < palette->count; i++) {
    const liq_color& c = palette->entries[i];
    const Vec3d v{c.r / 127.5 - 1, c.g / 127.5 - 1, c.b / 127.5 - 1};
    out.push_back(length(v) > 1e-3 ? Vec3f(normalized(v)) : Vec3f{0, 0, 1});
  }
  return out;
}

#else

bool has_imagequant() { return false; }

std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>&, int) {
  throw Error(ErrorKind::kUnsupported, "the engine imagequant is not part of this build (BURNISH_WITH_IMAGEQUANT)");
}

#endif

}  // namespace burnish
