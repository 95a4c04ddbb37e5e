#include <array>
#include <cmath>
#include <sstream>

#include "burnish/brdf/measured/observer.h"
#include "burnish/brdf/measured/readers.h"
#include "burnish/brdf/measured/scattered_brdf.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

constexpr int kMostWavelengths = 1000;
constexpr std::size_t kMostSamples = 1 << 20;

// Numbers of a text, whatever lines they stand on.
class Numbers {
 public:
  Numbers(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw file_error(ErrorKind::kMalformed, name_, "line " + std::to_string(line_) + ": " + message);
  }

  // Whether another follows.
  bool more() {
    for (; at_ < text_.size(); at_++) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ == text_.size()) return false;
      if (text_[at_] == '\n') line_++;
      else if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r') return true;
    }
    return false;
  }

  double next(const std::string& what, double least, double most) {
    if (!more()) fail("expected " + what + ", got the end of the file");
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n#", at_), text_.size());
    const std::string word = text_.substr(at_, end - at_);
    at_ = end;
    const std::optional<double> value = number_in<double>(word);
    if (!value || !(*value >= least && *value <= most))
      fail("expected " + what + " from " + number_text(least) + " to " + number_text(most) + ", got '" + excerpt(word) +
           "'");
    return *value;
  }

 private:
  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0, line_ = 1;
};

Vec3d direction(double theta, double phi) {
  return {portable::sin(theta) * portable::cos(phi), portable::sin(theta) * portable::sin(phi), portable::cos(theta)};
}

std::vector<double> read_wavelengths(Numbers& in) {
  const double count = in.next("the number of wavelengths", 2, kMostWavelengths);
  if (count != std::floor(count)) in.fail("expected the number of wavelengths, got " + number_text(count));
  std::vector<double> nm;
  for (int i = 0; i < int(count); i++) {
    nm.push_back(in.next("a wavelength in nm", kLeastWavelength_nm, kMostWavelength_nm));
    if (i > 0 && !(nm[i] > nm[i - 1])) in.fail("expected wavelengths that ascend, got " + number_text(nm[i]));
  }
  return nm;
}

}  // namespace

std::shared_ptr<const Brdf> parse_cornell(const std::string& text, const std::string& name,
                                          const HalfDifferenceCells& cells) {
  Numbers in(text, name);
  const std::vector<Vec3d> weights = srgb_weights(read_wavelengths(in));
  constexpr double kSteepest = 1.5707, kTurn = 6.2832, kMostReflected = 1e6;
  std::vector<ReflectanceSample> samples;
  while (in.more()) {
    if (samples.size() == kMostSamples) in.fail("expected at most " + std::to_string(kMostSamples) + " samples");
    std::array<double, 4> angle;
    for (int i = 0; i < 4; i++)
      angle[i] = i % 2 == 0 ? in.next("an angle from the normal", 0, kSteepest)
                            : in.next("an angle about the normal", -kTurn, kTurn);
    ReflectanceSample& s = samples.emplace_back();
    s.l = direction(angle[0], angle[1]), s.v = direction(angle[2], angle[3]);
    for (const Vec3d& w : weights) s.reflected += w * in.next("a reflectance in 1/sr", 0, kMostReflected);
  }
  if (samples.size() <= ScatteredReflectance::kNearest)
    in.fail("expected more than " + std::to_string(ScatteredReflectance::kNearest) + " samples, got " +
            std::to_string(samples.size()));
  return interpolated(samples, cells);
}

}  // namespace burnish
