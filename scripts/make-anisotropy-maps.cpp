// Makes what the samples of anisotropic reflectance are baked from.
//
//   make-anisotropy-maps DIRECTORY [SIDE]      SIDE texels of the tiles, 1024 by default; half as many rows for spheres
//
// clang-format off
//   bumps.png          height of a few domes, 48² texels
//   scratches_*        a tile scratched along u and v: _t.exr directions, _alpha_x.png, _alpha_y.png, _ks.png
//   brushed_u_*        metal brushed along u, for a sphere: .png height, _t.exr directions; brushed_v_* along v
//   vase_t.exr         directions of a brushed vase, as large as what make-vase makes
//   hammered.png       height of a hammered, slightly brushed sphere
//   marble_*           a marble sphere: _color.png in sRGB, _height.png of its raised veins, _alpha_y.png larger where it is dark
//   record_*           a record on a brushed plate: _t.exr directions, _color.png in sRGB with gloss in its alpha
// clang-format on
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "noise.h"
#include "program.h"
#include "scratches.h"

using namespace burnish;

namespace {

double ramp(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
Vec3d mix(Vec3d a, Vec3d b, double t) { return a * (1 - t) + b * t; }

// value(u, v) at the centres of texels; v runs up.
template <typename Value>
Image map_of(int width, int height, int channels, const Value& value) {
  Image image(width, height, channels);
  parallel_for(height, [&](std::size_t y) {
    for (int x = 0; x < width; x++) value((x + 0.5) / width, 1 - (y + 0.5) / height, image.at(x, int(y)));
  });
  return image;
}
template <typename Value>
Image numbers(int width, int height, const Value& value) {
  return map_of(width, height, 1, [&](double u, double v, float* out) { *out = float(value(u, v)); });
}
template <typename Value>
Image vectors(int width, int height, const Value& value) {
  return map_of(width, height, 3, [&](double u, double v, float* out) {
    const Vec3d d = value(u, v);
    out[0] = float(d.x), out[1] = float(d.y), out[2] = float(d.z);
  });
}
Vec3d turned(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

Vec3d on_sphere(double u, double v) {
  const double longitude = 2 * kPi * (u - 0.5), latitude = kPi * (v - 0.5);
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
}

// Noise that is drawn out along u or along v; u goes round, so that its ends meet.
double streaks(double u, double v, bool along_u, int seed) {
  double sum = 0, amplitude = 0.5;
  for (int octave = 0; octave < 3; octave++, amplitude *= 0.6) {
    const double fine = 40.0 * (1 << octave), long_ = 0.7 * (1 << octave);
    const double round = (along_u ? long_ : 1.5 * fine) / kPi, up = along_u ? fine * 2 : long_;
    sum += amplitude * noise({round * std::cos(2 * kPi * u), round * std::sin(2 * kPi * u), up * v}, seed + octave);
  }
  return sum;
}

// Domes with a steep rim.
double bumps(double u, double v) {
  const double x = 3 * u - std::floor(3 * u) - 0.5, y = 3 * v - std::floor(3 * v) - 0.5;
  return std::sqrt(std::max(0.0, 1 - (x * x + y * y) / 0.14));
}

// Dents of a hammer: bowls that meet in rounded ridges.
double hammered(double u, double v) {
  const Vec3d p = on_sphere(u, v) * 5;
  const int x = int(std::floor(p.x)), y = int(std::floor(p.y)), z = int(std::floor(p.z));
  constexpr double kSharpness = 6;
  double sum = 0;
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      for (int k = -1; k <= 1; k++) {
        const auto at = [&](int seed) { return 0.1 + 0.8 * hash(x + i, y + j, z + k, seed); };
        const Vec3d d = Vec3d{x + i + at(70), y + j + at(71), z + k + at(72)} - p;
        sum += std::exp(-kSharpness * dot(d, d));
      }
  return std::clamp(-std::log(sum) / kSharpness + 0.1 + 0.012 * streaks(u, v, true, 75), 0.0, 1.0);
}

// How dark the marble is, how far its veins rise, and thin ones that lie in the surface, in [0,1].
struct Marble {
  double dark, vein, thin;
};
Marble marble(double u, double v) {
  const Vec3d p = on_sphere(u, v) * 1.4;
  const auto wander = [&](double scale, int seed) { return turbulence(p * scale, 5, seed); };
  const Vec3d bent = p + Vec3d{wander(1.3, 80), wander(1.3, 90), wander(1.3, 100)} * 0.8;
  const double coarse = std::abs(turbulence(bent * 1.5, 2, 110)), fine = std::abs(turbulence(bent * 3.4, 2, 120));
  const double cloud = turbulence(bent * 1.1 + Vec3d{5, 2, 8}, 5, 130);
  const double vein = 1 - ramp(0.012, 0.050, coarse), thin = 0.5 * (1 - ramp(0.004, 0.030, fine));
  return {ramp(-0.28, 0.30, cloud + 0.3 * wander(6, 140)), vein, thin};
}
Vec3d marble_colour(double u, double v) {
  const Marble m = marble(u, v);
  const Vec3d ground = mix({0.66, 0.74, 0.66}, {0.09, 0.27, 0.21}, m.dark);
  return mix(mix(ground, {0.86, 0.86, 0.76}, m.thin), {0.98, 0.94, 0.84}, m.vein);
}

// Grooves go round the middle; tracks are parted by smooth rings. Around the record lies a brushed plate.
constexpr double kLabel = 0.33, kEdge = 0.94;
struct Groove {
  double radius, angle, ring;  // of the texel, and noise that is the same all round
};
Groove groove(double u, double v) {
  const double x = 2 * u - 1, y = 2 * v - 1, r = std::hypot(x, y);
  return {r, std::atan2(y, x), noise({r * 160, 0.5, 0.5}, 150)};
}
bool between_tracks(double r) { return std::fmod(r, 0.145) > 0.137 || r < kLabel + 0.05 || r > kEdge - 0.02; }
Vec3d record_direction(double u, double v) {
  const Groove g = groove(u, v);
  if (g.radius > kEdge) return turned(0.06 * streaks(u, v, true, 160));
  const double waver = g.radius < kLabel || between_tracks(g.radius) ? 0 : 0.10 * g.ring;
  return turned(g.angle + 0.5 * kPi + waver);
}
void record_colour(double u, double v, float* out) {
  const Groove g = groove(u, v);
  Vec3d colour{0.11, 0.10, 0.11};
  double gloss = between_tracks(g.radius) ? 0.45 : 0.9;
  if (g.radius > kEdge) {
    colour = mix({0.45, 0.27, 0.18}, {0.58, 0.37, 0.25}, 0.5 + streaks(u, v, true, 165)), gloss = 0.5;
  } else if (g.radius < kLabel) {
    const bool band = (g.radius > 0.25 && g.radius < 0.265) || (g.radius > 0.10 && g.radius < 0.11);
    const bool ray = g.radius > 0.13 && g.radius < 0.23 && std::fmod(g.angle + 4 * kPi, kPi / 6) < kPi / 14;
    colour = band || ray ? Vec3d{0.93, 0.83, 0.62} : Vec3d{0.62, 0.10, 0.10}, gloss = 0.06;
    if (g.radius < 0.025) colour = {0.02, 0.02, 0.02}, gloss = 0;
  }
  out[0] = float(colour.x), out[1] = float(colour.y), out[2] = float(colour.z), out[3] = float(gloss);
}

class Folder {
 public:
  explicit Folder(std::string directory) : directory_(std::move(directory)) {}
  void heights(const std::string& name, const Image& image) const { png(name, SampleType::kUint16, image); }
  void colours(const std::string& name, const Image& image) const { png(name, SampleType::kUint8, image); }
  void directions(const std::string& name, const Image& image) const {
    write_image(directory_ + "/" + name, FileType::kExr, SampleType::kHalf, image);
  }

 private:
  void png(const std::string& name, SampleType sample, const Image& image) const {
    write_image(directory_ + "/" + name, FileType::kPng, sample, image);
  }
  std::string directory_;
};

void write_scratches(const Folder& folder, int side) {
  const std::vector<Scratched> tile = scratched_tile(side, side);
  Image t(side, side, 3), alpha_x(side, side, 1), alpha_y(side, side, 1), k_s(side, side, 1);
  for (std::size_t i = 0; i < tile.size(); i++) {
    t.data[3 * i] = float(tile[i].direction.x), t.data[3 * i + 1] = float(tile[i].direction.y);
    alpha_x.data[i] = float(tile[i].alpha_x), alpha_y.data[i] = float(tile[i].alpha_y);
    k_s.data[i] = float(tile[i].k_s);
  }
  folder.directions("scratches_t.exr", t);
  folder.colours("scratches_alpha_x.png", alpha_x), folder.colours("scratches_alpha_y.png", alpha_y);
  folder.colours("scratches_ks.png", k_s);
}

void write(const std::string& directory, int side) {
  const Folder folder(directory);
  const int half = side / 2;
  folder.heights("bumps.png", numbers(48, 48, bumps));
  write_scratches(folder, side);
  for (const bool along_u : {true, false}) {
    const std::string name = along_u ? "brushed_u" : "brushed_v";
    folder.heights(name + ".png",
                   numbers(side, half, [&](double u, double v) { return 0.5 + 0.5 * streaks(u, v, along_u, 62); }));
    folder.directions(name + "_t.exr", vectors(side, half, [&](double u, double v) {
                        return turned((along_u ? 0 : 0.5 * kPi) + 0.2 * streaks(u, v, along_u, 66));
                      }));
  }
  folder.directions("vase_t.exr",
                    vectors(1536, 1152, [](double u, double v) { return turned(0.08 * streaks(u, v, true, 170)); }));
  folder.heights("hammered.png", numbers(side, half, hammered));
  folder.colours("marble_color.png", vectors(side, half, marble_colour));
  folder.heights("marble_height.png", numbers(side, half, [](double u, double v) { return marble(u, v).vein; }));
  folder.colours("marble_alpha_y.png", numbers(side, half, [](double u, double v) {
                   const Marble m = marble(u, v);
                   return 0.3 + 0.7 * m.dark * (1 - m.vein);
                 }));
  folder.directions("record_t.exr", vectors(side, side, record_direction));
  folder.colours("record_color.png", map_of(side, side, 4, record_colour));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-anisotropy-maps DIRECTORY [SIDE]", argc, argv,
                     [](const Arguments& a) { write(a[0], integer_argument(a, 1, 1024, 16, 32768)); });
}
