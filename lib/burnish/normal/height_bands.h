// A displacement map's rows in bands from the top, each with the rows and columns around it that planes are fitted to.
//
// No more rows are held than a band needs: those of its own and `radius` above and below, and the first and last ones
// of a map that repeats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/normal/height_map.h"
#include "burnish/normal/height_texels.h"

namespace burnish {

struct HeightBand {
  int first = 0, rows = 0;
  int stride = 0;                    // width + 2·radius
  std::vector<float> displacement;   // (rows + 2·radius) × stride, of values in [0,1] or as the file has them
  std::vector<std::uint8_t> exists;  // same shape; empty where every texel does
};

class HeightBands {
 public:
  // kMalformed as convert_height_map. The options are kept by reference.
  HeightBands(const FileRef& file, const HeightMapOptions& options, int radius);

  int width() const { return reader_.width(); }
  int height() const { return reader_.height(); }
  bool colour_channels_differ() const { return channel_.colours_differ(); }
  bool done() const { return next_ >= height(); }
  HeightBand next();

 private:
  struct Row {
    std::vector<float> displacement;
    std::vector<std::uint8_t> exists;  // empty without a mask
  };

  std::vector<Row> read_rows(ImageReader& reader, ImageReader* mask, int first, int count);
  void discard_or_refuse(const ImageReader& reader, Row& row, int y) const;
  void advance_window(int first, int end);
  const Row& row_at(int y) const;
  void fill_row(int y, float* displacement, std::uint8_t* exists) const;

  const HeightMapOptions& options_;
  int radius_;
  ImageReader reader_;
  HeightChannel channel_;
  std::optional<ImageReader> mask_;
  int band_rows_ = 0, next_ = 0;
  int window_first_ = 0;
  std::vector<Row> window_, head_, tail_;
  std::vector<float> samples_, mask_samples_;
};

}  // namespace burnish
