// A path held against its analytic twin: pictures of both, the difference as heat, the figures, and the
// verdict.
//
// Figures are of linear RGB over the pixels that show an object in either picture (metrics.h). A tolerance is
// met by equality.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/progress.h"
#include "burnish/render/assets.h"
#include "burnish/render/metrics.h"
#include "burnish/render/scene.h"

namespace burnish {

struct ValidationFiles {
  FileRef picture, twin, difference;  // PNG: sRGB, sRGB, heat
  FileRef json, html;                 // formats: samples/README.md; the page holds the pictures itself
};

struct ToleranceCheck {
  std::string name;  // as in the scene
  double allowed, got;
  bool met;
};

struct Validation {
  RenderPath path;
  ErrorMetrics metrics;
  double table_ms = 0;
  double heat_max = 0;  // difference that takes the heat map's last colour
  std::vector<ToleranceCheck> checks;

  bool passed() const;
  // "max_abs 0.02 is above 0.01; …" of what was not met; empty where all was.
  std::string misses() const;
};

std::vector<ToleranceCheck> check_tolerances(const Tolerances& tolerances, const ErrorMetrics& metrics);

// kUsage for the path analytic, which is the twin itself.
void require_twin(RenderPath path);

// Renders, compares and writes all files. Everything but table_ms in the JSON is the same in any run.
// As require_twin; kMalformed where no pixel shows an object.
Validation validate(const Scene& scene, const std::vector<ObjectAssets>& assets, RenderPath path,
                    const ValidationFiles& files, const Progress& progress = {});

}  // namespace burnish
