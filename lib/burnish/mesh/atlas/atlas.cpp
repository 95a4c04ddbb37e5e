#include "burnish/mesh/atlas/atlas.h"

#include <utility>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/mesh/atlas/chart_packing.h"
#include "burnish/mesh/atlas/chart_tree.h"

namespace burnish {
namespace {

std::vector<FlatChart> flat_charts(const Mesh& mesh) {
  const ChartTree tree(mesh);
  std::vector<FlatChart> charts;
  std::vector<std::uint32_t> open = tree.roots();
  while (!open.empty()) {
    const std::uint32_t piece = open.back();
    open.pop_back();
    if (auto chart = flatten(mesh, tree.triangles(piece))) {
      charts.push_back(std::move(*chart));
    } else {
      open.push_back(tree.parts(piece).one);
      open.push_back(tree.parts(piece).two);
    }
  }
  return charts;
}

}  // namespace

AtlasStats add_atlas(Mesh& mesh, int size, const Progress& progress) {
  std::vector<FlatChart> charts = flat_charts(mesh);
  report_progress(progress, 0.2);
  if (!pack(charts, size, [&](double f) { report_progress(progress, 0.2 + 0.8 * f); }))
    throw file_error(ErrorKind::kMalformed, mesh.name,
                     "its " + std::to_string(charts.size()) + " charts do not fit into an atlas of " +
                         std::to_string(size) + "x" + std::to_string(size) + " texels");
  AtlasStats stats{.charts = charts.size()};
  mesh.uvs.clear();
  mesh.triangle_uvs.assign(mesh.triangles.size(), {});
  for (const FlatChart& chart : charts) {
    const std::uint32_t first = std::uint32_t(mesh.uvs.size());
    mesh.uvs.insert(mesh.uvs.end(), chart.points.begin(), chart.points.end());
    for (std::size_t t = 0; t < chart.triangles.size(); t++) {
      const auto [a, b, c] = chart.corners[t];
      mesh.triangle_uvs[chart.triangles[t]] = {first + a, first + b, first + c};
      stats.covered += cross(chart.points[b] - chart.points[a], chart.points[c] - chart.points[a]) / 2;
    }
  }
  return stats;
}

}  // namespace burnish
