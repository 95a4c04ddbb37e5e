#include "burnish/ptm/files/ptm_exr.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/image_chain.h"
#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {
namespace {

const std::string kAttribute = "burnish:ptm";

std::vector<std::string> channel_names(PtmType type) {
  std::vector<std::string> names;
  for (const char* of : type == PtmType::kRgb ? std::vector{"R.", "G.", "B."} : std::vector{""})
    for (int k = 0; k < kPtmTerms; k++) names.push_back(of + ("a" + std::to_string(k)));
  if (type == PtmType::kLrgb) names.insert(names.end(), {"R", "G", "B"});
  return names;
}

// Whole blocks of the compression, 16 rows.
int rows_at_once(const PtmShape& shape) { return std::clamp((1 << 18) / shape.width / 16 * 16, 16, 1 << 18); }

PtmShape shape_of(const ImageReader& reader) {
  PtmShape shape{PtmType::kLrgb, reader.width(), reader.height()};
  const std::string type = reader.text(kAttribute).value_or("");
  if (type == name(PtmType::kRgb)) shape.type = PtmType::kRgb;
  else if (type != name(PtmType::kLrgb))
    throw file_error(ErrorKind::kMalformed, reader.name(),
                     "expected a polynomial texture map, whose attribute burnish:ptm is lrgb or rgb, got " +
                         (type.empty() ? "none" : "'" + excerpt(type) + "'"));
  return shape;
}

class ExrRows : public PtmRows {
 public:
  explicit ExrRows(ImageReader&& reader) : PtmRows(shape_of(reader)), reader_(std::move(reader)) {
    const std::vector<std::string>& stored = reader_.channel_names();
    for (const std::string& channel : channel_names(shape().type)) {
      const auto found = std::ranges::find(stored, channel);
      if (found == stored.end())
        throw file_error(ErrorKind::kMalformed, reader_.name(), "expected a channel " + channel + ", got none");
      from_.push_back(int(found - stored.begin()));
    }
    if (reader_.integer()) throw file_error(ErrorKind::kMalformed, reader_.name(), "expected floats, got integers");
  }

  void read(int first, int count, float* coefficients, float* colour) const override {
    const std::size_t texels = std::size_t(count) * shape().width, stored = reader_.channels();
    std::vector<float> band(texels * stored);
    {
      const std::lock_guard lock(mutex_);
      reader_.read_rows(first, count, band.data());
    }
    const int wanted = shape().polynomials() * kPtmTerms, colours = shape().colours();
    for (std::size_t i = 0; i < texels; i++) {
      const float* texel = band.data() + i * stored;
      for (int k = 0; k < wanted; k++) *coefficients++ = texel[from_[k]];
      for (int k = 0; k < colours; k++) *colour++ = texel[from_[wanted + k]];
    }
    require_values(first, band);
  }

 private:
  // Coefficients are finite, colours from 0 to 255.
  void require_values(int first, const std::vector<float>& band) const {
    const std::size_t stored = reader_.channels(), terms = std::size_t(shape().polynomials()) * kPtmTerms;
    for (std::size_t i = 0; i < band.size() / stored; i++)
      for (std::size_t k = 0; k < from_.size(); k++) {
        const float got = band[i * stored + from_[k]];
        if (k < terms ? std::isfinite(got) : got >= 0 && got <= 255) continue;
        throw file_error(ErrorKind::kMalformed, reader_.name(),
                         std::string("expected ") + (k < terms ? "finite coefficients" : "colours from 0 to 255") +
                             ", got " + number_text(got) + " at column " +
                             std::to_string(i % std::size_t(shape().width)) + ", row " +
                             std::to_string(first + i / std::size_t(shape().width)));
      }
  }

  mutable std::mutex mutex_;
  mutable ImageReader reader_;
  std::vector<int> from_;  // where each wanted channel is stored
};

Attributes attributes_of(PtmType type) { return {{kAttribute, std::string(name(type))}}; }

// A texel's coefficients, then its colour.
Image interleaved(const PtmShape& shape, const std::vector<float>& coefficients, const std::vector<float>& colour) {
  const int values = shape.polynomials() * kPtmTerms, colours = shape.colours();
  Image samples;
  samples.width = shape.width, samples.height = shape.height, samples.channels = values + colours;
  samples.data.reserve(coefficients.size() + colour.size());
  for (std::size_t i = 0; i < shape.texels(); i++) {
    samples.data.insert(samples.data.end(), coefficients.begin() + i * values, coefficients.begin() + (i + 1) * values);
    samples.data.insert(samples.data.end(), colour.begin() + i * colours, colour.begin() + (i + 1) * colours);
  }
  return samples;
}

}  // namespace

void write_ptm_exr(const FileRef& file, const PtmRows& rows) {
  const PtmShape& shape = rows.shape();
  const std::vector<std::string> channels = channel_names(shape.type);
  ImageWriter writer(file, FileType::kExr, SampleType::kFloat, shape.width, shape.height, int(channels.size()),
                     attributes_of(shape.type), channels);
  const int at_once = rows_at_once(shape);
  for (int y = 0; y < shape.height; y += at_once) {
    const PtmBand band(rows, y, std::min(at_once, shape.height - y));
    writer.write_rows(band.height, interleaved(band, band.coefficients, band.colour).data.data());
  }
  writer.close();
}

void write_ptm_exr_chain(const FileRef& file, std::span<const Ptm> levels) {
  if (levels.size() == 1) return write_ptm_exr(file, PtmInMemory(levels[0]));
  const PtmType type = levels[0].type;
  const std::vector<std::string> channels = channel_names(type);
  ImageChainWriter writer(file, SampleType::kFloat, levels[0].width, levels[0].height, int(channels.size()),
                          int(levels.size()), attributes_of(type), channels);
  for (std::size_t l = 0; l < levels.size(); l++) {
    const Image samples = interleaved(levels[l], levels[l].coefficients, levels[l].colour);
    writer.write_rows(int(l), samples.height, samples.data.data());
  }
  writer.close();
}

std::unique_ptr<PtmRows> open_ptm_exr(const FileRef& file) { return std::make_unique<ExrRows>(ImageReader(file)); }

}  // namespace burnish
