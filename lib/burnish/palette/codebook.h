// Fits a palette of unit normals to a weighted set of them: the spherical engine.
//
// Minimises Σ w·|p − c(p)|² over the points p and their nearest entries c: the squared chord, which is the squared
// angle to within a few per cent even for cells 40° wide. Steps: split the set where that saves most (variance
// splitting) until there are N parts; Lloyd iterations, the centroid being the normalised sum; then entries that save
// little are moved into crowded cells, in batches that are kept only where the whole error falls (Patanè & Russo, "The
// enhanced LBG algorithm", Neural Networks 2001, in the large). At the optimum all cells err alike (Gersho), and E² ≥
// 5/(18√3)·(∫√density)²/N.
//
// Points come in groups (materials): an entry serves the points of its own group only, and the entries are shared out
// among the groups so that the total error is least, each group having at least one. Deterministic, whatever the
// threads.
#pragma once

#include <span>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/palette/fit/point_tree.h"

namespace burnish {

struct Codebook {
  std::vector<std::vector<Vec3f>> groups;  // unit entries of each group
  double error = 0;                        // Σ w·|p − c(p)|²
  int size() const;
};

// `groups` are not empty; their number is at most n. Where there are no more distinct points than n, the points are the
// entries. Points of a group are distinct. kMalformed where n is less than the number of groups.
Codebook fit_codebook(std::span<const std::vector<WeightedNormal>> groups, int n, const Progress& progress = {});

// kMalformed where n is less than the number of groups.
void require_an_entry_each(std::size_t groups, int n);

// How many of n entries each group gets by variance splitting alone, which always divides the part of largest error.
std::vector<int> share_entries(std::span<const std::vector<WeightedNormal>> groups, int n);

}  // namespace burnish
