// Mip chains of images: a file, its levels.
//
// Level sizes are those of core/mip.h. An EXR chain is tiled, MIPMAP_LEVELS, ROUND_DOWN; it holds one level, as plain
// scanlines, or all down to one texel. Without names channels are R, G, B, A, or Y where there is one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"

namespace burnish {

// kUnsupported where an EXR does not hold so many levels of an image of that size.
void require_chain(const FileRef& file, int width, int height, int levels);

// A chain to an EXR, by rows. Of the base 64 rows are held; the coarser levels, which come after it in the file, wait
// in a temporary file (spill_file.h) beside it.
class ImageChainWriter {
 public:
  // Size and levels of the whole chain. kUnsupported for integer samples, and as require_chain().
  ImageChainWriter(const FileRef& file, SampleType sample, int width, int height, int channels, int levels,
                   const Attributes& attributes = {}, const std::vector<std::string>& channel_names = {});
  ~ImageChainWriter();
  ImageChainWriter(ImageChainWriter&&) noexcept;

  // The next rows of a level, each level's from its top; rows of several levels may take turns.
  void write_rows(int level, int count, const float* rows);
  // After all rows. Must be called, as ImageWriter's.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// EXR only. The levels are of sizes and number as above, and have the same channels. kUnsupported for integer samples,
// and as require_chain().
void write_image_chain(const FileRef& file, SampleType sample, const std::vector<Image>& levels,
                       const Attributes& attributes = {});

// All levels of any image file, base first; files of most types have one. kMalformed where sizes are others.
std::vector<Image> read_image_chain(ImageReader& file);

}  // namespace burnish
