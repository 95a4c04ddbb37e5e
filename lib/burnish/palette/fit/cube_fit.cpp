#include "burnish/palette/fit/cube_fit.h"

#include <algorithm>

#include "burnish/palette/fit/colour_codebook.h"
#include "burnish/palette/fit/imagequant_engine.h"
#include "burnish/palette/fit/median_cut.h"

namespace burnish {
namespace {

using Groups = std::vector<std::vector<Vec3f>>;

// Distinct colours, ascending; different normals can have one.
std::vector<WeightedColour> colours_of(const std::vector<std::vector<WeightedNormal>>& groups,
                                       const MaterialCube& cube) {
  std::vector<WeightedColour> all;
  for (std::size_t g = 0; g < groups.size(); g++)
    for (const WeightedNormal& p : groups[g]) all.push_back({cube.encode(int(g), p.normal), p.weight});
  std::ranges::stable_sort(all, {}, &WeightedColour::colour);
  std::vector<WeightedColour> distinct;
  double weight = 0;  // floats would lose the small ones
  for (const WeightedColour& c : all) {
    if (distinct.empty() || distinct.back().colour != c.colour) distinct.push_back(c), weight = 0;
    distinct.back().weight = float(weight += c.weight);
  }
  return distinct;
}

std::vector<Colour> quantize(const std::vector<WeightedColour>& colours, Engine engine, int n) {
  switch (engine) {
    case Engine::kMedianCut:
      return fit_median_cut(colours, n);
    case Engine::kImagequant:
      return fit_imagequant(colours, n);
    default:
      return fit_colour_codebook(colours, n);
  }
}

}  // namespace

Groups meanings(const std::vector<Colour>& colours, const MaterialCube& cube, std::size_t materials) {
  Groups groups(materials);
  for (const Colour& c : colours) {
    const MaterialCube::Meaning m = cube.decode(c);
    groups[m.material].push_back(m.normal);
  }
  return groups;
}

Groups fit_in_cube(const std::vector<std::vector<WeightedNormal>>& groups, const MaterialCube& cube, Engine engine,
                   int n) {
  std::size_t points = 0;
  for (const auto& g : groups) points += g.size();
  Groups entries(groups.size());
  if (points <= std::size_t(n)) {
    for (std::size_t g = 0; g < groups.size(); g++)
      for (const WeightedNormal& p : groups[g]) entries[g].push_back(p.normal);
    return entries;
  }
  const std::vector<WeightedColour> colours = colours_of(groups, cube);
  for (int fitted = n;;) {
    const std::vector<Colour> quantized = quantize(colours, engine, fitted);
    entries = meanings(quantized, cube, groups.size());
    const int without = int(std::ranges::count_if(entries, [](const auto& e) { return e.empty(); }));
    if (int(quantized.size()) + without <= n) break;
    fitted = n - without;  // fewer each time: fewer colours leave no fewer materials without one, or it ends here
  }
  for (std::size_t g = 0; g < groups.size(); g++)
    if (entries[g].empty()) entries[g].push_back(mean_normal(groups[g]));
  return entries;
}

}  // namespace burnish
