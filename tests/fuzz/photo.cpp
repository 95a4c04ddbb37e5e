// Photographs: JPEG through libjpeg, others through OpenImageIO.
#include "burnish/ptm/photos/photo.h"

#include <vector>

#include "target.h"

namespace {

using namespace burnish;

template <typename Sample>
void read_all(Photo& photo) {
  std::vector<Sample> row(std::size_t(photo.form().width) * 3);
  for (int y = 0; y < photo.form().height; y++) photo.read(1, row.data());
}

void read(const FileRef& file) {
  const auto photo = open_photo(file);
  if (photo->form().bytes) read_all<std::uint8_t>(*photo);
  else read_all<float>(*photo);
}

const fuzz::Target target("photo", "photo.jpg", read);

}  // namespace
