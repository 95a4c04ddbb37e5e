// Holds two pictures against each other where objects are: the distance over the pixels that both cover, over those
// that either covers, and how many one alone covers.
//
//   compare-pictures A.exr A.depth.exr B.exr B.depth.exr      as burnish-render --aov depth writes them
//
// Prints: PSNR in dB over both, over either, pixels of both, pixels of either.
#include <cstdio>
#include <exception>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/render/metrics.h"

using namespace burnish;

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: compare-pictures A.exr A.depth.exr B.exr B.depth.exr\n");
    return 1;
  }
  try {
    const Image a = read_image(std::string(argv[1])), b = read_image(std::string(argv[3]));
    const Image depth_a = read_image(std::string(argv[2])), depth_b = read_image(std::string(argv[4]));
    for (int i = 2; i <= 4; i++) {
      const Image& other = i == 2 ? depth_a : i == 3 ? b : depth_b;
      if (other.width != a.width || other.height != a.height || other.channels != (i == 3 ? a.channels : 1))
        throw file_error(ErrorKind::kMalformed, argv[i], "expected the size of '" + std::string(argv[1]) + "'");
    }
    ByteImage both(a.width, a.height, 1), either(a.width, a.height, 1);
    for (std::size_t i = 0; i < both.data.size(); i++) {
      const bool in_a = depth_a.data[i] >= 0, in_b = depth_b.data[i] >= 0;
      both.data[i] = in_a && in_b, either.data[i] = in_a || in_b;
    }
    const ErrorMetrics inner = compare(a, b, both), whole = compare(a, b, either);
    std::printf("%.4f %.4f %zu %zu\n", inner.psnr_db, whole.psnr_db, inner.pixels, whole.pixels);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare-pictures: error: %s\n", error.what());
    return 2;
  }
}
