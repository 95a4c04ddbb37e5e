// Images for tests of their files.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "burnish/core/file_type.h"
#include "burnish/core/image.h"

namespace burnish::testing {

// Values that the samples hold exactly.
inline Image random_image(int w, int h, int channels, SampleType sample) {
  std::mt19937 random(1u + unsigned(channels));
  Image image(w, h, channels);
  for (float& v : image.data) {
    if (sample == SampleType::kUint8) v = float(random() % 256) / 255.f;
    else if (sample == SampleType::kUint16) v = float(random() % 65536) / 65535.f;
    else v = float(int(random() % 4096) - 2048) / 512.f;  // 12 bits fit into a half
  }
  return image;
}

// Integers come back as c/max up to the last bit of the quotient; floats exactly.
inline void expect_same(const std::vector<float>& got, const std::vector<float>& wanted, const std::string& what) {
  ASSERT_EQ(got.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < got.size(); i++) ASSERT_FLOAT_EQ(got[i], wanted[i]) << what << ", sample " << i;
}

}  // namespace burnish::testing
