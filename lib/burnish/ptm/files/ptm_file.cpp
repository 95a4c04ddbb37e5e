#include "burnish/ptm/files/ptm_file.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

#include "burnish/core/checked_file.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/texel_limit.h"
#include "burnish/core/whole_file.h"
#include "burnish/ptm/files/header_text.h"
#include "burnish/ptm/files/jpeg_planes.h"

namespace burnish {
namespace {

constexpr int kLargestSide = 1 << 20;
constexpr std::size_t kLargestFile = std::size_t(1) << 40;  // memory ends before
const std::string kFormat = "PTM_FORMAT_", kJpeg = "JPEG_", kLrgb = "LRGB", kRgb = "RGB";

// `interleaved`: colour stands behind each texel's coefficients.
void read_raw(std::string_view body, bool interleaved, const HeaderText& header, PtmBytes& out) {
  const std::size_t texels = out.texels();
  const int in_texel = out.polynomials() * kPtmTerms + out.colours();
  if (body.size() / in_texel < texels)
    header.fail("expected " + std::to_string(texels * in_texel) + " bytes for " + std::to_string(out.width) + "x" +
                std::to_string(out.height) + " texels, got " + std::to_string(body.size()));
  out.coefficients.resize(texels * out.polynomials() * kPtmTerms);
  out.colour.resize(texels * out.colours());
  const auto* from = reinterpret_cast<const std::uint8_t*>(body.data());
  // `count` of every `per_texel` bytes to every `stride` bytes. Bottom row first in files, top row first here.
  const auto rows = [&](const std::uint8_t* at, int per_texel, int count, std::uint8_t* to, int stride) {
    for (int y = out.height - 1; y >= 0; y--)
      for (int x = 0; x < out.width; x++, at += per_texel)
        std::copy_n(at, count, to + (std::size_t(y) * out.width + x) * stride);
  };
  std::uint8_t* const to = out.coefficients.data();
  if (out.type == PtmType::kRgb) {
    for (int c = 0; c < 3; c++)
      rows(from + texels * kPtmTerms * c, kPtmTerms, kPtmTerms, to + c * kPtmTerms, 3 * kPtmTerms);
  } else if (interleaved) {
    rows(from, 9, kPtmTerms, to, kPtmTerms);
    rows(from + kPtmTerms, 9, 3, out.colour.data(), 3);
  } else {
    rows(from, kPtmTerms, kPtmTerms, to, kPtmTerms);
    rows(from + texels * kPtmTerms, 3, 3, out.colour.data(), 3);
  }
}

template <typename Write>
void write_raw(const PtmBytes& ptm, const Write& write) {
  std::vector<std::uint8_t> row(std::size_t(ptm.width) * kPtmTerms);
  const auto rows = [&](int per_texel, const std::uint8_t* of, int stride) {
    for (int y = ptm.height - 1; y >= 0; y--) {
      for (int x = 0; x < ptm.width; x++)
        std::copy_n(of + (std::size_t(y) * ptm.width + x) * stride, per_texel,
                    row.begin() + std::size_t(x) * per_texel);
      write(row.data(), std::size_t(ptm.width) * per_texel);
    }
  };
  const int polynomials = ptm.polynomials();
  for (int c = 0; c < polynomials; c++)
    rows(kPtmTerms, ptm.coefficients.data() + c * kPtmTerms, polynomials * kPtmTerms);
  if (ptm.colours()) rows(3, ptm.colour.data(), 3);
}

}  // namespace

bool is_ptm(const FileRef& file) {
  require_readable(file);
  char head[4] = {};
  std::ifstream(file.path, std::ios::binary).read(head, sizeof head);
  return std::string_view(head, sizeof head) == "PTM_";
}

PtmFile read_ptm(const FileRef& file) {
  const std::string bytes = read_file(file, kLargestFile);
  HeaderText header(bytes, file.name);
  const std::string magic = bytes.starts_with("PTM_") ? header.word("PTM_1.2") : "";
  if (magic != "PTM_1.2" && magic != "PTM_1.1" && magic != "PTM_1.0")
    header.fail("expected a polynomial texture map, which begins with PTM_1.2, got '" + excerpt(bytes) + "'");
  std::string format = header.word("a format");
  if (!format.starts_with(kFormat))
    header.fail("expected a format such as PTM_FORMAT_LRGB, got '" + excerpt(format) + "'");
  format.erase(0, kFormat.size());
  const bool is_jpeg = format == kJpeg + kLrgb || format == kJpeg + kRgb;
  if (!is_jpeg && format != kLrgb && format != kRgb)
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected an LRGB or RGB map, raw or in JPEG planes, got " + excerpt(kFormat + format));
  PtmFile out;
  out.format = magic + " " + format;
  out.type = format.ends_with(kLrgb) ? PtmType::kLrgb : PtmType::kRgb;
  out.width = header.integer("a width", 1, kLargestSide);
  out.height = header.integer("a height", 1, kLargestSide);
  for (double& s : out.scale) s = header.number("a scale");
  constexpr int kMost = std::numeric_limits<int>::max() / 2;
  for (int& b : out.bias) b = header.integer("a bias", -kMost, kMost);
  if (!floats_hold(out.scale, out.bias))
    header.fail("expected coefficients that floats hold, got a scale or bias beyond them");
  // Raw bytes are as many as they say; what JPEG packs is not.
  if (is_jpeg) require_within_texel_limit(file.name, std::uint32_t(out.width), std::uint32_t(out.height));
  if (is_jpeg) read_jpeg_planes(header, out);
  else read_raw(header.body("biases"), magic != "PTM_1.2", header, out);
  return out;
}

void write_ptm(const FileRef& file, const PtmBytes& ptm, int jpeg_quality) {
  std::string head = "PTM_1.2\n" + kFormat + (jpeg_quality ? kJpeg : "") + (ptm.type == PtmType::kRgb ? kRgb : kLrgb) +
                     "\n" + std::to_string(ptm.width) + "\n" + std::to_string(ptm.height) + "\n";
  const auto line = [&](const auto& values, auto&& text) {
    for (std::size_t k = 0; k < values.size(); k++) head += text(values[k]) + (k + 1 < values.size() ? " " : "\n");
  };
  line(ptm.scale, [](double s) { return number_text(s); });
  line(ptm.bias, [](int b) { return std::to_string(b); });

  CheckedFile out(file.path);
  const auto write = [&](const void* bytes, std::size_t size) {
    if (out.first_error() || out.write(bytes, size) != size) throw out.error(file.name);
  };
  if (jpeg_quality) head += jpeg_planes(ptm, jpeg_quality, file.name);
  write(head.data(), head.size());
  if (!jpeg_quality) write_raw(ptm, write);
  out.close();
  if (out.first_error()) throw out.error(file.name);
}

}  // namespace burnish
