// The page that shows a validation: verdict, figures, pictures. It holds its pictures itself, so that it can
// be mailed or kept as it is, and names no path beyond the scene's file name.
#pragma once

#include <string>

#include "burnish/render/scene.h"
#include "burnish/render/validate.h"

namespace burnish {

// PNG files as bytes.
struct ValidationPictures {
  std::string picture, twin, difference;
};

std::string validation_html(const Scene& scene, const Validation& validation, const ValidationPictures& pictures);

}  // namespace burnish
