// Makes a Greek vase: a coarse mesh turned on a lathe, and the maps of its painting.
//
//   make-vase DIRECTORY
//
// clang-format off
//   vase.obj               1428 triangles; u once round, v along the profile from the foot over the lip into the neck
//   vase_ids.png           material of each texel: 0 clay, 1 paint
//   vase_plain.png         displacement: none
//   vase_paint.png         displacement: thick paint
//   vase_engraved.png      displacement: the paint, and flowers and a zigzag cut in, rough inside
//   vase_engraved_ids.png  the same materials, and 2 where something is cut in
// clang-format on
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/mesh.h"
#include "noise.h"
#include "program.h"
#include "vase_painting.h"

using namespace burnish;

namespace {

constexpr int kWidth = 1536, kHeight = 1152, kAround = 28, kAlong = 26;

// Radius and height: foot, stem, body, shoulder, neck, lip, and back down inside.
constexpr std::array<Vec2d, 21> kProfile{
    {{0.00, -0.98}, {0.16, -0.99}, {0.30, -1.00}, {0.33, -0.96}, {0.27, -0.89}, {0.20, -0.83}, {0.27, -0.71},
     {0.43, -0.52}, {0.57, -0.24}, {0.62, 0.04},  {0.57, 0.29},  {0.42, 0.49},  {0.26, 0.60},  {0.20, 0.71},
     {0.21, 0.83},  {0.28, 0.93},  {0.35, 0.98},  {0.32, 1.00},  {0.22, 0.93},  {0.16, 0.78},  {0.14, 0.62}}};

// A smooth curve through the profile's points, by length: v runs from 0 to 1.
class Profile {
 public:
  Profile() {
    constexpr int kSteps = 64;
    for (std::size_t i = 0; i + 1 < kProfile.size(); i++)
      for (int k = 0; k < kSteps; k++) add(on_curve(int(i), double(k) / kSteps));
    add(kProfile.back());
  }

  double length() const { return lengths_.back(); }

  Vec2d at(double v) const {
    const double l = v * length();
    const std::size_t i =
        std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(lengths_, l) - lengths_.begin(), 1, points_.size() - 1);
    const double t = (l - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
    return points_[i - 1] * (1 - t) + points_[i] * t;
  }

 private:
  // Catmull-Rom.
  static Vec2d on_curve(int i, double t) {
    const auto p = [](int k) { return kProfile[std::clamp(k, 0, int(kProfile.size()) - 1)]; };
    const Vec2d a = p(i - 1), b = p(i), c = p(i + 1), d = p(i + 2);
    const Vec2d q = b * 2 + (c - a) * t + (a * 2 - b * 5 + c * 4 - d) * (t * t) + (b * 3 - a - c * 3 + d) * (t * t * t);
    return {std::max(0.0, q.x / 2), q.y / 2};
  }
  void add(Vec2d p) {
    const Vec2d step = points_.empty() ? Vec2d{} : p - points_.back();
    lengths_.push_back((lengths_.empty() ? 0 : lengths_.back()) + std::hypot(step.x, step.y));
    points_.push_back(p);
  }

  std::vector<Vec2d> points_;
  std::vector<double> lengths_;
};

// u = ½ faces +z and grows towards +x, as on the renderer's sphere.
Mesh lathe(const Profile& profile) {
  Mesh mesh;
  for (int j = 0; j <= kAlong; j++)
    for (int i = 0; i <= kAround; i++) {
      const double u = double(i) / kAround, v = double(j) / kAlong,
                   angle = 2 * kPi * ((i % kAround) / double(kAround) - 0.5);
      const Vec2d p = profile.at(v);
      if (i < kAround) mesh.positions.push_back({p.x * std::sin(angle), p.y, p.x * std::cos(angle)});
      mesh.uvs.push_back({u, v});
    }
  for (int j = 0; j < kAlong; j++)
    for (int i = 0; i < kAround; i++) {
      const auto at = [&](int di, int dj) { return std::uint32_t((j + dj) * kAround + (i + di) % kAround); };
      const auto uv = [&](int di, int dj) { return std::uint32_t((j + dj) * (kAround + 1) + i + di); };
      if (j > 0) {  // the profile begins in a point
        mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
        mesh.triangle_uvs.push_back({uv(0, 0), uv(1, 0), uv(1, 1)});
      }
      mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
      mesh.triangle_uvs.push_back({uv(0, 0), uv(1, 1), uv(0, 1)});
    }
  return mesh;
}

// Mean over a square of texels, round and round; three times over, about a Gaussian.
void blur(std::vector<float>& values, int radius) {
  std::vector<float> other(values.size());
  const auto pass = [&](const std::vector<float>& in, std::vector<float>& out, int dx, int dy) {
    parallel_for(kHeight, [&](std::size_t y) {
      for (int x = 0; x < kWidth; x++) {
        float sum = 0;
        for (int k = -radius; k <= radius; k++) {
          const int tx = (x + k * dx + kWidth) % kWidth, ty = std::clamp(int(y) + k * dy, 0, kHeight - 1);
          sum += in[std::size_t(ty) * kWidth + tx];
        }
        out[y * kWidth + x] = sum / float(2 * radius + 1);
      }
    });
  };
  for (int i = 0; i < 3; i++) pass(values, other, 1, 0), pass(other, values, 0, 1);
}

Image map_of(const std::function<double(int x, int y)>& value) {
  Image image(kWidth, kHeight, 1);
  parallel_for(kHeight, [&](std::size_t y) {
    for (int x = 0; x < kWidth; x++) *image.at(x, int(y)) = float(value(x, int(y)));
  });
  return image;
}

void write(const std::string& directory) {
  const Profile profile;
  write_mesh(directory + "/vase.obj", MeshFileType::kObj, lathe(profile));

  const double lip = 0.9;  // beyond it v runs inside, where all is paint
  std::vector<float> paint(std::size_t(kWidth) * kHeight), cut = paint;
  parallel_for(kHeight, [&](std::size_t row) {
    const double v = 1 - (double(row) + 0.5) / kHeight, y = profile.at(v).y;
    const bool inside = y < lip && v > 0.8;
    for (int x = 0; x < kWidth; x++) {
      const double u = (x + 0.5) / kWidth;
      paint[row * kWidth + x] = inside || painted(u, y);
      cut[row * kWidth + x] = !inside && engraved(u, y);
    }
  });
  const std::vector<float> sharp_paint = paint, sharp_cut = cut;
  blur(paint, 2), blur(cut, 3);
  const auto at = [](int x, int y) { return std::size_t(y) * kWidth + x; };
  const auto grain = [](int x, int y) {  // brush and clay
    return turbulence({x / 6.0, y / 40.0, 0.5}, 3, 60, 0) + 0.5 * noise({x / 5.0, y / 5.0, 3.5}, 70);
  };
  const auto write_map = [&](const std::string& name, const std::function<double(int, int)>& value, SampleType sample) {
    write_image(directory + "/" + name, FileType::kPng, sample, map_of(value));
  };
  const auto thick = [&](int x, int y) { return 0.5 + 0.2 * paint[at(x, y)] * (1 + 0.08 * grain(x, y)); };
  write_map(
      "vase_ids.png", [&](int x, int y) { return sharp_paint[at(x, y)] / 255; }, SampleType::kUint8);
  write_map(
      "vase_engraved_ids.png",
      [&](int x, int y) { return (sharp_cut[at(x, y)] > 0 ? 2 : sharp_paint[at(x, y)]) / 255; }, SampleType::kUint8);
  write_map(
      "vase_plain.png", [](int, int) { return 0.5; }, SampleType::kUint16);
  write_map("vase_paint.png", thick, SampleType::kUint16);
  write_map(
      "vase_engraved.png",
      [&](int x, int y) {
        const double rough = noise({x / 4.0, y / 4.0, 9.5}, 80) + hash(x, y, 5, 90) - 0.5;
        return thick(x, y) * (1 - cut[at(x, y)]) + cut[at(x, y)] * (0.12 + 0.06 * rough);
      },
      SampleType::kUint16);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-vase DIRECTORY", argc, argv, [](const Arguments& a) { write(a[0]); });
}
