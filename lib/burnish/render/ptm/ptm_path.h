// The paths of polynomial texture maps, and their twins.
#pragma once

#include "burnish/render/shading_path.h"

namespace burnish {

// The listing of Rost, OpenGL Shading Language, 14.4.3: filtered texels, scale and bias and the polynomial in single
// precision, times the light factor of the table. Spatial maps (kPtm) are looked up at the texture coordinates, with l
// in tangent space; BRDF PTMs (kPtmBrdf) by what ptm.json says, bilinearly and clamped. What is below 0 counts as 0, as
// in a frame buffer; lights add up. kMalformed where an object has no [object.ptm] of the path's kind, or the scene no
// table.
std::unique_ptr<ShadingPath> make_ptm_path(const FrameSetup& setup, RenderPath path);

// What the analytic path is for objects with a PTM, in double precision: the reference's coefficients, or the
// reflectance itself; times the light factor's formula.
class AnalyticPtm {
 public:
  explicit AnalyticPtm(const FrameSetup& setup);
  ~AnalyticPtm();
  Vec3d shade(std::size_t object, const SurfacePoint& point) const;
  LookedUp look_up(std::size_t object, const SurfacePoint& point) const;

 private:
  std::unique_ptr<ShadingPath> path_;  // none where the scene has no such object
};

}  // namespace burnish
