#include "burnish/palette/fit/imagequant_engine.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "burnish/core/error.h"
#include "burnish/palette/fit/colour_codebook.h"

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

// n is at least 2, where the library starts.
std::vector<liq_color> quantize(const std::vector<liq_histogram_entry>& colours, int n) {
  if (n > kImagequantMost)
    throw Error(ErrorKind::kUnsupported, "engine: imagequant holds at most 256 normals, not " + std::to_string(n));
  constexpr double kLinearGamma = 0.57;  // of the library's own making: its internal gamma cancels it
  const auto check = [](liq_error e) {
    if (e != LIQ_OK) throw Error(ErrorKind::kInternal, "libimagequant: error " + std::to_string(e));
  };
  const std::unique_ptr<liq_attr, Destroy> attr(liq_attr_create());
  check(liq_set_max_colors(attr.get(), n));
  check(liq_set_speed(attr.get(), 1));
  const std::unique_ptr<liq_histogram, Destroy> histogram(liq_histogram_create(attr.get()));
  check(liq_histogram_add_colors(histogram.get(), attr.get(), colours.data(), int(colours.size()), kLinearGamma));
  liq_result* raw = nullptr;
  check(liq_histogram_quantize(histogram.get(), attr.get(), &raw));
  const std::unique_ptr<liq_result, Destroy> result(raw);
  const liq_palette* palette = liq_get_palette(result.get());
  return {palette->entries, palette->entries + palette->count};
}

unsigned count_of(float weight) { return unsigned(std::max(1.f, weight)); }

}  // namespace

bool has_imagequant() { return true; }

std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>& points, int n) {
  if (n == 1) return {mean_normal(points)};
  const auto byte = [](float v) { return static_cast<unsigned char>((0.5f * v + 0.5f) * 255.f + 0.5f); };
  std::vector<liq_histogram_entry> colours;
  for (const WeightedNormal& p : points)
    colours.push_back({{byte(p.normal.x), byte(p.normal.y), byte(p.normal.z), 255}, count_of(p.weight)});
  std::vector<Vec3f> out;
  for (const liq_color& c : quantize(colours, n)) {
    const Vec3d v{c.r / 127.5 - 1, c.g / 127.5 - 1, c.b / 127.5 - 1};
    out.push_back(length(v) > 1e-3 ? Vec3f(normalized(v)) : Vec3f{0, 0, 1});
  }
  return out;
}

std::vector<Colour> fit_imagequant(const std::vector<WeightedColour>& points, int n) {
  if (n == 1) return fit_colour_codebook(points, 1);  // the mean
  const auto byte = [](float v) { return static_cast<unsigned char>(v + 0.5f); };
  std::vector<liq_histogram_entry> colours;
  for (const WeightedColour& p : points)
    colours.push_back(
        {{byte(p.colour[0]), byte(p.colour[1]), byte(p.colour[2]), byte(p.colour[3])}, count_of(p.weight)});
  std::vector<Colour> out;
  for (const liq_color& c : quantize(colours, n)) out.push_back({float(c.r), float(c.g), float(c.b), float(c.a)});
  return out;
}

#else

namespace {

[[noreturn]] void not_linked() {
  throw Error(ErrorKind::kUnsupported, "engine: imagequant is not part of this build (BURNISH_WITH_IMAGEQUANT)");
}

}  // namespace

bool has_imagequant() { return false; }
std::vector<Vec3f> fit_imagequant(const std::vector<WeightedNormal>&, int) { not_linked(); }
std::vector<Colour> fit_imagequant(const std::vector<WeightedColour>&, int) { not_linked(); }

#endif

}  // namespace burnish
