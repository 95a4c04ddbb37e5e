#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <map>
#include <set>

#include "burnish/palette/files/cube_image.h"
#include "expect_error.h"
#include "palette_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;

constexpr int kW = 61, kH = 97;  // more than one band of rows

// A colour palette as other programs write it: PLTE and tRNS, the latter only as long as it must be.
void write_foreign_png(const std::string& file, int depth, const std::vector<Colour>& palette, int width, int height,
                       const std::vector<int>& index) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  ASSERT_NE(stream, nullptr);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream);
  png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), depth, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> colours;
  std::vector<png_byte> alphas;
  for (const Colour& c : palette) {
    colours.push_back({png_byte(c[0]), png_byte(c[1]), png_byte(c[2])});
    alphas.push_back(png_byte(c[3]));
  }
  while (!alphas.empty() && alphas.back() == 255) alphas.pop_back();
  png_set_PLTE(png, info, colours.data(), int(colours.size()));
  if (!alphas.empty()) png_set_tRNS(png, info, alphas.data(), int(alphas.size()), nullptr);
  png_write_info(png, info);
  png_set_packing(png);
  std::vector<png_byte> row(width);
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) row[x] = png_byte(index[y * width + x]);
    png_write_row(png, row.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(stream);
}

Colour texel(const Image& image, int x, int y) {
  Colour c{0, 0, 0, 255};
  for (int i = 0; i < image.channels; i++) c[i] = std::round(image.at(x, y)[i] * 255);
  return c;
}

TEST(PaletteCubeImage, HoldsEveryTexelsColour) {
  const ScratchDir dir;
  const std::vector<Vec3f> normals = testing::bumpy_normals(kW, kH);
  testing::write_normals(dir / "n.exr", SampleType::kFloat, kW, kH, normals);
  std::vector<int> ids;
  for (int i = 0; i < kW * kH; i++) ids.push_back(i % 7 < 3 ? 4 : i % 7 < 5 ? 90 : 200);
  testing::write_ids(dir / "ids.png", kW, kH, ids);
  const std::vector<int> materials{4, 90, 200};
  for (const MaterialEncoding encoding : {MaterialEncoding::kAlpha, MaterialEncoding::kSubcubes}) {
    const MaterialCube cube(encoding, 3);
    write_cube_image(dir / "rgb.png", {dir / "n.exr", dir / "ids.png"}, {}, cube, materials);
    const Image image = read_image(dir / "rgb.png");
    EXPECT_EQ(image.channels, cube.channels());
    std::set<Colour> colours;
    for (int y = 0; y < kH; y++)
      for (int x = 0; x < kW; x++) {
        const int id = ids[y * kW + x], k = id == 4 ? 0 : id == 90 ? 1 : 2;
        ASSERT_EQ(texel(image, x, y), cube.encode(k, normals[y * kW + x])) << x << " " << y;
        colours.insert(texel(image, x, y));
      }
    EXPECT_EQ(read_cube_colours(dir / "rgb.png", cube), std::vector<Colour>(colours.begin(), colours.end()));
  }
}

TEST(PaletteCubeImage, MaskedTexelsTakeTheOthersColoursInTheirShares) {
  const ScratchDir dir;
  const Vec3f a{0.6f, 0, 0.8f}, b{0, -0.6f, 0.8f};
  std::vector<Vec3f> normals;
  std::vector<int> mask;
  for (int i = 0; i < kW * kH; i++) {
    const bool used = i % 5 == 2 || i % 5 == 4;
    mask.push_back(used ? 255 : 0);
    normals.push_back(!used ? Vec3f{-1, 0, 0} : i % 3 == 0 ? a : b);  // a third is a
  }
  testing::write_normals(dir / "n.png", SampleType::kUint8, kW, kH, normals);
  testing::write_ids(dir / "mask.png", kW, kH, mask);
  const MaterialCube cube(MaterialEncoding::kSubcubes, 1);
  {
    write_cube_image(dir / "rgb.png", {dir / "n.png", {}, dir / "mask.png"}, {}, cube, {0});
    const Image image = read_image(dir / "rgb.png");
    std::map<Colour, double> share;
    for (int y = 0; y < kH; y++)
      for (int x = 0; x < kW; x++) share[texel(image, x, y)] += 1.0 / (kW * kH);
    ASSERT_EQ(share.size(), 2u);
    EXPECT_NEAR(share[cube.encode(0, a)], 1 / 3.0, 0.01);
    for (int i = 0; i < kW * kH; i++)
      if (mask[i]) {
        ASSERT_EQ(texel(image, i % kW, i / kW), cube.encode(0, normals[i]));
      }
  }
  testing::write_ids(dir / "mask.png", kW, kH, std::vector<int>(kW * kH));  // nothing to take colours from
  write_cube_image(dir / "rgb.png", {dir / "n.png", {}, dir / "mask.png"}, {}, cube, {0});
  EXPECT_EQ(texel(read_image(dir / "rgb.png"), 0, 0), cube.encode(0, {-1, 0, 0}));
}

TEST(PaletteCubeImage, ReadsForeignPalettesWithTheirAlphas) {
  const ScratchDir dir;
  const MaterialCube cube(MaterialEncoding::kAlpha, 3);
  for (const int depth : {1, 2, 4, 8}) {
    std::vector<Colour> palette;
    for (int i = 0; i < 1 << depth; i++) {
      // Whatever the alpha, the colour is kept: nothing is multiplied.
      palette.push_back({float(i), float(255 - i), float(i * 7 % 256), float(i % 4 == 3 ? 255 : i % 256)});
    }
    std::vector<int> index;
    for (int i = 0; i < 32 * 32; i++) index.push_back(i % (1 << depth));
    write_foreign_png(dir / "q.png", depth, palette, 32, 32, index);
    std::ranges::sort(palette);
    EXPECT_EQ(read_cube_colours(dir / "q.png", cube), palette) << depth << " bits";
    write_foreign_png(dir / "q.png", depth, palette, 32, 32, std::vector<int>(32 * 32, 1));
    EXPECT_EQ(read_cube_colours(dir / "q.png", cube), std::vector<Colour>{palette[1]}) << "an entry no texel has";
  }
  write_foreign_png(dir / "opaque.png", 1, {{1, 2, 3, 255}, {4, 5, 6, 255}}, 2, 1, {0, 1});
  EXPECT_EQ(read_cube_colours(dir / "opaque.png", MaterialCube(MaterialEncoding::kSubcubes, 2)).size(), 2u);
  EXPECT_ERROR(read_cube_colours(dir / "opaque.png", cube), ErrorKind::kMalformed, "expected 4 channels");
}

TEST(PaletteCubeImage, RefusesWhatIsNoQuantizedImage) {
  const ScratchDir dir;
  const MaterialCube cube(MaterialEncoding::kSubcubes, 2);
  Image image(300, 300, 3);
  for (std::size_t i = 0; i < image.texels(); i++) {
    image.data[3 * i] = float(i % 256) / 255.f, image.data[3 * i + 1] = float(i / 256 % 256) / 255.f;
    image.data[3 * i + 2] = float(i / 65536) / 255.f;
  }
  write_image(dir / "more.png", FileType::kPng, SampleType::kUint8, image);
  EXPECT_ERROR(read_cube_colours(dir / "more.png", cube), ErrorKind::kMalformed, "at most 65536 colours");
  write_image(dir / "deep.png", FileType::kPng, SampleType::kUint16, image);
  EXPECT_ERROR(read_cube_colours(dir / "deep.png", cube), ErrorKind::kMalformed, "uint8, got uint16");
  write_image(dir / "grey.png", FileType::kPng, SampleType::kUint8, Image(4, 4, 1));
  EXPECT_ERROR(read_cube_colours(dir / "grey.png", cube), ErrorKind::kMalformed, "expected 3 channels");
  EXPECT_ERROR(read_cube_colours(dir / "none.png", cube), ErrorKind::kIo, "none.png");
}

}  // namespace
}  // namespace burnish
