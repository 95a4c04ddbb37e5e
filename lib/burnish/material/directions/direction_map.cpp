#include "burnish/material/directions/direction_map.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/core/portable_math.h"
#include "burnish/core/samples.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/whole_image.h"
#include "burnish/core/wording.h"
#include "burnish/normal/normal_space.h"

namespace burnish {
namespace {

const std::string kAttribute = "burnish:direction";

bool is_biased(const DirectionCoding& coding, SampleType sample) {
  const bool by_definition = coding.form == DirectionForm::kKhr && coding.encoding == NormalEncoding::kByType;
  return by_definition || is_biased(coding.encoding, is_integer(sample));
}

void require_channels(const std::string& name, int channels, DirectionForm form) {
  const int wanted = channels_of(form);
  if (channels == wanted || (channels > wanted && form != DirectionForm::kAngle)) return;
  throw file_error(ErrorKind::kMalformed, name,
                   "expected " + counted(std::size_t(wanted), "channel") + " of directions as " + burnish::name(form) +
                       ", got " + std::to_string(channels));
}

void require_values(const std::string& name, const Image& samples, DirectionForm form, int first_row) {
  const auto require = [&](int first, int last, const auto& holds, const char* wanted) {
    require_samples(name, samples.data, samples.width, samples.channels, first, last, holds, wanted, first_row);
  };
  require(
      0, channels_of(form), [](float v) { return std::isfinite(v); }, "finite directions");
  if (form == DirectionForm::kKhr)
    require(
        2, 3, [](float v) { return v >= 0 && v <= 1; }, "a strength from 0 to 1");
}

// What the file says it holds, where it says so: another form would be taken for vectors that it has not.
void require_recorded(const ImageReader& reader, DirectionForm form) {
  const std::string expected = std::string("expected directions as ") + name(form) + ", got ";
  if (const std::optional<std::string> function = reader.text("burnish:function"))
    throw file_error(ErrorKind::kMalformed, reader.name(), expected + "a lookup table of " + excerpt(*function));
  const std::optional<std::string> recorded = reader.text(kAttribute);
  if (!recorded || *recorded == name(form)) return;
  const std::string writes = form == DirectionForm::kFlow ? "" : std::string(" and writes it --to ") + name(form);
  throw file_error(ErrorKind::kMalformed, reader.name(),
                   expected + excerpt(*recorded) + ": burnish-tangents reads it --from " + excerpt(*recorded) + writes);
}

DirectionMap decoded(const std::string& name, const Image& samples, const DirectionCoding& coding, SampleType sample) {
  const bool biased = is_biased(coding, sample);
  const float scale = biased ? 2.f : 1.f, bias = biased ? -1.f : 0.f;
  const float up = coding.green == GreenAxis::kDown ? -1.f : 1.f;
  const bool angles = coding.form == DirectionForm::kAngle, flat = coding.form != DirectionForm::kVector;
  DirectionMap map{name, samples.width, samples.height, std::vector<Vec3f>(samples.texels()), 0, {}};
  if (!angles) map.error = rounding_error(sample);
  parallel_for(map.height, [&](std::size_t y) {
    for (int x = 0; x < map.width; x++) {
      const float* s = samples.at(x, int(y));
      Vec3f& v = map.vectors[y * map.width + x];
      if (angles) v = Vec3f(Vec3d{portable::cos(2 * kPi * s[0]), portable::sin(2 * kPi * s[0]), 0});
      else v = {s[0] * scale + bias, up * (s[1] * scale + bias), flat ? 0 : s[2] * scale + bias};
    }
  });
  if (coding.form == DirectionForm::kKhr)
    for (std::size_t i = 0; i < samples.texels(); i++) map.strengths.push_back(samples.data[i * samples.channels + 2]);
  return map;
}

}  // namespace

float rounding_error(SampleType sample) {
  return !is_integer(sample) ? 0 : sample == SampleType::kUint8 ? 1 / 255.f : 1 / 65535.f;
}

void require_encodable(const DirectionCoding& coding, SampleType sample, const std::string& name) {
  if (coding.form != DirectionForm::kAngle) require_encodable({coding.green, coding.encoding, ""}, sample, name);
}

int channels_of(DirectionForm form) { return form == DirectionForm::kAngle ? 1 : form == DirectionForm::kFlow ? 2 : 3; }

const char* name(DirectionForm form) {
  switch (form) {
    case DirectionForm::kVector:
      return "vector";
    case DirectionForm::kAngle:
      return "angle";
    case DirectionForm::kFlow:
      return "flow";
    default:
      return "khr";
  }
}

Attributes direction_attributes(DirectionForm form) {
  Attributes attributes{{kAttribute, name(form)}};
  if (form == DirectionForm::kVector)
    for (const auto& attribute : space_attributes(NormalSpace::kTangent)) attributes.push_back(attribute);
  return attributes;
}

DirectionReader::DirectionReader(const FileRef& file, const DirectionCoding& coding) : image_(file), coding_(coding) {
  require_recorded(image_, coding.form);
  require_channels(file.name, image_.channels(), coding.form);
  require_encodable(coding, image_.sample_type(), file.name);
  if (recorded_space(image_) == NormalSpace::kObject)
    throw file_error(ErrorKind::kMalformed, file.name, "expected directions in tangent space, got object space");
}

Image DirectionReader::samples(int first, int count) {
  Image samples;
  samples.width = width(), samples.height = count, samples.channels = channels_of(coding_.form);
  const std::size_t width = std::size_t(samples.width), all = std::size_t(image_.channels()),
                    wanted = std::size_t(samples.channels);
  std::vector<float> band;
  samples.data = read_whole<float>(name(), count, width * wanted, [&](int row, int some, float* out) {
    band.resize(width * all * std::size_t(some));
    image_.read_rows(first + row, some, band.data());
    for (std::size_t i = 0; i < width * std::size_t(some); i++) std::copy_n(&band[i * all], wanted, out + i * wanted);
  });
  require_values(name(), samples, coding_.form, first);
  return samples;
}

DirectionMap DirectionReader::decode(const Image& samples) const {
  return decoded(name(), samples, coding_, image_.sample_type());
}

DirectionMap read_direction_map(const FileRef& file, const DirectionCoding& coding) {
  DirectionReader reader(file, coding);
  return reader.rows(0, reader.height());
}

DirectionMap decode_directions(const std::string& name, const Image& samples, const DirectionCoding& coding,
                               SampleType sample) {
  require_values(name, samples, coding.form, 0);
  return decoded(name, samples, coding, sample);
}

Image encode_directions(const DirectionMap& map, const DirectionCoding& coding, SampleType sample) {
  const bool biased = is_biased(coding, sample);
  const float scale = biased ? 0.5f : 1.f, bias = biased ? 0.5f : 0.f;
  const float up = coding.green == GreenAxis::kDown ? -1.f : 1.f;
  Image samples(map.width, map.height, channels_of(coding.form));
  parallel_for(map.height, [&](std::size_t y) {
    for (int x = 0; x < map.width; x++) {
      const std::size_t i = y * map.width + x;
      const Vec3f v = map.vectors[i];
      float* s = samples.at(x, int(y));
      if (coding.form == DirectionForm::kAngle) {
        const double turns = portable::atan2(double(v.y), double(v.x)) / (2 * kPi);
        s[0] = float(turns < 0 ? turns + 1 : turns);
        continue;
      }
      s[0] = scale * v.x + bias;
      s[1] = scale * up * v.y + bias;
      if (coding.form == DirectionForm::kVector) s[2] = scale * v.z + bias;
      if (coding.form == DirectionForm::kKhr) s[2] = map.strengths.empty() ? 1 : map.strengths[i];
    }
  });
  round_to_samples(sample, samples.data);
  return samples;
}

}  // namespace burnish
