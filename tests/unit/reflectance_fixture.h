// Objects with a reflectance, made in memory: maps, the textures baked of them, and tables.
#pragma once

#include "burnish/brdf/tables/table_error.h"
#include "burnish/brdf/ward.h"
#include "burnish/render/metrics.h"
#include "render_fixture.h"

namespace burnish::testing {

// Bumps whose normals lean up to `slope`, and a direction that turns over the map.
inline ReflectanceMaps bumpy_maps(int side, double slope, double alpha_x, double alpha_y, double k_s = 0.5,
                                  double exponent = 40) {
  ReflectanceMaps maps{{}, {}, true};
  MaterialMaps& m = maps.material;
  m.width = m.height = side;
  m.alpha_x.number = float(alpha_x), m.alpha_y.number = float(alpha_y);
  m.k_s.number = float(k_s), m.exponent.number = float(exponent);
  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++) {
      const double u = (x + 0.5) / side, v = 1 - (y + 0.5) / side, turn = kPi * (u + v);
      const Vec3d n{slope * std::sin(6 * kPi * u), slope * std::cos(4 * kPi * v), 1};
      maps.directions.push_back(Vec3f(Vec3d{std::cos(turn), std::sin(turn), 0}));
      m.n.push_back(Vec3f(normalized(n)));
      m.t.push_back(Vec3f(orthonormal_frame(n, Vec3d(maps.directions.back()))->t));
    }
  return maps;
}

// Rounded as 8 bits in the combiners' range are, or true values.
inline MaterialTextures baked(const ReflectanceMaps& maps, MaterialModel model, bool combiner) {
  const MaterialMaps& m = maps.material;
  MaterialTextures out;
  out.model = model;
  const auto with_alpha = [&](MaterialTexture& t, bool alpha) {
    t.levels.emplace_back(m.width, m.height, alpha ? 4 : 3);
  };
  with_alpha(out.t, model != MaterialModel::kWard);
  with_alpha(out.b, model == MaterialModel::kBlinnPhong);
  with_alpha(out.n, model == MaterialModel::kWard);
  if (combiner) {
    for (MaterialTexture* t : {&out.t, &out.b}) t->scale = {8, 8, 8, 1}, t->bias = {-4, -4, -4, 0};
    out.n.scale = {2, 2, 2, 1}, out.n.bias = {-1, -1, -1, 0};
  }
  if (model == MaterialModel::kBlinnPhong) out.b.scale[3] = 128;
  const auto store = [&](MaterialTexture& t, std::size_t i, Vec3d v, double alpha) {
    float* to = t.levels[0].data.data() + i * t.channels();
    const double values[] = {v.x, v.y, v.z, alpha};
    for (int c = 0; c < t.channels(); c++) {
      const double stored = (values[c] - t.bias[c]) / t.scale[c];
      to[c] = float(combiner ? std::floor(stored * 255 + 0.5) / 255 : stored);
    }
  };
  for (std::size_t i = 0; i < std::size_t(m.width) * m.height; i++) {
    const LocalFrame f = maps.frame(i);
    const bool banks = model == MaterialModel::kBanks;
    const Ward w{m.k_s.at(i), m.alpha_x.at(i), m.alpha_y.at(i)};
    store(out.t, i, f.t / (banks ? 1 : w.alpha_x), w.k_s);
    store(out.b, i, f.b / (banks ? 1 : w.alpha_y), m.exponent.at(i));
    store(out.n, i, f.n, ward_scale(w));
  }
  return out;
}

// One texel, direction t.
inline ReflectanceMaps one_texel(Vec3f t = {1, 0, 0}) {
  ReflectanceMaps maps{{}, {t}, false};
  maps.material.t = {t}, maps.material.n = {{0, 0, 1}};
  maps.material.k_s.number = 0.7f;
  return maps;
}

inline SceneTable table_of(LookupKind kind, int width, int height, TableLayout layout = TableLayout::kPlain,
                           double exponent = 16) {
  LookupFunction f;
  f.kind = kind, f.domain = default_domain(kind), f.exponent = exponent;
  const TableSampling sampling = layout == TableLayout::kPlain ? TableSampling::kEdge : TableSampling::kCentre;
  const LookupTable table = bake_table(f, width, height, sampling, layout);
  return {std::string(name(kind)) + ".exr",
          std::make_shared<const TableFile>(TableFile{f, as_stored(table, SampleType::kHalf)})};
}

// As tables are by default, in half.
inline SceneTables default_tables(TableLayout strand = TableLayout::kOffsetHalf, double exponent = 16) {
  return {{LookupKind::kBanksR, table_of(LookupKind::kBanksR, 256, 1)},
          {LookupKind::kBlinnPhongF, table_of(LookupKind::kBlinnPhongF, 256, 256)},
          {LookupKind::kWardS, table_of(LookupKind::kWardS, 256, 1)},
          {LookupKind::kWardE, table_of(LookupKind::kWardE, 256, 256)},
          {LookupKind::kStrand, table_of(LookupKind::kStrand, 256, 256, strand, exponent)}};
}

struct ReflectiveScene {
  Scene scene;
  ObjectAssets assets;
};

// One light from the upper left; of the quad all maps are seen once.
inline ReflectiveScene reflective(ReflectanceModel model, const ReflectanceMaps& maps, bool sphere = false,
                                  bool combiner = false) {
  ReflectiveScene s{sphere ? sphere_scene(64) : quad_scene(64), {}};
  s.scene.objects[0].normal_map.clear();
  s.scene.lights[0].direction = normalized(Vec3d{-0.5, 0.6, 1});
  Reflectance r;
  r.model = model, r.diffuse = {0.3, 0.2, 0.1}, r.specular = {0.6, 0.6, 0.6};
  s.scene.objects[0].reflectance = r;
  s.scene.tables = default_tables();
  s.assets.reflectance = maps;
  const bool blinn = model == ReflectanceModel::kBlinnPhong || model == ReflectanceModel::kBlinnPhongEquation1;
  const MaterialModel material = model == ReflectanceModel::kWard ? MaterialModel::kWard
                                 : blinn                          ? MaterialModel::kBlinnPhong
                                                                  : MaterialModel::kBanks;
  s.scene.objects[0].reflectance->source.model = material;
  if (!r.is_strand()) s.assets.textures = baked(maps, material, combiner);
  return s;
}

inline double psnr_db(const ReflectiveScene& s, RenderPath path) {
  const Frame a = render(s.scene, s.assets, path), b = render(s.scene, s.assets, RenderPath::kAnalytic);
  return compare(a.colour, b.colour, b.covered).psnr_db;
}

}  // namespace burnish::testing
