#include "burnish/render/anisotropy/reflectance_path.h"

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {
ReflectancePath::ReflectancePath(const FrameSetup& setup, RenderPath path) : setup_(setup), path_(path) {
  if (path == RenderPath::kAnalytic) return;
  for (const Object& o : setup.scene.objects)
    if (!o.reflectance) refuse("needs an [object.reflectance], and " + described(o) + " has none");
}

void ReflectancePath::refuse(const std::string& message) const {
  throw file_error(ErrorKind::kMalformed, setup_.scene.name, std::string("path '") + name(path_) + "' " + message);
}

const MaterialTextures& ReflectancePath::require_textures(std::size_t i, MaterialModel model) const {
  const Reflectance& r = reflectance(i);
  if (r.is_strand() || r.source.model != model)
    refuse(std::string("needs the model ") + name(model) + ", which " + described(object(i)) + " has not");
  if (!assets(i).textures)
    refuse("needs material textures (burnish-material), and " + described(object(i)) + " has none: 'textures'");
  return *assets(i).textures;
}

ReflectancePath::Extent ReflectancePath::extent_of_textures(std::size_t i) const {
  const MaterialTextures& t = *assets(i).textures;
  return {t.width(), t.height(), int(t.t.levels.size())};
}

Vec3d ReflectancePath::texture_normal(std::size_t i, const TextureTaps::Tap& tap) const {
  return Vec3d(assets(i).textures->n.vector(tap.level, tap.texel.x, tap.texel.y));
}

const TableFile& ReflectancePath::table(LookupKind kind, TableLayout layout) const {
  const auto found = setup_.scene.tables.find(kind);
  if (found == setup_.scene.tables.end()) {
    std::string key = name(kind);
    for (char& c : key)
      if (c == '-') c = '_';
    refuse("needs the table of " + std::string(name(kind)) + ", [tables] " + key);
  }
  const TableFile& table = *found->second.table;
  if (table.table.layout != layout)
    refuse_table(kind, std::string("the layout ") + name(layout), name(table.table.layout));
  return table;
}

void ReflectancePath::refuse_table(LookupKind kind, const std::string& wanted, const std::string& got) const {
  throw file_error(ErrorKind::kMalformed, setup_.scene.tables.at(kind).file,
                   "expected a table of " + wanted + ", as path '" + name(path_) + "' looks it up, got " + got);
}

void ReflectancePath::require_domain(const TableFile& table, int argument, Range wanted) const {
  const Range r = table.function.domain[argument];
  const auto text = [](Range of) { return number_text(of.least) + ":" + number_text(of.most); };
  if (r.least > wanted.least || r.most < wanted.most)
    refuse_table(table.function.kind, "a domain that holds " + text(wanted), text(r));
}

TextureTaps ReflectancePath::taps(std::size_t i, const SurfacePoint& point) const {
  const Object& o = object(i);
  const Extent e = extent(i);
  return texture_taps(point, {o.filter, o.mip, addressing_of(o.surface), setup_.samples}, e.width, e.height, e.levels);
}

Vec3d ReflectancePath::shade(std::size_t i, const SurfacePoint& point) const {
  const Object& o = object(i);
  const Reflectance& r = *o.reflectance;
  const LocalView view = local_view(setup_, i, point);
  const TextureTaps taps = this->taps(i, point);
  const BaseSample base = base_sample(o, assets(i), point, o.filter);
  const Vec3d specular = r.specular * (r.gloss ? base.alpha : 1);
  Vec3d sum = setup_.scene.ambient * r.ambient * base.colour;
  for (std::size_t light = 0; light < view.lights.size(); light++) {
    const Reflected part = reflect(i, taps, light, view.lights[light].direction, view.to_viewer);
    sum += view.lights[light].colour * combined(r.diffuse * base.colour * part.diffuse, specular * part.specular);
  }
  return sum;
}

LookedUp ReflectancePath::look_up(std::size_t i, const SurfacePoint& point) const {
  const TextureTaps::Tap tap = taps(i, point).main();
  LookedUp out;
  out.normal = point.tangent_to_object(normal(i, tap));
  out.level = tap.level;
  return out;
}

}  // namespace burnish
