// Environment mapping: what a mirror shows of a latitude-longitude panorama (Tarini et al., section 5.1, number 3).
//
// A direction d of the world is looked up at u = ½ + atan2(d.x, −d.z)/2π, v = ½ + asin(d.y)/π: the panorama's middle
// lies towards −z, its right half towards +x, its top row is up. Bilinear; it goes round in u and ends in v.
#pragma once

#include <memory>
#include <string>

#include "burnish/core/image_io.h"
#include "burnish/render/lighting/lighting.h"

namespace burnish {

class Panorama {
 public:
  // kMalformed unless the file has one, or three or more channels, of finite values.
  static std::shared_ptr<const Panorama> read(const FileRef& file);
  explicit Panorama(Image image) : image_(std::move(image)) {}

  // Whether its file holds integers: seldom linear light, which they are taken for.
  bool integer() const { return integer_; }

  Vec3d at(Vec3d direction) const;

 private:
  Image image_;  // linear RGB, or one channel for all three
  bool integer_ = false;
};

struct Environment {
  std::string file;                          // of the panorama
  std::shared_ptr<const Panorama> panorama;  // read with the scene's other files
  Vec3d specular{1, 1, 1};                   // multiplies what is mirrored
  double turn_rad = 0;                       // of the panorama about the world's +y

  Shaded shade(Vec3d n, const Illumination& in) const;
};

}  // namespace burnish
