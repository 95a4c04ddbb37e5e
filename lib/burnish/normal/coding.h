// How unit vectors are stored in image samples, and read back.
//
// Stored in integers a component v becomes c = ½v + ½ of the full range, rounded half up (n = 2·c/255 − 1 at 8 bits, so
// 0 stores as 128 and a flat normal comes back 0.32° off); in floats v itself. Decoding renormalises; a vector shorter
// than 1e-3 is invalid, is counted, and becomes (0,0,1). +Y is up inside; GreenAxis::kDown flips y on the way in and
// out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"

namespace burnish {

enum class GreenAxis { kUp, kDown };
enum class NormalEncoding { kByType, kBiased, kSigned };  // kByType: biased in integers, signed in floats

struct NormalCoding {
  GreenAxis green = GreenAxis::kUp;
  NormalEncoding encoding = NormalEncoding::kByType;
  // Which channels hold x, y and z, by letter (x r: 0, y g: 1, z b: 2, w a: 3). Of two the third component is rebuilt:
  // z = √(1 − x² − y²). Empty: the first three.
  std::string channels;
};

// How a vector comes of its stored components: what is left of a coding once the file is known.
struct VectorCoding {
  bool biased = false, green_down = false;
  bool rebuilds_z = false;  // from x and y; the z that is given does not matter

  // Unit, of components of integers scaled to [0,1]; sets `invalid` where it is too short.
  Vec3f decode(float x, float y, float z, bool& invalid) const;
};

// A normal map's vectors, decoded a band of rows at a time.
class NormalReader {
 public:
  // kMalformed where the file has fewer channels than the coding asks for; kUsage where `channels` makes no sense.
  NormalReader(const FileRef& file, const NormalCoding& coding);

  int width() const { return reader_.width(); }
  int height() const { return reader_.height(); }
  const std::string& name() const { return reader_.name(); }
  ImageReader& image() { return reader_; }
  const ImageReader& image() const { return reader_; }

  // Where each component is stored; −1 for a z that is rebuilt.
  const int* components() const { return component_; }

  // Unit vectors of rows [first, first + count). Runs in parallel. kMalformed for NaN or infinity.
  void read_rows(int first, int count, Vec3f* out);
  // All of them; kUnsupported where memory does not hold them.
  std::vector<Vec3f> read_all();
  // How read_rows decodes each.
  const VectorCoding& vectors() const { return vectors_; }

  std::size_t invalid_texels() const { return invalid_; }

 private:
  ImageReader reader_;
  VectorCoding vectors_;
  int component_[3];
  std::size_t invalid_ = 0;
  std::vector<float> band_;
};

// All unit vectors of a file, row by row from the top.
std::vector<Vec3f> read_normals(const FileRef& file, const NormalCoding& coding, int* width, int* height);

// Whether a sample type stores vectors biased under this encoding.
bool is_biased(NormalEncoding encoding, bool integer_samples);

// kUnsupported for the signed encoding in integers: they hold no negative values.
void require_encodable(const NormalCoding& coding, SampleType sample, const std::string& name);

// One row of unit vectors to samples, three a texel; `out` is what ImageWriter::write_rows_stored takes for kUint8 and
// kUint16, and floats for the others.
void encode_normals(const Vec3f* in, int count, const NormalCoding& coding, SampleType sample, void* out);

}  // namespace burnish
