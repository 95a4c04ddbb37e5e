#include "burnish/render/palette_table.h"

#include <algorithm>
#include <type_traits>

#include "burnish/core/parallel.h"
#include "burnish/render/table_kernels.h"

namespace burnish {
namespace {

constexpr std::size_t kRun = 512;     // entries whose intermediate values stay in the first-level cache
constexpr std::size_t kGrain = 4096;  // entries a task
constexpr double kSharpest = 1000;    // exponent up to which the vectorised power is exact enough

}  // namespace

const char* name(TableKind kind) {
  return kind == TableKind::kRgb ? "rgb" : kind == TableKind::kIntensity ? "intensity" : "intensity+rgb";
}

TableKind table_kind(Blend blend, std::span<const Material* const> materials) {
  if (blend == Blend::kMaterial) return TableKind::kRgb;
  const auto only_diffuse = [](const LightingModel& m) {
    return std::holds_alternative<Lambert>(m) || std::holds_alternative<Cartoon>(m);
  };
  const bool intensity =
      std::ranges::all_of(materials, [&](const Material* m) { return std::ranges::all_of(m->terms, only_diffuse); });
  return intensity ? TableKind::kIntensity : TableKind::kIntensityAndRgb;
}

namespace {

// Where a run of entries goes: the reflected part to three planes; the diffuse part to the same ones, or as α to one of
// its own. None: not stored.
struct Sink {
  float* specular[3]{};
  float* alpha = nullptr;

  void add_diffuse(const float* share, Vec3d colour, std::size_t count) const {
    if (alpha) kernels::add(share, float(luminance(colour)), count, alpha);
    else add_specular(share, colour, count);
  }
  void add_specular(const float* share, Vec3d colour, std::size_t count) const {
    kernels::add(share, Vec3f(colour), count, {specular[0], specular[1], specular[2]});
  }
  void start(Vec3d diffuse, std::size_t count) const {
    if (alpha) std::fill_n(alpha, count, float(luminance(diffuse)));
    const Vec3f rgb(alpha ? Vec3d{} : diffuse);
    if (!specular[0]) return;
    std::fill_n(specular[0], count, rgb.x), std::fill_n(specular[1], count, rgb.y),
        std::fill_n(specular[2], count, rgb.z);
  }
  void add_entry(const Shaded& s, std::size_t i) const {
    const Vec3d rgb = alpha ? s.specular : s.diffuse + s.specular;
    if (alpha) alpha[i] += float(luminance(s.diffuse));
    if (specular[0]) specular[0][i] += float(rgb.x), specular[1][i] += float(rgb.y), specular[2][i] += float(rgb.z);
  }
};

// How each model is evaluated over a run: those that see the light only through cosines by kernels, the others entry by
// entry by their own formula.
struct Run {
  kernels::Normals normals;  // of the run
  std::size_t count;
  const Illumination& world;  // but for the ambient light, which all entries start with
  const Rotation& rotation;
  Sink sink;

  void operator()(const Lambert& model) const {
    float share[kRun];
    for (const Arriving& light : world.lights) {
      kernels::lambert(normals, rotation.inverse(light.direction), count, share);
      sink.add_diffuse(share, light.colour * model.diffuse, count);
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
    float share[kRun], base[kRun], complement[kRun];
    for (const Arriving& light : world.lights) {
      reflect(normals, rotation.inverse(light.direction), to_viewer, count, {share, base, complement});
      sink.add_diffuse(share, light.colour * model.diffuse, count);
      kernels::power(base, complement, float(model.exponent), count, share);
      sink.add_specular(share, light.colour * model.specular, count);
    }
  }

  template <typename Model>
  void entry_by_entry(const Model& model) const {
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
                           const Transform& transform, TableKind kind)
    : materials_(materials), intervals_(palette.materials), rotation_(transform.rotation), kind_(kind) {
  for (const Vec3f& n : palette.normals) {
    const Vec3d s = transform.stretched_normal(Vec3d(n));
    x_.push_back(s.x), y_.push_back(s.y), z_.push_back(s.z);
  }
  const int channels = kind == TableKind::kRgb ? 3 : kind == TableKind::kIntensity ? 1 : 4;
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
        Sink sink;
        if (kind_ != TableKind::kIntensity)
          for (int c = 0; c < 3; c++) sink.specular[c] = planes_[c].data() + i;
        if (kind_ != TableKind::kRgb) sink.alpha = planes_.back().data() + i;
        sink.start(ambient, count);
        const Run run{{x_.data() + i, y_.data() + i, z_.data() + i}, count, lights, rotation_, sink};
        for (const LightingModel& term : terms) std::visit(run, term);
      }
    });
  }
}

}  // namespace burnish
