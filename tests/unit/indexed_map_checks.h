// What holds for every reader of indexed maps.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "burnish/core/error.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::testing {

// To the last bit.
inline void expect_same(const IndexedMap& a, const IndexedMap& b) {
  ASSERT_EQ(a.palette.normals.size(), b.palette.normals.size());
  EXPECT_EQ(0,
            std::memcmp(a.palette.normals.data(), b.palette.normals.data(), a.palette.normals.size() * sizeof(Vec3f)));
  EXPECT_EQ(a.palette.materials, b.palette.materials);
  EXPECT_EQ(a.palette.space, b.palette.space);
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t l = 0; l < a.levels.size(); l++) {
    EXPECT_EQ(a.levels[l].width, b.levels[l].width);
    EXPECT_EQ(a.levels[l].height, b.levels[l].height);
    EXPECT_EQ(a.levels[l].data, b.levels[l].data) << "level " << l;
  }
}

// No reader may crash, hang or throw anything else, whatever the bytes.
inline void expect_survival(const std::string& path) {
  const auto survives = [&](const auto& read, const char* what) {
    try {
      read();
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_NE(int(e.kind()), int(ErrorKind::kInternal)) << e.what();
      return;
    } catch (const std::exception& e) {
      ADD_FAILURE() << what << " threw something else: " << e.what();
    }
  };
  survives([&] { is_indexed_map(path); }, "is_indexed_map");
  survives([&] { read_indexed_map(path); }, "read_indexed_map");
  survives([&] { read_palette(path); }, "read_palette");
}

inline long peak_mib() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

}  // namespace burnish::testing
