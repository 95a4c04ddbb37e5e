// ptm.json of a polynomial texture map in textures, beside six sound ones of 3×2 texels.
#include "burnish/ptm/files/ptm_textures.h"

#include <memory>

#include "burnish/core/image_io.h"
#include "target.h"

namespace {

using namespace burnish;

const PtmTextureFiles& textures() {
  static std::vector<std::unique_ptr<fuzz::MemoryFile>> files;
  static const PtmTextureFiles all = [] {
    PtmTextureFiles t;
    Image image(3, 2, 3);
    for (std::size_t i = 0; i < image.data.size(); i++) image.data[i] = float(i) / float(image.data.size());
    for (FileRef& ref : t.images) {
      files.push_back(std::make_unique<fuzz::MemoryFile>("texture.png"));
      ref = files.back()->ref();
      write_image(ref, FileType::kPng, SampleType::kUint8, image);
    }
    return t;
  }();
  return all;
}

void read(const FileRef& file) {
  PtmTextureFiles files = textures();
  files.json = file;
  const PtmTextures read = read_ptm_textures(files);
  std::vector<float> coefficients(read.rows->shape().texels() * 18);
  read.rows->read(0, read.rows->shape().height, coefficients.data(), nullptr);
}

const fuzz::Target target("ptm_textures", "ptm.json", read);

}  // namespace
