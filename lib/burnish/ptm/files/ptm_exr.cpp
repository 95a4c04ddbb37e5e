#include "burnish/ptm/files/ptm_exr.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "burnish/core/checked_output.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/wording.h"

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

int rows_at_once(const PtmShape& shape) { return std::clamp((1 << 16) / shape.width, 1, shape.height); }

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
    require_finite(first, band);
  }

 private:
  void require_finite(int first, const std::vector<float>& band) const {
    const std::size_t stored = reader_.channels();
    for (std::size_t i = 0; i < band.size() / stored; i++)
      for (const int c : from_)
        if (const float got = band[i * stored + c]; !std::isfinite(got))
          throw file_error(ErrorKind::kMalformed, reader_.name(),
                           "expected finite numbers, got " + number_text(got) + " at column " +
                               std::to_string(i % std::size_t(shape().width)) + ", row " +
                               std::to_string(first + i / std::size_t(shape().width)));
  }

  mutable std::mutex mutex_;
  mutable ImageReader reader_;
  std::vector<int> from_;  // where each wanted channel is stored
};

}  // namespace

void write_ptm_exr(const FileRef& file, const PtmRows& rows) {
  const PtmShape& shape = rows.shape();
  const std::vector<std::string> channels = channel_names(shape.type);
  detail::CheckedOutput out(file, FileType::kExr);
  auto spec = out.spec(SampleType::kFloat, shape.width, shape.height, int(channels.size()),
                       {{kAttribute, std::string(name(shape.type))}});
  spec.channelnames = channels;
  spec.alpha_channel = spec.z_channel = -1;
  out.open(spec);
  const int at_once = rows_at_once(shape), values = shape.polynomials() * kPtmTerms, colours = shape.colours();
  std::vector<float> coefficients, colour, band;
  for (int y = 0; y < shape.height; y += at_once) {
    const int count = std::min(at_once, shape.height - y);
    const std::size_t texels = std::size_t(count) * shape.width;
    coefficients.resize(texels * values), colour.resize(texels * colours), band.clear();
    rows.read(y, count, coefficients.data(), colour.data());
    for (std::size_t i = 0; i < texels; i++) {
      band.insert(band.end(), coefficients.begin() + i * values, coefficients.begin() + (i + 1) * values);
      band.insert(band.end(), colour.begin() + i * colours, colour.begin() + (i + 1) * colours);
    }
    out.require(out.image().write_scanlines(y, y + count, 0, spec.format, band.data()));
  }
  out.close();
}

std::unique_ptr<PtmRows> open_ptm_exr(const FileRef& file) { return std::make_unique<ExrRows>(ImageReader(file)); }

}  // namespace burnish
