#include "burnish/render/palette/palette_table.h"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include "burnish/core/parallel.h"
#include "burnish/render/palette/table_kernels.h"

namespace burnish {
namespace {

constexpr std::size_t kRun = 512;     // entries whose intermediate values stay in the first-level cache
constexpr std::size_t kGrain = 4096;  // entries a task
constexpr double kSharpest = 1000;    // exponent up to which the vectorised power is exact enough

TableKind table_kind(Blend blend, std::span<const Material* const> materials) {
  if (blend == Blend::kMaterial) return TableKind::kRgb;
  const auto only_diffuse = [](const LightingModel& m) {
    return std::holds_alternative<Lambert>(m) || std::holds_alternative<Cartoon>(m);
  };
  const bool intensity =
      std::ranges::all_of(materials, [&](const Material* m) { return std::ranges::all_of(m->terms, only_diffuse); });
  return intensity ? TableKind::kIntensity : TableKind::kIntensityAndRgb;
}

// Where a run of entries goes: what is reflected on top to three planes; the diffuse part to the same ones, or as α to
// one of its own. Null: not stored. The first to write a plane starts it with what it is to begin with.
class Sink {
 public:
  Sink(kernels::Colours rgb, float* alpha, Vec3d start, std::size_t count)
      : rgb_(rgb), alpha_(alpha), count_(count), alpha_start_(float(luminance(start))) {
    rgb_start_ = alpha ? Vec3f{} : Vec3f(start);
  }

  void add_diffuse(const float* share, Vec3d colour) {
    if (alpha_) kernels::add(share, float(luminance(colour)), take(alpha_start_), count_, alpha_);
    else kernels::add(share, Vec3f(colour), take(rgb_start_), count_, rgb_);
  }
  void add_highlight(kernels::Reflection in, Vec3d diffuse, Vec3d specular, float exponent) {
    if (alpha_) add_diffuse(in.lambert, diffuse);
    const Vec3f on_rgb = alpha_ ? Vec3f{} : Vec3f(diffuse);
    kernels::add_highlight(in.lambert, in.base, in.complement, on_rgb, Vec3f(specular), exponent, take(rgb_start_),
                           count_, rgb_);
  }
  // After start_planes().
  void add_entry(const Shaded& s, std::size_t i) {
    const Vec3d rgb = alpha_ ? s.specular : s.diffuse + s.specular;
    if (alpha_) alpha_[i] += float(luminance(s.diffuse));
    if (rgb_.r) rgb_.r[i] += float(rgb.x), rgb_.g[i] += float(rgb.y), rgb_.b[i] += float(rgb.z);
  }
  // For planes that nothing was added to, or is added to entry by entry.
  void start_planes() {
    if (const auto start = take(alpha_start_); start && alpha_) std::fill_n(alpha_, count_, *start);
    if (const auto start = take(rgb_start_); start && rgb_.r) {
      std::fill_n(rgb_.r, count_, start->x);
      std::fill_n(rgb_.g, count_, start->y);
      std::fill_n(rgb_.b, count_, start->z);
    }
  }

 private:
  template <typename T>
  static std::optional<T> take(std::optional<T>& start) {
    return std::exchange(start, std::nullopt);
  }

  kernels::Colours rgb_;
  float* alpha_;
  std::size_t count_;
  std::optional<float> alpha_start_;
  std::optional<Vec3f> rgb_start_;
};

// How each model is evaluated over a run: those that see the light only through cosines by kernels, the others entry by
// entry by their own formula.
struct Run {
  kernels::Normals normals;  // of the run
  std::size_t count;
  const Illumination& world;  // but for the ambient light, which all entries start with
  const Rotation& rotation;
  Sink& sink;

  void operator()(const Lambert& model) const {
    float share[kRun];
    for (const Arriving& light : world.lights) {
      kernels::lambert(normals, rotation.inverse(light.direction), count, share);
      sink.add_diffuse(share, light.colour * model.diffuse);
    }
  }
  void operator()(const Phong& model) const { glossy(model, kernels::reflect); }
  void operator()(const NprDouble& model) const { glossy(model, kernels::reflect_doubled); }
  template <typename Model>
  void operator()(const Model& model) const {
    entry_by_entry(model);
  }

  template <typename Model, typename Reflect>
  void glossy(const Model& model, const Reflect& reflect) const {
    if (!(model.exponent > 0 && model.exponent <= kSharpest)) return entry_by_entry(model);
    const Vec3d to_viewer = rotation.inverse(world.to_viewer);
    float lambert[kRun], base[kRun], complement[kRun];
    const kernels::Reflection reflection{lambert, base, complement};
    for (const Arriving& light : world.lights) {
      reflect(normals, rotation.inverse(light.direction), to_viewer, count, reflection);
      sink.add_highlight(reflection, light.colour * model.diffuse, light.colour * model.specular,
                         float(model.exponent));
    }
  }

  template <typename Model>
  void entry_by_entry(const Model& model) const {
    sink.start_planes();
    for (std::size_t i = 0; i < count; i++)
      sink.add_entry(model.shade(rotation.apply({normals.x[i], normals.y[i], normals.z[i]}), world), i);
  }
};

// What a model reflects of ambient light, whatever the normal.
Vec3d ambient_reflectance(const LightingModel& model) {
  return std::visit(
      [](const auto& m) -> Vec3d {
        if constexpr (std::is_base_of_v<Lambert, std::remove_cvref_t<decltype(m)>>) return m.ambient;
        return {};
      },
      model);
}

}  // namespace

PaletteTable::PaletteTable(const Palette& palette, std::span<const Material* const> materials,
                           const Transform& transform, Blend blend)
    : materials_(materials),
      intervals_(palette.materials),
      rotation_(transform.rotation),
      kind_(table_kind(blend, materials)) {
  for (const Vec3f& n : palette.normals) {
    const Vec3d s = transform.stretched_normal(Vec3d(n));
    x_.push_back(s.x), y_.push_back(s.y), z_.push_back(s.z);
  }
  const int channels = kind_ == TableKind::kRgb ? 3 : kind_ == TableKind::kIntensity ? 1 : 4;
  planes_.assign(channels, std::vector<float>(palette.normals.size()));
}

void PaletteTable::shade(const Illumination& world) {
  const Illumination lights{world.lights, {}, world.to_viewer};
  for (std::size_t m = 0; m < intervals_.size(); m++) {
    const std::vector<LightingModel>& terms = materials_[m]->terms;
    Vec3d ambient;
    for (const LightingModel& term : terms) ambient += world.ambient * ambient_reflectance(term);
    const std::size_t first = intervals_[m].first;
    parallel_for_chunks(intervals_[m].count, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = first + begin; i < first + end; i += kRun) {
        const std::size_t count = std::min(kRun, first + end - i);
        const auto rgb = kind_ == TableKind::kIntensity
                             ? kernels::Colours{}
                             : kernels::Colours{planes_[0].data() + i, planes_[1].data() + i, planes_[2].data() + i};
        Sink sink(rgb, kind_ == TableKind::kRgb ? nullptr : planes_.back().data() + i, ambient, count);
        const Run run{{x_.data() + i, y_.data() + i, z_.data() + i}, count, lights, rotation_, sink};
        for (const LightingModel& term : terms) std::visit(run, term);
        sink.start_planes();
      }
    });
  }
}

}  // namespace burnish
