// Material textures (Kautz & Seidel, sections 3 and 4): what a surface reflects by, texel by texel, in three images.
//
//              PREFIX_t            PREFIX_b               PREFIX_n
//   banks        t, alpha k_s        b                      n
//   blinn-phong  t/α_x, alpha k_s    b/α_y, alpha N/128     n
//   ward         t/α_x               b/α_y                  n, alpha k_s / (4π α_x α_y) divided by its maximum
//
// {t, b, n} is the texel's frame, in tangent space. A value is true = stored · scale + bias, per channel: attributes
// burnish:scale and burnish:bias (1 and 0 where there are none); burnish:model names the model, burnish:alpha what the
// fourth channel holds: "k_s", "N" or "k_s/(4 pi alpha_x alpha_y)".
#pragma once

#include <array>
#include <string>
#include <vector>

#include "burnish/core/image_chain.h"
#include "burnish/core/vec3.h"

namespace burnish {

enum class MaterialModel { kBanks, kBlinnPhong, kWard };
const char* name(MaterialModel model);  // "banks", "blinn-phong", "ward"

// One of the three.
struct MaterialTexture {
  std::vector<Image> levels;  // base first; as stored, integers in [0,1]; 3 or 4 channels
  std::array<float, 4> scale{1, 1, 1, 1}, bias{};

  int channels() const { return levels[0].channels; }
  MaterialTexture without_texels() const { return {{}, scale, bias}; }
  // True values of a texel: the vector, and the fourth channel (0 where there is none).
  Vec3f vector(int level, int x, int y) const {
    const float* s = levels[level].at(x, y);
    return {s[0] * scale[0] + bias[0], s[1] * scale[1] + bias[1], s[2] * scale[2] + bias[2]};
  }
  float alpha(int level, int x, int y) const {
    return channels() > 3 ? levels[level].at(x, y)[3] * scale[3] + bias[3] : 0;
  }
};

struct MaterialTextures {
  MaterialModel model = MaterialModel::kWard;
  MaterialTexture t, b, n;
  int first_row = 0;  // in the map, where these are some rows of it

  int width() const { return t.levels[0].width; }
  int height() const { return t.levels[0].height; }

  std::array<MaterialTexture*, 3> all() { return {&t, &b, &n}; }
  std::array<const MaterialTexture*, 3> all() const { return {&t, &b, &n}; }
};

// The file of a texture, `which` being t, b or n: PREFIX_t.exr, .png or .tif, whichever there is. kIo where there is
// none, kUsage where there are several.
std::string material_file(const std::string& prefix, char which);

// PREFIX_t.exr and so on: what they are written to.
std::string material_file(const std::string& prefix, char which, FileType type);

// Channels of a texture of that model.
int channels_of(MaterialModel model, char which);

// The three files of material textures, written by rows, with the attributes above.
class MaterialTexturesWriter {
 public:
  // Model, scales and biases are those of `like`. kUnsupported where the type does not hold the samples, and for
  // several levels in any but EXR.
  MaterialTexturesWriter(const MaterialTextures& like, int width, int height, int levels, const FileRef& t,
                         const FileRef& b, const FileRef& n, FileType type, SampleType sample);
  // The next rows of a level; rows of several levels may take turns.
  void write_rows(int level, const Image& t, const Image& b, const Image& n);
  // Must be called, as ImageWriter's.
  void close();

 private:
  std::vector<ImageChainWriter> chains_;  // of EXR
  std::vector<ImageWriter> images_;       // of others
};

// All of them. Errors as MaterialTexturesWriter.
void write_material_textures(const MaterialTextures& textures, const FileRef& t, const FileRef& b, const FileRef& n,
                             FileType type, SampleType sample);

// The base of three files' textures, by rows.
class MaterialTexturesReader {
 public:
  // kMalformed where a file's attributes or channels are not those of its model, and where the three differ in size,
  // levels or model.
  MaterialTexturesReader(const FileRef& t, const FileRef& b, const FileRef& n);

  MaterialModel model() const { return like_.model; }
  const MaterialTextures& head() const { return like_; }  // all but the levels
  int width() const { return readers_[0].width(); }
  int height() const { return readers_[0].height(); }
  int levels() { return readers_[0].levels(); }
  // Rows [first, first + count) of the base, as the one level of textures. kMalformed for NaN and infinity.
  MaterialTextures rows(int first, int count);
  // All levels. kMalformed too where their sizes are not those of a chain.
  MaterialTextures read_all();

 private:
  std::vector<ImageReader> readers_;  // of t, b and n
  MaterialTextures like_;             // without levels
};

// All levels. Errors as MaterialTexturesReader.
MaterialTextures read_material_textures(const FileRef& t, const FileRef& b, const FileRef& n);

}  // namespace burnish
