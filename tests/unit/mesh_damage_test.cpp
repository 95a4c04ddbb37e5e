// Damaged mesh files: whatever their bytes are, they give a sound mesh or one burnish::Error.
#include <gtest/gtest.h>

#include <random>

#include "burnish/core/error.h"
#include "burnish/mesh/files/mesh_io.h"
#include "damaged.h"
#include "mesh_samples.h"

namespace burnish {
namespace {

using testing::MeshSample;

bool finite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expect_sound(const Mesh& m, const std::string& what) {
  ASSERT_FALSE(m.triangles.empty()) << what;
  for (const auto* list : {&m.triangle_uvs, &m.triangle_normals})
    ASSERT_TRUE(list->empty() || list->size() == m.triangles.size()) << what;
  for (std::size_t t = 0; t < m.triangles.size(); t++) {
    for (int c = 0; c < 3; c++) {
      ASSERT_LT(m.triangles[t][c], m.positions.size()) << what;
      ASSERT_TRUE(finite(m.position(t, c))) << what;
      if (m.has_uvs()) {
        ASSERT_LT(m.triangle_uvs[t][c], m.uvs.size()) << what;
        ASSERT_TRUE(std::isfinite(m.uv(t, c).x) && std::isfinite(m.uv(t, c).y)) << what;
      }
      if (m.has_normals()) {
        ASSERT_LT(m.triangle_normals[t][c], m.normals.size()) << what;
        ASSERT_NEAR(length(m.normal(t, c)), 1, 1e-12) << what;
      }
    }
    ASSERT_GT(length(m.perpendicular(t)), 0) << what;
  }
}

class MeshDamage : public ::testing::TestWithParam<MeshSample> {
 protected:
  // Whether it could be read. Any other exception fails the test.
  bool reads(const std::string& bytes, const std::string& what) {
    const std::string& leaf = GetParam().leaf;
    try {
      expect_sound(parse_mesh(mesh_file_type_of(leaf), bytes, leaf), what);
      return true;
    } catch (const Error& e) {
      const std::string message = e.what();
      EXPECT_TRUE(e.kind() == ErrorKind::kMalformed || e.kind() == ErrorKind::kUnsupported) << what << ": " << message;
      EXPECT_EQ(message.find("'" + leaf + "': "), 0u) << what << ": " << message;
      EXPECT_NE(message.find("expected "), message.npos) << what << ": " << message;
      EXPECT_NE(message.find(", got "), message.npos) << what << ": " << message;
      EXPECT_TRUE(std::ranges::none_of(message, [](char c) { return c >= 0 && c < ' '; })) << what;
      return false;
    }
  }
};

TEST_P(MeshDamage, NoPrefixReadsAsAWholeFile) {
  const auto& [leaf, bytes, uvs, normals] = GetParam();
  const bool text = bytes.find('\0') == bytes.npos;
  const std::size_t whole = text ? bytes.find_last_not_of(" \r\n") + 1 : bytes.size();
  for (std::size_t size = 0; size < whole; size++) {
    const bool read = reads(bytes.substr(0, size), "the first " + std::to_string(size) + " bytes of " + leaf);
    EXPECT_FALSE(read && !leaf.ends_with(".obj")) << size << " of " << whole << " bytes of " << leaf;
  }
  EXPECT_TRUE(reads(bytes.substr(0, whole), leaf));
}

TEST_P(MeshDamage, NothingMayFollow) {
  const auto& [leaf, bytes, uvs, normals] = GetParam();
  for (const char* more : {"x", "\n3 0 1 2\n", "\n0\n"}) EXPECT_FALSE(reads(bytes + more, leaf + " with more"));
}

// A byte replaced, taken out, put in, or swapped for a piece from elsewhere.
TEST_P(MeshDamage, MutationsReadSoundlyOrNotAtAll) {
  const auto& [leaf, bytes, uvs, normals] = GetParam();
  std::mt19937 random(1);
  const std::string likely = std::string("0123456789-+.eE \n\r/\\#fvnalist\xff\x80\x7f") + '\0';
  for (int i = 0; i < 5000; i++) {
    reads(testing::damaged(bytes, bytes.size(), likely, i, random), leaf + ", mutation " + std::to_string(i));
    if (HasFailure()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, MeshDamage, ::testing::ValuesIn(testing::mesh_samples()), [](const auto& sample) {
  std::string name = sample.param.leaf;
  std::ranges::replace(name, '.', '_');
  return name;
});

}  // namespace
}  // namespace burnish
