// Photographs: JPEG through libjpeg, others as images.
#include "burnish/ptm/photos/photo.h"

#include <algorithm>
#include <vector>

#include "target.h"

namespace {

using namespace burnish;

template <typename Sample>
void read_all(Photo& photo) {
  constexpr int kRows = 16;
  const int width = photo.form().width, height = photo.form().height;
  std::vector<Sample> rows(std::size_t(width) * kRows * 3);
  for (int y = 0; y < height; y += kRows) photo.read(std::min(kRows, height - y), rows.data());
}

void read(const FileRef& file) {
  const auto photo = open_photo(file);
  if (photo->form().bytes) read_all<std::uint8_t>(*photo);
  else read_all<float>(*photo);
}

const fuzz::Target target("photo", "photo.jpg", read);

}  // namespace
