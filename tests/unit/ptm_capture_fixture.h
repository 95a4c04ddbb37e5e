// Photographs of a made-up surface under lights of a dome, in any kind of file.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>
// jpeglib.h wants the above.
#include <jpeglib.h>

#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"
#include "burnish/ptm/basis.h"
#include "scratch_dir.h"

namespace burnish::testing {

// Well spread over the upper half of the sphere.
inline std::vector<Vec3d> dome_of_lights(int count) {
  std::vector<Vec3d> out;
  for (int i = 0; i < count; i++) {
    const double z = 0.2 + 0.79 * (i + 0.5) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    out.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return out;
}

// 0 … 255 of a photograph's samples, R G B a texel.
using Samples = std::vector<float>;

// The polynomial of a channel of a texel: smooth over the surface, between 0 and 255 under every light.
inline PtmCoefficients<double> made_up_polynomial(int x, int y, int channel) {
  const double wave = std::sin(0.3 * x + 0.2 * y + channel), slope = std::cos(0.21 * x - 0.4 * y);
  return {-12 - 8 * wave, -15 + 6 * slope, 5 * wave, 22 * slope, -18 * wave, 120 + 20 * wave + 8 * channel};
}
inline std::vector<Samples> made_up_photos(int width, int height, const std::vector<Vec3d>& lights) {
  std::vector<Samples> photos;
  for (const Vec3d& l : lights) {
    Samples& s = photos.emplace_back();
    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++)
        for (int c = 0; c < 3; c++) s.push_back(float(evaluate(made_up_polynomial(x, y, c), l.x, l.y)));
  }
  return photos;
}

inline void write_photo(const std::string& path, FileType type, SampleType sample, int width, const Samples& samples) {
  Image image(width, int(samples.size() / 3) / width, 3);
  for (std::size_t i = 0; i < samples.size(); i++) image.data[i] = samples[i] / 255;
  write_image(path, type, sample, image);
}

inline void write_jpeg(const std::string& path, int width, const Samples& samples, bool progressive = false,
                       int channels = 3) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  jpeg_stdio_dest(&jpeg, file);
  jpeg.image_width = JDIMENSION(width);
  jpeg.image_height = JDIMENSION(samples.size() / std::size_t(width * channels));
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 3 ? JCS_RGB : channels == 1 ? JCS_GRAYSCALE : JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 90, TRUE);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row(std::size_t(width) * channels);
  for (std::size_t at = 0; at < samples.size(); at += row.size()) {
    for (std::size_t i = 0; i < row.size(); i++) row[i] = std::uint8_t(std::lround(samples[at + i]));
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::fclose(file);
}

}  // namespace burnish::testing
