// Makes the inputs of the command-line tests, and looks into outputs.
//
//   burnish-fixture make PATTERN WIDTH HEIGHT FILE [uint8|uint16|half|float]
//   burnish-fixture info FILE                 width height channels sample-type
//   burnish-fixture texel FILE COLUMN ROW …   samples as floats, integers over their maximum; a line a texel
//   burnish-fixture text FILE                 8-bit samples as a plain PGM or PPM
//   burnish-fixture same A B [TOLERANCE]      exit 1 and a line where decoded samples differ by more
//   burnish-fixture digest FILE               an indexed map: sizes, intervals, entries, hashes of indices
//   burnish-fixture strays MAP IDS            how many texels of an indexed map are of another material than IDS says
//   burnish-fixture cube-strays alpha|subcubes MATERIALS IMAGE QUANTIZED
//                                             how many texels of an --emit-rgb image another quantizer gave another
//                                             material
//   burnish-fixture mesh NAME ROWS FILE       one of mesh_patterns.h
//   burnish-fixture tangents MESH             a line a corner: position, normal, texture coordinates, tangent, sign
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/tangent_frames.h"
#include "burnish/palette/indexed_map.h"
#include "burnish/palette/material_cube.h"
#include "mesh_patterns.h"

using namespace burnish;

namespace {

double bumps(double x, double y) {
  return 0.5 + 0.2 * std::sin(0.37 * x + 0.11 * y) * std::cos(0.23 * y) + 0.15 * std::sin(0.05 * x - 0.31 * y) +
         0.1 * std::cos(0.9 * x) * std::sin(0.7 * y);
}

double noise(int x, int y, int c) {
  std::uint32_t h = std::uint32_t(x) * 0x9e3779b1u ^ std::uint32_t(y) * 0x85ebca77u ^ std::uint32_t(c) * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}

struct Pattern {
  int channels;
  std::function<double(int x, int y, int c, int w, int h)> value;
};

double normal_component(int x, int y, int c) {
  const double a = 2 * (bumps(x + 1, y) - bumps(x - 1, y)), b = 2 * (bumps(x, y - 1) - bumps(x, y + 1));
  const Vec3d n = normalized(Vec3d{-a, -b, 1});
  return 0.5 + 0.5 * (c == 0 ? n.x : c == 1 ? n.y : n.z);
}

const std::map<std::string, Pattern>& patterns() {
  static const std::map<std::string, Pattern> table{
      {"bumps", {1, [](int x, int y, int, int, int) { return bumps(x, y); }}},
      {"noise", {1, [](int x, int y, int, int, int) { return noise(x, y, 0); }}},
      {"flat", {1, [](int, int, int, int, int) { return 0.25; }}},
      {"slope-u", {1, [](int x, int, int, int w, int) { return double(x) / w; }}},
      {"slope-v", {1, [](int, int y, int, int, int h) { return 1 - double(y) / h; }}},
      {"nan",
       {1, [](int x, int y, int, int w,
              int h) { return x == w / 2 && y == h / 2 ? std::numeric_limits<double>::quiet_NaN() : bumps(x, y); }}},
      // 0 where column and row are those of `nan`, and in a corner.
      {"mask",
       {1, [](int x, int y, int, int w, int h) { return (x == w / 2 && y == h / 2) || x + y < 3 ? 0.0 : 1.0; }}},
      {"empty-mask", {1, [](int, int, int, int, int) { return 0.0; }}},
      {"grey", {3, [](int x, int y, int, int, int) { return bumps(x, y); }}},
      {"colours", {3, [](int x, int y, int c, int, int) { return bumps(x + 7 * c, y); }}},
      {"normals", {3, [](int x, int y, int c, int, int) { return normal_component(x, y, c); }}},
      // Normals, but for a vector of no length where `nan` has none.
      {"holed-normals",
       {3,
        [](int x, int y, int c, int w, int h) { return x == w / 2 && y == h / 2 ? 0.0 : normal_component(x, y, c); }}},
      // Flow round the map's centre, biased, of length 0 where `nan` has none; the third channel is 0 to 1 from the left.
      {"flow",
       {3,
        [](int x, int y, int c, int w, int h) {
          if (c == 2) return double(x) / (w - 1);
          if (x == w / 2 && y == h / 2) return 0.5;
          return 0.5 + (c == 0 ? y + 0.5 - 0.5 * h : x + 0.5 - 0.5 * w) / (w + h);
        }}},
      {"rgba", {4, [](int x, int y, int c, int, int) { return noise(x, y, c); }}},
      // Material ids 0 … 3 in vertical stripes, for 8 bits.
      {"ids", {1, [](int x, int, int, int w, int) { return (4 * x / w) / 255.0; }}},
  };
  return table;
}

SampleType sample_named(const std::string& word) {
  for (SampleType s : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat})
    if (word == name(s)) return s;
  throw std::runtime_error("no sample type " + word);
}

int make(const std::vector<std::string>& a) {
  const Pattern& pattern = patterns().at(a.at(1));
  const int width = std::stoi(a.at(2)), height = std::stoi(a.at(3));
  const FileType type = file_type_of(a.at(4));
  const SampleType sample = a.size() > 5 ? sample_named(a[5]) : default_sample_type(type);
  ImageWriter writer(a[4], type, sample, width, height, pattern.channels);
  std::vector<float> row(std::size_t(width) * pattern.channels);
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++)
      for (int c = 0; c < pattern.channels; c++)
        row[std::size_t(x) * pattern.channels + c] = float(pattern.value(x, y, c, width, height));
    writer.write_rows(1, row.data());
  }
  writer.close();
  return 0;
}

int info(const std::vector<std::string>& a) {
  const ImageReader reader(a.at(1));
  std::printf("%d %d %d %s\n", reader.width(), reader.height(), reader.channels(), name(reader.sample_type()));
  return 0;
}

int texel(const std::vector<std::string>& a) {
  const Image image = read_image(a.at(1));
  for (std::size_t i = 2; i < a.size(); i += 2) {
    const float* t = image.at(std::stoi(a[i]), std::stoi(a.at(i + 1)));
    for (int c = 0; c < image.channels; c++) std::printf("%s%.6g", c ? " " : "", t[c] + 0.f);  // no -0
    std::printf("\n");
  }
  return 0;
}

int text(const std::vector<std::string>& a) {
  const Image image = read_image(a.at(1));
  std::printf("P%d\n%d %d\n255\n", image.channels == 1 ? 2 : 3, image.width, image.height);
  for (std::size_t i = 0; i < image.data.size(); i++)
    std::printf("%ld%c", std::lround(image.data[i] * 255), (i + 1) % image.channels ? ' ' : '\n');
  return 0;
}

int same(const std::vector<std::string>& a) {
  const Image one = read_image(a.at(1)), two = read_image(a.at(2));
  const double tolerance = a.size() > 3 ? std::stod(a[3]) : 0;
  if (one.width != two.width || one.height != two.height || one.channels != two.channels) {
    std::printf("%s is %dx%dx%d, %s is %dx%dx%d\n", a[1].c_str(), one.width, one.height, one.channels, a[2].c_str(),
                two.width, two.height, two.channels);
    return 1;
  }
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < one.data.size(); i++) {
    const double d = std::abs(double(one.data[i]) - two.data[i]);
    if (!(d <= worst)) worst = d, at = i;
  }
  if (worst <= tolerance) return 0;
  const std::size_t t = at / one.channels;
  std::printf("%s and %s differ by %g at column %zu, row %zu, channel %zu\n", a[1].c_str(), a[2].c_str(), worst,
              t % one.width, t / one.width, at % one.channels);
  return 1;
}

int digest(const std::vector<std::string>& a) {
  const IndexedMap map = read_indexed_map(a.at(1));
  for (const MaterialInterval& m : map.palette.materials)
    std::printf("material %d: %d entries from %d\n", m.id, m.count, m.first);
  for (const IndexImage& level : map.levels) {
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (const std::uint16_t i : level.data)
      for (const int byte : {i & 255, i >> 8}) hash = (hash ^ std::uint64_t(byte)) * 0x100000001b3u;
    std::printf("level %dx%d: %016llx\n", level.width, level.height, static_cast<unsigned long long>(hash));
  }
  const auto rounded = [](float v) { return std::round(v * 1e4) / 1e4 + 0.0; };  // no -0
  for (const Vec3f& n : map.palette.normals) std::printf("%.4f %.4f %.4f\n", rounded(n.x), rounded(n.y), rounded(n.z));
  return 0;
}

int mesh(const std::vector<std::string>& a) {
  write_mesh(a.at(3), mesh_file_type_of(a[3]), named_mesh(a.at(1), std::stoi(a.at(2))));
  return 0;
}

int tangents(const std::vector<std::string>& a) {
  Mesh mesh = read_mesh(a.at(1));
  require_uvs(mesh, "for tangents");
  add_smooth_normals(mesh);
  // In single precision, as those take them whose tangents these are held against.
  for (auto* vectors : {&mesh.positions, &mesh.normals})
    for (Vec3d& v : *vectors) v = Vec3d(Vec3f(v));
  for (Vec2d& uv : mesh.uvs) uv = {float(uv.x), float(uv.y)};
  const TangentFrames frames = tangent_frames(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); t++)
    for (int c = 0; c < 3; c++) {
      const Vec3d p = mesh.position(t, c), n = mesh.normal(t, c);
      const Vec2d uv = mesh.uv(t, c);
      const auto& [v, sign] = frames[t][c];
      std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %g\n", p.x, p.y, p.z, n.x, n.y, n.z, uv.x,
                  uv.y, v.x, v.y, v.z, sign);
    }
  return 0;
}

int strays(const std::vector<std::string>& a) {
  const IndexedMap map = read_indexed_map(a.at(1));
  const ByteImage ids = read_ids(a.at(2), map.width(), map.height());
  std::size_t texels = 0;
  for (std::size_t i = 0; i < ids.data.size(); i++)
    texels += map.palette.materials[map.palette.interval_of(map.levels[0].data[i])].id != ids.data[i];
  std::printf("%zu\n", texels);
  return 0;
}

int cube_strays(const std::vector<std::string>& a) {
  const MaterialCube cube(a.at(1) == "alpha" ? MaterialEncoding::kAlpha : MaterialEncoding::kSubcubes,
                          std::stoi(a.at(2)));
  const Image before = read_image(a.at(3)), after = read_image(a.at(4));
  if (before.width != after.width || before.height != after.height || after.channels < cube.channels())
    throw std::runtime_error("not of one size and kind");
  const auto material = [&](const Image& image, std::size_t i) {
    Colour c{0, 0, 0, 255};
    for (int k = 0; k < cube.channels(); k++) c[k] = std::round(image.data[i * image.channels + k] * 255);
    return cube.decode(c).material;
  };
  std::size_t texels = 0;
  for (std::size_t i = 0; i < before.texels(); i++) texels += material(before, i) != material(after, i);
  std::printf("%zu\n", texels);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> a(argv + 1, argv + argc);
  try {
    if (!a.empty() && a[0] == "make") return make(a);
    if (!a.empty() && a[0] == "info") return info(a);
    if (!a.empty() && a[0] == "texel") return texel(a);
    if (!a.empty() && a[0] == "text") return text(a);
    if (!a.empty() && a[0] == "same") return same(a);
    if (!a.empty() && a[0] == "digest") return digest(a);
    if (!a.empty() && a[0] == "strays") return strays(a);
    if (!a.empty() && a[0] == "cube-strays") return cube_strays(a);
    if (!a.empty() && a[0] == "mesh") return mesh(a);
    if (!a.empty() && a[0] == "tangents") return tangents(a);
    std::fprintf(
        stderr,
        "burnish-fixture: expected make, info, texel, text, same, digest, strays, cube-strays, mesh or tangents\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "burnish-fixture: %s\n", error.what());
  }
  return 2;
}
