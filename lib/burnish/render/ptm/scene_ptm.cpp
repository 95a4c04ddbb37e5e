#include "burnish/render/ptm/scene_ptm.h"

#include "burnish/brdf/measured/measured_brdf.h"
#include "burnish/brdf/model_brdf.h"
#include "burnish/core/error.h"
#include "burnish/ptm/files/ptm_textures.h"

namespace burnish {
namespace {

// What on a command line is an error of usage is the scene's here.
void require_source(const TomlTable& t, const std::string& source) try {
  if (is_model_source(source)) model_brdf(source);
  else require_measurements(source);
} catch (const Error& error) {
  t.fail("brdf", error.what());
}

}  // namespace

std::vector<std::string> PtmSource::files() const {
  std::vector<std::string> out;
  for (const std::string& file : {map, reference}) {
    if (!file.ends_with('/')) out.push_back(file);
    else
      for (const std::string& leaf : ptm_texture_names()) out.push_back(file + leaf);
  }
  if (is_brdf() && !is_model_source(brdf)) out.push_back(brdf);
  return out;
}

PtmSource parse_ptm(const TomlTable& t, const std::string& directory) {
  PtmSource p;
  p.map = t.file("map", directory);
  if (p.map.empty()) t.fail("map", "expected the file of the map, or the PREFIX/ of its textures, got nothing");
  if (t.has("brdf")) {
    p.brdf = t.text("brdf");
    if (p.brdf.empty()) t.fail("brdf", "expected a model or the file of measurements, got ''");
    require_source(t, p.brdf);
    if (!is_model_source(p.brdf)) p.brdf = t.file("brdf", directory);
    if (!p.map.ends_with('/'))
      t.fail("map", "expected the PREFIX/ of textures beside 'brdf', whose ptm.json says what they are addressed by");
    if (t.has("ceiling")) p.ceiling = t.number("ceiling", kPositive);
    p.srgb = false;
  } else {
    p.reference = t.file("reference", directory);
    p.srgb = t.choice<bool>("transfer", {{"srgb", true}, {"linear", false}}, p.srgb);
  }
  t.refuse_unknown();
  return p;
}

}  // namespace burnish
