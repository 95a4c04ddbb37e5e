// What a lighting model is asked, and what it answers.
//
// A model maps a normal to light, given the lights, the view and the ambient light (Tarini et al., section 5.1: the
// function f(n)). It answers in two parts, so that a base colour can be blended between them (section 7): what is
// reflected diffusely, which takes the surface's colour, and what is reflected on top of it, which does not.
#pragma once

#include <span>

#include "burnish/core/vec3.h"
#include "burnish/render/light.h"

namespace burnish {

// Unit vectors of the world, out of the surface.
struct Illumination {
  std::span<const Arriving> lights;
  Vec3d ambient;
  Vec3d to_viewer;
};

struct Shaded {
  Vec3d diffuse, specular;  // linear RGB

  friend Shaded operator+(const Shaded& a, const Shaded& b) { return {a.diffuse + b.diffuse, a.specular + b.specular}; }
};

// What a rotation may leave of an exact value: where a model has a step, it lies this far to one side, so that rounding
// does not decide whether a highlight appears.
inline constexpr double kRounding = 1e-9;

// Rec. 709: how bright a colour is, where one number must do.
inline double luminance(Vec3d c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// The viewer's direction mirrored at the surface.
inline Vec3d mirrored(Vec3d to_viewer, Vec3d n) { return n * (2 * dot(n, to_viewer)) - to_viewer; }

}  // namespace burnish
