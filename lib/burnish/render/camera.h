// Pixels to rays, with their derivatives.
//
// The camera looks from `position` towards `look_at`; `up` points to the picture's top. Pixel coordinates run
// right and down from the picture's upper left corner, so that pixel (i, j) has its centre at (i + ½, j + ½).
#pragma once

#include "burnish/core/vec3.h"

namespace burnish {

enum class CameraType { kOrthographic, kPerspective };

struct CameraSettings {
  CameraType type = CameraType::kOrthographic;
  Vec3d position{0, 0, 2}, look_at{0, 0, 0}, up{0, 1, 0};
  double height = 1;    // orthographic: extent of the picture, in the world's units
  double fov_deg = 40;  // perspective: angle between the picture's top and bottom
};

// The point at parameter t is origin + t · direction; the direction is not a unit vector. d…_dx, d…_dy:
// change per pixel.
struct Ray {
  Vec3d origin, direction;
  Vec3d dorigin_dx, dorigin_dy, ddirection_dx, ddirection_dy;
};

class Camera {
 public:
  // Position and look_at differ and `up` is not along the view: read_scene has refused all else.
  Camera(const CameraSettings& settings, int width, int height);

  Ray ray(double x_px, double y_px) const;
  // Unit vector from a point of the world to the viewer.
  Vec3d to_viewer(Vec3d point) const;
  // Distance of a point from the plane through the camera across its view.
  double depth(Vec3d point) const { return dot(point - position_, forward_); }

 private:
  bool perspective_;
  Vec3d position_, forward_;
  Vec3d step_x_,
      step_y_;  // change per pixel: of the origin, or of the direction where the view is perspective
  double half_width_px_, half_height_px_;
};

}  // namespace burnish
