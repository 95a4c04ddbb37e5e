// Holds two pictures against each other where objects are: the distance over the pixels that both cover, over those
// that either covers, and how many one alone covers.
//
//   compare-pictures A.exr A.depth.exr B.exr B.depth.exr      as burnish-render --aov depth writes them
//
// Prints: PSNR in dB over both, over either, pixels of both, pixels of either.
#include <cstdio>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/render/metrics.h"
#include "program.h"

using namespace burnish;

int main(int argc, char** argv) {
  return run_program("compare-pictures A.exr A.depth.exr B.exr B.depth.exr", argc, argv, [](const Arguments& files) {
    std::vector<Image> images;
    for (const std::string& file : files) images.push_back(read_image(file));
    const Image &a = images[0], &depth_a = images[1], &b = images[2], &depth_b = images[3];
    for (int i = 1; i < 4; i++) {
      const Image& other = images[i];
      if (other.width != a.width || other.height != a.height || other.channels != (i == 2 ? a.channels : 1))
        throw file_error(ErrorKind::kMalformed, files[i], "expected the size of '" + files[0] + "'");
    }
    ByteImage both(a.width, a.height, 1), either(a.width, a.height, 1);
    for (std::size_t i = 0; i < both.data.size(); i++) {
      const bool in_a = depth_a.data[i] >= 0, in_b = depth_b.data[i] >= 0;
      both.data[i] = in_a && in_b, either.data[i] = in_a || in_b;
    }
    const ErrorMetrics inner = compare(a, b, both), whole = compare(a, b, either);
    std::printf("%.4f %.4f %zu %zu\n", inner.psnr_db, whole.psnr_db, inner.pixels, whole.pixels);
  });
}
