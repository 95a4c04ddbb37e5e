#include "burnish/render/camera.h"

#include "burnish/core/portable_math.h"

namespace burnish {

Camera::Camera(const CameraSettings& settings, int width, int height)
    : perspective_(settings.type == CameraType::kPerspective),
      position_(settings.position),
      forward_(normalized(settings.look_at - settings.position)),
      half_width_px_(0.5 * width),
      half_height_px_(0.5 * height) {
  const Vec3d right = normalized(cross(forward_, settings.up));
  const Vec3d up = cross(right, forward_);
  const double extent = perspective_ ? 2 * portable::tan(0.5 * radians(settings.fov_deg)) : settings.height;
  step_x_ = right * (extent / height);  // pixels are square
  step_y_ = up * (-extent / height);
}

Ray Camera::ray(double x_px, double y_px) const {
  const Vec3d offset = step_x_ * (x_px - half_width_px_) + step_y_ * (y_px - half_height_px_);
  if (perspective_) return {position_, forward_ + offset, {}, {}, step_x_, step_y_};
  return {position_ + offset, forward_, step_x_, step_y_, {}, {}};
}

Vec3d Camera::to_viewer(Vec3d point) const { return perspective_ ? normalized(position_ - point) : -forward_; }

}  // namespace burnish
