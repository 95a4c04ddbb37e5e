#include "burnish/palette/files/histogram_file.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/whole_file.h"
#include "burnish/palette/files/texture_container.h"

namespace burnish {
namespace {

using detail::append_u64, detail::u64_at;

const std::string kName = "burnish-histogram ", kVersion = "1\n";
constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMostTexels = std::uint64_t(1) << 48;  // of a file, so that thousands add up to no overflow
constexpr int kExact = 0, kBins = 1;

Error damaged(const FileRef& file, const std::string& expected, const std::string& got) {
  return file_error(ErrorKind::kMalformed, file.name, "expected " + expected + ", got " + got);
}

void put(std::string& out, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) out += char(number | 0x80);
  out += char(number);
}

// Numbers out of a body, each with what it may be.
class Numbers {
 public:
  Numbers(const FileRef& file, std::string bytes) : file_(file), bytes_(std::move(bytes)) {}

  std::uint64_t take(const std::string& what, std::uint64_t least, std::uint64_t most) {
    std::uint64_t number = 0;
    for (int shift = 0;; shift += 7) {
      if (at_ == bytes_.size()) throw damaged(file_, what, "the end of the file");
      const std::uint64_t byte = std::uint8_t(bytes_[at_++]), bits = byte & 0x7f;
      if (shift > 63 || (shift == 63 && bits > 1) || (shift > 0 && byte == 0))
        throw damaged(file_, what, "no number in its shortest form");
      number |= bits << shift;
      if (byte < 0x80) break;
    }
    if (number < least || number > most)
      throw damaged(file_, what + " from " + std::to_string(least) + " to " + std::to_string(most),
                    std::to_string(number));
    return number;
  }
  // How many things follow, of at least so many numbers each.
  std::size_t take_count(const std::string& things, std::size_t most, std::size_t numbers_each) {
    const std::size_t n = take("a number of " + things, 1, most);
    if (n > (bytes_.size() - at_) / numbers_each)
      throw damaged(file_, std::to_string(n) + " " + things, "the end of the file");
    return n;
  }
  void end() const {
    if (at_ != bytes_.size()) throw damaged(file_, "an end", std::to_string(bytes_.size() - at_) + " more bytes");
  }

 private:
  const FileRef& file_;
  std::string bytes_;
  std::size_t at_ = 0;
};

std::string inflated(const FileRef& file, const std::string& bytes, std::size_t from) {
  constexpr std::size_t kMostRatio = 1032;                  // of deflate
  constexpr std::size_t kMostSize = std::size_t(64) << 20;  // all keys, their steps and counts as long as can be
  const std::uint64_t size = u64_at(bytes, from);
  if (size > kMostSize) throw damaged(file, "at most " + std::to_string(kMostSize) + " bytes", std::to_string(size));
  const std::size_t packed = bytes.size() - from - sizeof size;
  if (size > packed * kMostRatio)
    throw damaged(file, "at most " + std::to_string(packed * kMostRatio) + " bytes in " + std::to_string(packed),
                  std::to_string(size));
  std::string out(size, '\0');
  uLongf made = size;
  uLong used = packed;
  const auto* in = reinterpret_cast<const Bytef*>(bytes.data() + from + sizeof size);
  if (uncompress2(reinterpret_cast<Bytef*>(out.data()), &made, in, &used) != Z_OK || made != size)
    throw damaged(file, "a zlib stream of " + std::to_string(size) + " bytes", "a damaged or shortened one");
  if (used != packed) throw damaged(file, "an end", std::to_string(packed - used) + " more bytes");
  return out;
}

// Where a bin's texels would lie if all were in its middle, and how far from it a sum may be, a texel.
struct BinMiddle {
  std::int64_t x, y, z, reach;

  BinMiddle(std::uint64_t key, int shift) {
    constexpr double kScale = (1 << (NormalBins::kBits - 1)) - 1;
    const double half = 0.5 * ((1 << shift) - 1);
    const auto coordinate = [&](std::uint64_t code) { return (double(code & 0xffff) + half) / kScale - 1; };
    const Vec3d n = from_octahedral({coordinate(key >> 16), coordinate(key)});
    x = std::llround(n.x * NormalBins::kUnit), y = std::llround(n.y * NormalBins::kUnit);
    z = std::llround(n.z * NormalBins::kUnit);
    // A component changes by at most √3·√6 times a coordinate; a float is some 2^-23 off.
    const double most = 4.25 * (half + 0.5) / kScale;
    reach = std::int64_t(std::min(most, 2.0) * NormalBins::kUnit) + 32;
  }
};

std::uint64_t zigzag(std::int64_t v) { return std::uint64_t(v) << 1 ^ std::uint64_t(v >> 63); }
std::int64_t unzigzag(std::uint64_t v) { return std::int64_t(v >> 1) ^ -std::int64_t(v & 1); }

void put_keys(std::string& out, const NormalCounts& counts) {
  std::vector<NormalCounts::Key> keys = counts.keys();
  std::ranges::sort(keys, {}, &NormalCounts::Key::key);
  put(out, kExact);
  put(out, keys.size());
  std::uint64_t last = 0;
  for (const NormalCounts::Key& k : keys) put(out, k.key - last), last = k.key;
  for (const NormalCounts::Key& k : keys) put(out, k.texels);
  for (const NormalCounts::Key& k : keys) put(out, k.masked);
}

void put_bins(std::string& out, const NormalCounts& counts) {
  const std::vector<NormalBins::Bin> bins = counts.bins().sorted();
  const int shift = counts.bins().shift();
  put(out, kBins);
  put(out, std::uint64_t(shift));
  put(out, counts.texels().invalid);
  put(out, bins.size());
  std::uint64_t last = 0;
  for (const NormalBins::Bin& b : bins) put(out, b.key - last), last = b.key;
  for (const NormalBins::Bin& b : bins) put(out, b.sum.texels);
  for (const auto& [key, sum] : bins) {
    const BinMiddle middle(key, shift);
    const std::int64_t n = std::int64_t(sum.texels);
    put(out, zigzag(sum.x - n * middle.x));
    put(out, zigzag(sum.y - n * middle.y));
    put(out, zigzag(sum.z - n * middle.z));
  }
}

// Ascending; `is_one` says of a number whether it is a key.
template <typename IsOne>
std::vector<std::uint64_t> take_keys(const FileRef& file, Numbers& in, std::size_t n, const IsOne& is_one) {
  std::vector<std::uint64_t> keys(n);
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < n; i++) {
    keys[i] = last + in.take("a step to the next key", i > 0, kMost - last);
    if (!is_one(keys[i])) throw damaged(file, "a key of a normal", std::to_string(keys[i]));
    last = keys[i];
  }
  return keys;
}

NormalCounts take_exact(const FileRef& file, Numbers& in) {
  const std::size_t n = in.take_count("keys", NormalCounts::kMostKeys, 3);
  const std::vector<std::uint64_t> keys = take_keys(file, in, n, [](std::uint64_t key) {
    const NormalCounts::Key k{key};
    return k.material() <= 255 && TexelKeys::is_key(k.texel());
  });
  std::vector<std::uint64_t> texels(n);
  std::uint64_t left = kMostTexels;
  for (std::uint64_t& t : texels) left -= t = in.take("texels of a normal", 0, left);
  NormalCounts counts;
  for (std::size_t i = 0; i < n; i++) {
    const std::uint64_t masked = in.take("masked texels of a normal", texels[i] == 0, left);
    left -= masked;
    counts.add(NormalCounts::Key{keys[i], texels[i], masked});
  }
  return counts;
}

NormalCounts take_bins(const FileRef& file, Numbers& in) {
  const int shift = int(in.take("bits that bins are coarser by", 0, NormalBins::kBits));
  const std::uint64_t invalid = in.take("invalid texels", 0, kMostTexels);
  const std::size_t n = in.take_count("bins", NormalBins::kMost, 5);
  const std::vector<std::uint64_t> keys =
      take_keys(file, in, n, [&](std::uint64_t key) { return NormalBins::is_key(key, shift); });
  std::vector<std::uint64_t> texels(n);
  for (std::uint64_t& t : texels) t = in.take("texels of a bin", 1, NormalBins::kMostTexels);
  NormalBins bins(shift);
  for (std::size_t i = 0; i < n; i++) {
    const BinMiddle middle(keys[i], shift);
    const std::int64_t of = std::int64_t(texels[i]);
    const auto component = [&](std::int64_t each) {
      return of * each + unzigzag(in.take("a sum of unit normals", 0, 2 * std::uint64_t(of * middle.reach)));
    };
    const std::int64_t x = component(middle.x), y = component(middle.y), z = component(middle.z);
    bins.add({keys[i], {x, y, z, texels[i]}});
  }
  NormalCounts counts(std::move(bins), invalid);
  if (invalid > counts.texels().counted)
    throw damaged(file, "at most " + std::to_string(counts.texels().counted) + " invalid texels",
                  std::to_string(invalid));
  return counts;
}

}  // namespace

HistogramFile read_histogram(const FileRef& file) {
  const std::string bytes = read_file(file, std::size_t(64) << 20);
  if (!bytes.starts_with(kName))
    throw damaged(file, "a histogram, as --histogram-output writes it", "'" + excerpt(bytes.substr(0, 18)) + "'");
  const std::size_t from = kName.size() + kVersion.size();
  if (const std::string version = bytes.substr(kName.size(), kVersion.size());
      version != kVersion && version.size() == kVersion.size())
    throw file_error(ErrorKind::kUnsupported, file.name,
                     "expected burnish-histogram 1, got '" + excerpt(bytes.substr(0, from)) + "'");
  if (bytes.size() < from + sizeof(std::uint64_t)) throw damaged(file, "a size", "the end of the file");

  Numbers in(file, inflated(file, bytes, from));
  HistogramFile histogram;
  if (const std::uint64_t space = in.take("a space", 0, 2))
    histogram.space = space == 1 ? NormalSpace::kTangent : NormalSpace::kObject;
  const bool binned = in.take("a kind of histogram", kExact, kBins) == kBins;
  histogram.counts = binned ? take_bins(file, in) : take_exact(file, in);
  in.end();
  if (histogram.counts.texels().counted == 0) throw damaged(file, "texels that are not masked out", "none");
  return histogram;
}

void write_histogram(const FileRef& file, const HistogramFile& histogram) {
  std::string body;
  put(body, !histogram.space ? 0 : *histogram.space == NormalSpace::kTangent ? 1 : 2);
  if (histogram.counts.exact()) put_keys(body, histogram.counts);
  else put_bins(body, histogram.counts);
  std::string out = kName + kVersion;
  append_u64(out, body.size());
  const std::size_t head = out.size();
  uLongf packed = compressBound(body.size());
  out.resize(head + packed);
  if (compress2(reinterpret_cast<Bytef*>(out.data() + head), &packed, reinterpret_cast<const Bytef*>(body.data()),
                body.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw file_error(ErrorKind::kInternal, file.name, "cannot be deflated");
  out.resize(head + packed);
  write_file(file, out);
}

}  // namespace burnish
