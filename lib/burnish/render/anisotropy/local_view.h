// Light and view as a point of the surface sees them: in its tangent frame, which is interpolated over the surface and
// made orthonormal at each point (Kautz & Seidel, section 4: the vectors of all material textures are in one local
// coordinate system).
#pragma once

#include <vector>

#include "burnish/render/shading_path.h"

namespace burnish {

struct LocalView {
  Vec3d to_viewer;               // unit, as are the lights' directions
  std::vector<Arriving> lights;  // in the order of the scene
};

LocalView local_view(const FrameSetup& setup, std::size_t object, const SurfacePoint& point);

}  // namespace burnish
