// Directions of anisotropy, a vector a texel in tangent space, and the forms that files hold them in.
//
//   vector  x, y, z in the first three channels, of any length
//   angle   one channel, 0 to 1 being one turn counter-clockwise from +u
//   flow    x, y in the first two channels, of any length; further ones are ignored
//   khr     KHR_materials_anisotropy: x, y in the first two channels, strength in [0,1] in the third
//
// Vectors are biased in integers and signed in floats, as normals are (normal/coding.h); khr is biased in both, as it
// is defined. A chosen encoding holds for each of them, and so does the other green.
//
// Files say which form they hold in the attribute burnish:direction; others, and TGA and BMP, are what they are said to
// be.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"
#include "burnish/normal/coding.h"

namespace burnish {

enum class DirectionForm { kVector, kAngle, kFlow, kKhr };
const char* name(DirectionForm form);  // "vector", …
int channels_of(DirectionForm form);   // that it takes

struct DirectionCoding {
  DirectionForm form = DirectionForm::kVector;
  GreenAxis green = GreenAxis::kUp;
  NormalEncoding encoding = NormalEncoding::kByType;
};

// A map, or some rows of it.
struct DirectionMap {
  std::string name;  // for messages
  int width = 0, height = 0;
  std::vector<Vec3f> vectors;    // of any length, 0 where there is no direction
  float error = 0;               // how far a component may be off (rounding_error)
  std::vector<float> strengths;  // of khr; otherwise empty
};

// Of a component that was stored in such samples, at most: half a step in integers; 0 in floats, as if they were exact.
float rounding_error(SampleType sample);

// kUnsupported for the signed encoding in integers: they hold no negative values.
void require_encodable(const DirectionCoding& coding, SampleType sample, const std::string& name);

// For the writer of a map of that form.
Attributes direction_attributes(DirectionForm form);

// A direction map in bands of rows.
class DirectionReader {
 public:
  // kMalformed for a file that says it holds another form, or a lookup table; for fewer channels than the form has, for
  // angles in more than one, and for a file that says its vectors are in object space; kUnsupported as above.
  DirectionReader(const FileRef& file, const DirectionCoding& coding);

  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  const std::string& name() const { return image_.name(); }

  // Rows [first, first + count), in any order; ascending is fast. kMalformed for NaN, infinity, and strengths beyond
  // [0,1].
  DirectionMap rows(int first, int count) { return decode(samples(first, count)); }
  // The two steps of it: the channels of the form as they are, and what they mean.
  Image samples(int first, int count);
  DirectionMap decode(const Image& samples) const;

 private:
  ImageReader image_;
  DirectionCoding coding_;
};

// All of it. Errors as DirectionReader.
DirectionMap read_direction_map(const FileRef& file, const DirectionCoding& coding);

// Unit vectors as samples of that type; in the plane of the map for angle and khr. Without strengths khr has 1.
Image encode_directions(const DirectionMap& map, const DirectionCoding& coding, SampleType sample);
// What a reader makes of such samples. kMalformed as DirectionReader::rows().
DirectionMap decode_directions(const std::string& name, const Image& samples, const DirectionCoding& coding,
                               SampleType sample);

}  // namespace burnish
