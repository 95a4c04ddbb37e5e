// One small mesh in every format and dialect that is read: a quad and a triangle with a corner each beyond it, whose
// every number single precision holds.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace burnish::testing {

template <typename T>
void append(std::string& bytes, T value, std::endian order) {
  const char* raw = reinterpret_cast<const char*>(&value);
  std::string part(raw, raw + sizeof value);
  if (order != std::endian::native) std::ranges::reverse(part);
  bytes += part;
}

struct MeshSample {
  std::string leaf, bytes;
  bool uvs = false, normals = false;
};

inline constexpr double kSamplePositions[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}, {-2.5, 0.25, 3}};
inline constexpr double kSampleUvs[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.125, 0.5}};
// Corners 0 1 2 3 and 0 3 4, turned as the fan from the first corner has them.
inline constexpr std::uint32_t kSampleTriangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};

inline std::string sample_binary_ply(std::endian order) {
  std::string bytes =
      std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") +
      "_endian 1.0\ncomment made by hand\nelement vertex 5\nproperty double x\nproperty float y\n"
      "property float32 z\nproperty list uchar short extra\nproperty float nx\nproperty float ny\n"
      "property float nz\nproperty uchar red\nproperty float u\nproperty float v\nelement edge 1\n"
      "property int vertex1\nelement face 2\nproperty list ushort uint vertex_index\nproperty list char float extra\n"
      "end_header\n";
  for (int i = 0; i < 5; i++) {
    append(bytes, kSamplePositions[i][0], order);
    append(bytes, float(kSamplePositions[i][1]), order), append(bytes, float(kSamplePositions[i][2]), order);
    append(bytes, std::uint8_t(i), order);
    for (int k = 0; k < i; k++) append(bytes, std::int16_t(k), order);
    for (float n : {0.f, 0.f, 2.f}) append(bytes, n, order);
    append(bytes, std::uint8_t(200), order);
    for (double t : kSampleUvs[i]) append(bytes, float(t), order);
  }
  append(bytes, std::int32_t(7), order);
  for (const auto& face : {std::vector<std::uint32_t>{0, 1, 2, 3}, {0, 3, 4}}) {
    append(bytes, std::uint16_t(face.size()), order);
    for (std::uint32_t v : face) append(bytes, v, order);
    append(bytes, std::int8_t(1), order), append(bytes, 0.5f, order);
  }
  return bytes;
}

inline std::string sample_binary_stl() {
  std::string bytes = "solid as some binary files begin";
  bytes.resize(80);
  append(bytes, std::uint32_t(3), std::endian::little);
  for (const auto& t : kSampleTriangles) {
    for (int i = 0; i < 3; i++) append(bytes, 0.f, std::endian::little);
    for (std::uint32_t v : t)
      for (double x : kSamplePositions[v]) append(bytes, float(x), std::endian::little);
    append(bytes, std::uint16_t(0), std::endian::little);
  }
  return bytes;
}

// Nothing but blanks may be cut off their ends without damage, OBJ excepted.
inline std::vector<MeshSample> mesh_samples() {
  const std::string stl_facet = "facet normal 0 0 1\n outer loop\n", stl_end = " endloop\nendfacet\n";
  const std::string v[] = {"vertex 0 0 0\n", "vertex 1 0 0\n", "vertex 1 1 0\n", "vertex 0 1 0.5\n",
                           "vertex -2.5 .25 3e0\n"};
  return {
      {"bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 .5\nv -2.5 .25 3\nf 1 2 3 4\nf 1 4 5\n"},
      {"all.obj",
       "# by hand\nmtllib a.mtl\no a\nv 0 0 0 1\nv 1 0 0 .5 .5 1\nv +1 1.0 0e0\nv 0 1 .5\nv -2.5 2.5e-1 3\nvt 0 0\n"
       "vt 1 0 0\nvt 1 1\nvt 0 1\nvt .125 .5\nvn 0 0 2\ng b\ns off\nusemtl c\nf 1/1/1 2/2/1 3/3/1 \\\n 4/4/1 # quad\n"
       "f -5/-5/-1 -2/-2/-1 -1/-1/-1\nl 1 2\n",
       true, true},
      {"bare.ply",
       "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0\n1 0 0\n1 1 0\n0 1 .5\n-2.5 .25 3\n4 0 1 2 3\n3 0 3 4\n"},
      {"all.ply",
       "ply\r\nformat ascii 1.0\r\ncomment a b\r\nobj_info c\r\nelement face 2\r\nproperty uchar flags\r\n"
       "property list uint8 int32 vertex_index\r\nelement vertex 5\r\nproperty float s\r\nproperty float t\r\n"
       "property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty double x\r\nproperty double y\r\n"
       "property int z_\r\nproperty double z\r\nelement nothing 3\r\nend_header\r\n"
       "1 4 0 1 2 3\r\n1 3 0 3 4\r\n0 0 0 0 2 0 0 9 0\r\n1 0 0 0 2 1 0 9 0\r\n1 1 0 0 2 1 1 9 0\r\n"
       "0 1 0 0 2 0 1 9 .5\r\n.125 .5 0 0 2 -2.5 .25 9 3\r\n",
       true, true},
      {"corners.ply",
       "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
       "0 0 0\n1 0 0\n1 1 0\n0 1 .5\n-2.5 .25 3\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 3 4 6 0 0 0 1 .125 .5\n",
       true},
      {"little.ply", sample_binary_ply(std::endian::little), true, true},
      {"big.ply", sample_binary_ply(std::endian::big), true, true},
      {"bare.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n-2.5 .25 3\n4 0 1 2 3\n3 0 3 4\n"},
      {"all.off",
       "STCNOFF 5 2 0 # by hand\n\n0 0 0  0 0 2  255 0 0 255  0 0\n1 0 0  0 0 2  255 0 0  1 0 # three of them\n"
       "1 1 0  0 0 2  0 0 0 1  1 1\n0 1 .5  0 0 2  0 0 0 1  0 1\n-2.5 .25 3  0 0 2  0 0 0 1  .125 .5\n"
       "4 0 1 2 3  0.5 0.5 0.5 1\n3 0 3 4\n",
       true, true},
      {"text.stl", "solid a b\n" + stl_facet + v[0] + v[1] + v[2] + stl_end + stl_facet + v[0] + v[2] + v[3] + stl_end +
                       "FACET NORMAL nan nan nan\nOUTER LOOP\n" + v[0] + v[3] + v[4] + stl_end + "endsolid\n"},
      {"binary.stl", sample_binary_stl()},
  };
}

}  // namespace burnish::testing
