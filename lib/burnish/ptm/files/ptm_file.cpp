#include "burnish/ptm/files/ptm_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"

namespace burnish {
namespace {

constexpr int kLargestSide = 1 << 20;
const std::string kFormat = "PTM_FORMAT_";

// Walks over the text at the beginning of a file.
class Header {
 public:
  Header(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string& message) const { throw file_error(ErrorKind::kMalformed, name_, message); }

  std::string word(const char* what) {
    while (at_ < bytes_.size() && is_blank(bytes_[at_])) at_++;
    const std::size_t first = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && at_ - first < kLongest) at_++;
    if (at_ == first) fail(std::string("expected ") + what + ", got the end of the file");
    return bytes_.substr(first, at_ - first);
  }

  double number(const char* what) {
    const std::string text = word(what);
    double value = 0;
    const char* first = text.data() + (text[0] == '+');
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(std::string("expected ") + what + ", got '" + excerpt(text) + "'");
    return value;
  }

  int integer(const char* what, int least, int most) {
    const double value = number(what);
    if (!(value >= least && value <= most && value == std::floor(value)))
      fail(std::string("expected ") + what + " from " + std::to_string(least) + " to " + std::to_string(most) +
           ", got " + number_text(value));
    return int(value);
  }

  // Where the body begins: behind the end of the line.
  std::size_t end_line() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_]) && bytes_[at_] != '\n') at_++;
    if (at_ == bytes_.size() || bytes_[at_] != '\n') fail("expected the end of a line behind the biases");
    return at_ + 1;
  }

 private:
  static constexpr std::size_t kLongest = 64;
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  const std::string& bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

std::string whole_file(const FileRef& file) {
  require_readable(file);
  std::ifstream in(file.path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return bytes;
}

// Bytes between file and memory: bottom row first there, top row first here. `per_texel` consecutive ones of each texel
// go to every `stride` bytes from `offset`.
template <typename FileBytes, typename MemoryBytes, typename Copy>
void for_each_row(int width, int height, int per_texel, FileBytes file, MemoryBytes memory, int stride, Copy&& copy) {
  for (int y = 0; y < height; y++) {
    auto from = file + std::size_t(height - 1 - y) * width * per_texel;
    auto to = memory + std::size_t(y) * width * stride;
    for (int x = 0; x < width; x++) copy(from + std::size_t(x) * per_texel, to + std::size_t(x) * stride);
  }
}

}  // namespace

PtmFile read_ptm(const FileRef& file) {
  const std::string bytes = whole_file(file);
  Header header(bytes, file.name);
  const std::string magic = bytes.starts_with("PTM_") ? header.word("PTM_1.2") : "";
  if (magic != "PTM_1.2" && magic != "PTM_1.1" && magic != "PTM_1.0")
    header.fail("expected a polynomial texture map, which begins with PTM_1.2, got '" + excerpt(bytes) + "'");
  const std::string format = header.word("a format");
  PtmFile out;
  out.format = magic + " " + format.substr(std::min(format.size(), kFormat.size()));
  if (format == kFormat + "LRGB") out.type = PtmType::kLrgb;
  else if (format == kFormat + "RGB") out.type = PtmType::kRgb;
  else if (format.starts_with(kFormat))
    throw file_error(ErrorKind::kUnsupported, file.name, "expected an LRGB or RGB map, got " + excerpt(format));
  else header.fail("expected a format such as PTM_FORMAT_LRGB, got '" + excerpt(format) + "'");
  out.width = header.integer("a width", 1, kLargestSide);
  out.height = header.integer("a height", 1, kLargestSide);
  for (double& s : out.scale) s = header.number("a scale");
  constexpr int kMost = std::numeric_limits<int>::max() / 2;
  for (int& b : out.bias) b = header.integer("a bias", -kMost, kMost);
  const std::size_t body = header.end_line(), texels = out.texels();
  const int in_texel = out.polynomials() * kPtmTerms + out.colours();
  if ((bytes.size() - body) / in_texel < texels)
    header.fail("expected " + std::to_string(texels * in_texel) + " bytes for " + std::to_string(out.width) + "x" +
                std::to_string(out.height) + " texels, got " + std::to_string(bytes.size() - body));

  out.coefficients.resize(texels * out.polynomials() * kPtmTerms);
  out.colour.resize(texels * out.colours());
  const auto* from = reinterpret_cast<const std::uint8_t*>(bytes.data()) + body;
  const auto rows = [&](int per_texel, std::size_t at, std::uint8_t* to, int stride, int first, int count) {
    for_each_row(out.width, out.height, per_texel, from + at, to, stride,
                 [&](const std::uint8_t* a, std::uint8_t* b) { std::copy_n(a + first, count, b); });
  };
  if (out.type == PtmType::kRgb) {
    for (int c = 0; c < 3; c++)
      rows(kPtmTerms, texels * kPtmTerms * c, out.coefficients.data() + c * kPtmTerms, 3 * kPtmTerms, 0, kPtmTerms);
  } else if (magic == "PTM_1.2") {
    rows(kPtmTerms, 0, out.coefficients.data(), kPtmTerms, 0, kPtmTerms);
    rows(3, texels * kPtmTerms, out.colour.data(), 3, 0, 3);
  } else {
    rows(9, 0, out.coefficients.data(), kPtmTerms, 0, kPtmTerms);
    rows(9, 0, out.colour.data(), 3, kPtmTerms, 3);
  }
  return out;
}

void write_ptm(const FileRef& file, const PtmBytes& ptm) {
  std::string head = "PTM_1.2\n" + kFormat + (ptm.type == PtmType::kRgb ? "RGB" : "LRGB") + "\n" +
                     std::to_string(ptm.width) + "\n" + std::to_string(ptm.height) + "\n";
  const auto line = [&](const auto& values, auto&& text) {
    for (std::size_t k = 0; k < values.size(); k++) head += text(values[k]) + (k + 1 < values.size() ? " " : "\n");
  };
  line(ptm.scale, [](double s) { return number_text(s); });
  line(ptm.bias, [](int b) { return std::to_string(b); });

  CheckedFile out(file.path);
  const auto write = [&](const void* bytes, std::size_t size) {
    if (out.first_error() || out.write(bytes, size) != size) throw out.error(file.name);
  };
  write(head.data(), head.size());
  std::vector<std::uint8_t> plane(ptm.texels() * kPtmTerms);
  const auto rows = [&](int per_texel, const std::uint8_t* of, int stride) {
    for_each_row(ptm.width, ptm.height, per_texel, plane.data(), of, stride,
                 [&](std::uint8_t* a, const std::uint8_t* b) { std::copy_n(b, per_texel, a); });
    write(plane.data(), ptm.texels() * per_texel);
  };
  const int polynomials = ptm.polynomials();
  for (int c = 0; c < polynomials; c++)
    rows(kPtmTerms, ptm.coefficients.data() + c * kPtmTerms, polynomials * kPtmTerms);
  if (ptm.colours()) rows(3, ptm.colour.data(), 3);
  out.close();
  if (out.first_error()) throw out.error(file.name);
}

}  // namespace burnish
