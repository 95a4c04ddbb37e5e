// PNG and EXR of every kind, made by libpng and OpenEXR themselves: they are read as OpenImageIO reads them.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <random>

#include "burnish/core/image_io.h"
#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::bytes_of, testing::ScratchDir, testing::write_bytes;

// Everything that a reader says of a file, held against OpenImageIO.
void expect_twins(const std::string& path, const std::string& what) {
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::create(path.ends_with("png") ? "png" : "openexr");
  ASSERT_TRUE(in->open(path, spec, config)) << what;
  ImageReader reader(path);
  ASSERT_EQ(reader.width(), spec.width) << what;
  ASSERT_EQ(reader.height(), spec.height) << what;
  EXPECT_EQ(reader.channel_names(), spec.channelnames) << what;
  EXPECT_EQ(reader.integer(), !spec.format.is_floating_point()) << what;
  EXPECT_EQ(reader.file_bytes(), spec.image_bytes(true)) << what;
  const bool exact = spec.channelformats.empty() && spec.format != OIIO::TypeDesc::UINT32;
  EXPECT_EQ(reader.has_exact_samples(), exact) << what;
  for (int l = 0; l < reader.levels(); l++) {
    const Image level = reader.read_level(l);
    const OIIO::ImageSpec size = in->spec_dimensions(0, l);
    ASSERT_EQ(std::pair(level.width, level.height), std::pair(size.width, size.height)) << what;
    std::vector<float> texels(level.data.size());
    ASSERT_TRUE(in->read_image(0, l, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texels.data())) << what;
    EXPECT_EQ(level.data, texels) << what << " level " << l;
  }
  EXPECT_FALSE(in->seek_subimage(0, reader.levels())) << what;
  if (!exact) return;
  std::vector<std::uint8_t> ours(reader.file_bytes()), theirs(reader.file_bytes());
  for (int y = 0; y < reader.height(); y += 7) {
    const int count = std::min(7, reader.height() - y);
    reader.read_rows_stored(y, count, ours.data() + ours.size() / reader.height() * y);
  }
  ASSERT_TRUE(in->read_image(0, 0, 0, spec.nchannels, spec.format, theirs.data()));
  EXPECT_EQ(ours, theirs) << what;
}

void write_png(const std::string& path, int colour_type, int bits, bool interlaced, bool transparent) {
  constexpr int kWidth = 37, kHeight = 29;
  std::mt19937 random(unsigned(colour_type * 100 + bits));
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, kWidth, kHeight, bits, colour_type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const int entries = std::min(1 << bits, 200);
  std::vector<png_color> palette(entries);
  std::vector<png_byte> alphas(entries / 2 + 1);
  for (png_color& c : palette) c = {png_byte(random()), png_byte(random()), png_byte(random())};
  for (png_byte& a : alphas) a = png_byte(random());
  if (colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), entries);
  png_color_16 one{0, 1, 1, 1, 1};
  if (transparent) png_set_tRNS(png, info, alphas.data(), int(alphas.size()), &one);
  png_set_gAMA(png, info, 1 / 2.2);
  png_write_info(png, info);
  const bool whole_bytes = colour_type == PNG_COLOR_TYPE_PALETTE && bits == 8;
  std::vector<std::vector<png_byte>> rows(kHeight, std::vector<png_byte>(png_get_rowbytes(png, info)));
  std::vector<png_bytep> pointers;
  for (auto& row : rows) {
    for (png_byte& b : row) b = png_byte(whole_bytes ? random() % entries : random());
    pointers.push_back(row.data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(ImageTwins, PngOfEveryKind) {
  const ScratchDir dir;
  const std::pair<int, std::vector<int>> kinds[] = {{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                    {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                    {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                    {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                    {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const auto& [type, depths] : kinds)
    for (const int bits : depths)
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true}) {
          if (transparent && (type & PNG_COLOR_MASK_ALPHA)) continue;
          write_png(dir / "x.png", type, bits, interlaced, transparent);
          expect_twins(dir / "x.png", "type " + std::to_string(type) + ", " + std::to_string(bits) + " bits" +
                                          (interlaced ? ", interlaced" : "") + (transparent ? ", tRNS" : ""));
        }
}

TEST(ImageTwins, ADamagedPngFailsHoweverOftenItIsRead) {
  const ScratchDir dir;
  for (const bool interlaced : {false, true}) {
    write_png(dir / "x.png", PNG_COLOR_TYPE_RGB, 8, interlaced, false);
    const std::string whole = bytes_of(dir / "x.png");
    for (const std::size_t size : {whole.size() / 2, whole.size() - 12}) {  // the latter is without its end only
      write_bytes(dir / "x.png", whole.substr(0, size));
      ImageReader reader(dir / "x.png");
      std::vector<float> rows(std::size_t(reader.width()) * 3 * reader.height());
      for (int again = 0; again < 3; again++)
        EXPECT_ERROR(reader.read_rows(0, reader.height(), rows.data()), ErrorKind::kMalformed, "hit end of file");
    }
  }
}

// Where a picture lies on a page changes none of its texels.
TEST(ImageTwins, APngThatLiesSomewhereOnAPageIsRead) {
  const ScratchDir dir;
  write_png(dir / "x.png", PNG_COLOR_TYPE_RGB, 8, false, false);
  const Image image = read_image(dir / "x.png");
  std::string bytes = bytes_of(dir / "x.png");
  const std::size_t after_header = 8 + 12 + 13;
  bytes.insert(after_header, std::string("\0\0\0\x09oFFs\0\0\0\x05\0\0\0\x07\0\xc5\xa6\xb1\xba", 21));
  write_bytes(dir / "x.png", bytes);
  EXPECT_EQ(read_image(dir / "x.png").data, image.data);
}

using Channels = std::vector<std::pair<std::string, Imf::PixelType>>;

// A level's texels, channel by channel.
struct Texels {
  std::vector<std::vector<std::uint32_t>> samples;
  Imf::FrameBuffer buffer;

  Texels(const Channels& channels, const Imath::Box2i& window, std::mt19937& random) {
    const std::ptrdiff_t width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    for (const auto& [name, type] : channels) {
      const std::ptrdiff_t bytes = type == Imf::HALF ? 2 : 4;
      std::vector<std::uint32_t>& to = samples.emplace_back(width * height);
      for (std::uint32_t& v : to) {
        const auto whole = std::uint32_t(random());
        v = type == Imf::UINT ? whole : type == Imf::FLOAT ? whole % 0x10000000 + 0x38000000 : whole & 0x3fff3fff;
      }
      buffer.insert(name,
                    Imf::Slice(type, reinterpret_cast<char*>(to.data()) - (window.min.x + window.min.y * width) * bytes,
                               bytes, bytes * width));
    }
  }
};

struct ExrKind {
  std::string what;
  Channels channels;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  int tile = 0;
  Imf::LevelMode levels = Imf::ONE_LEVEL;
  Imf::LevelRoundingMode rounding = Imf::ROUND_DOWN;
  Imath::V2i first = {0, 0};
};

void write_exr(const std::string& path, const ExrKind& kind) {
  std::mt19937 random(7);
  const Imath::Box2i window(kind.first, kind.first + Imath::V2i(52, 80));
  Imf::Header header(window, window);
  header.compression() = kind.compression;
  for (const auto& [name, type] : kind.channels) header.channels().insert(name, Imf::Channel(type));
  if (kind.tile == 0) {
    Imf::OutputFile out(path.c_str(), header);
    const Texels texels(kind.channels, window, random);
    out.setFrameBuffer(texels.buffer);
    out.writePixels(81);
    return;
  }
  header.setTileDescription(Imf::TileDescription(kind.tile, kind.tile + 3, kind.levels, kind.rounding));
  Imf::TiledOutputFile out(path.c_str(), header);
  for (int l = 0; l < out.numLevels(); l++) {
    const Texels texels(kind.channels, out.dataWindowForLevel(l), random);
    out.setFrameBuffer(texels.buffer);
    out.writeTiles(0, out.numXTiles(l) - 1, 0, out.numYTiles(l) - 1, l);
  }
}

TEST(ImageTwins, ExrOfEveryKind) {
  const ScratchDir dir;
  const Channels rgba{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"A", Imf::HALF}},
      mixed{{"R", Imf::HALF}, {"depth", Imf::FLOAT}, {"id", Imf::UINT}}, integers{{"index", Imf::UINT}},
      coefficients{{"a0", Imf::FLOAT}, {"a1", Imf::FLOAT}, {"R", Imf::FLOAT}};
  std::vector<ExrKind> kinds;
  for (int c = Imf::NO_COMPRESSION; c < Imf::NUM_COMPRESSION_METHODS; c++)
    for (const int tile : {0, 16})
      kinds.push_back(
          {"compression " + std::to_string(c) + ", tile " + std::to_string(tile), rgba, Imf::Compression(c), tile});
  for (const Channels& channels : {mixed, integers, coefficients})
    for (const int tile : {0, 16}) {
      ExrKind kind{channels[0].first + " and so on, tile " + std::to_string(tile), channels};
      kind.tile = tile;
      kinds.push_back(kind);
    }
  for (const auto rounding : {Imf::ROUND_DOWN, Imf::ROUND_UP})
    for (const Channels& channels : {rgba, mixed})
      for (const Imath::V2i& first : {Imath::V2i(0, 0), {5, -7}})
        kinds.push_back({"levels of " + channels[1].first, channels, Imf::ZIP_COMPRESSION, 16, Imf::MIPMAP_LEVELS,
                         rounding, first});
  kinds.push_back({"from elsewhere", rgba, Imf::PIZ_COMPRESSION, 0, Imf::ONE_LEVEL, Imf::ROUND_DOWN, {-3, 9}});
  for (const ExrKind& kind : kinds) {
    write_exr(dir / "x.exr", kind);
    expect_twins(dir / "x.exr", kind.what);
  }
}

TEST(ImageTwins, ChannelsOfAnyNamesComeInOneOrder) {
  const ScratchDir dir;
  const std::vector<std::string> parts{"R",     "r",     "Red",   "G",    "green", "B",  "blue", "X",  "Y",
                                       "z",     "A",     "Alpha", "AR",   "RA",    "ag", "GA",   "AB", "BA",
                                       "Depth", "ZBack", "real",  "imag", "u",     "v",  "a0",   "10", "_"};
  std::mt19937 random(3);
  for (int round = 0; round < 30; round++) {
    ExrKind kind{"names " + std::to_string(round), {}};
    for (const char* layer : {"", "L.", "a.", "a.b.", "R."})
      for (const std::string& part : parts)
        if (random() % 4 == 0) kind.channels.emplace_back(layer + part, Imf::HALF);
    if (kind.channels.empty()) continue;
    write_exr(dir / "x.exr", kind);
    expect_twins(dir / "x.exr", kind.what);
  }
}

}  // namespace
}  // namespace burnish
