// PNG and EXR are read and written without OpenImageIO: here it is the other one, which makes the files and reads them.
#include "burnish/core/image_io.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "burnish/core/image_chain.h"
#include "expect_error.h"
#include "image_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::expect_same, testing::random_image, testing::ScratchDir;

// Tiled or scanline, with any compression, an image is the same whichever bands it is read in.
TEST(ImageIo, BandsOfAnyHeightEqualTheWhole) {
  const ScratchDir dir;
  const int w = 53, h = 141, channels = 3;
  for (const char* file : {"t.exr", "t.tif", "t.png", "t.tga"})
    for (int tile : {0, 16, 64}) {
      const bool can_tile = file[2] == 'e' || std::string(file) == "t.tif";
      if (tile && !can_tile) continue;
      const SampleType sample = file[2] == 'e' ? SampleType::kFloat : SampleType::kUint8;
      const Image image = random_image(w, h, channels, sample);
      auto out = OIIO::ImageOutput::create(dir / file);
      ASSERT_TRUE(out);
      OIIO::ImageSpec spec(w, h, channels,
                           sample == SampleType::kFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
      if (tile) spec.tile_width = spec.tile_height = tile, spec.tile_depth = 1;
      ASSERT_TRUE(out->open(dir / file, spec)) << out->geterror();
      ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, image.data.data())) << out->geterror();
      ASSERT_TRUE(out->close());
      out.reset();

      const std::string what = std::string(file) + " tile " + std::to_string(tile);
      expect_same(read_image(dir / file).data, image.data, what);
      for (int band : {1, 7, 16, 50, 64}) {
        ImageReader reader(dir / file);
        Image parts(w, h, channels);
        for (int y = 0; y < h; y += band) reader.read_rows(y, std::min(band, h - y), parts.row(y));
        expect_same(parts.data, image.data, what + " band " + std::to_string(band));
      }
      ImageReader reader(dir / file);  // any order
      Image parts(w, h, channels);
      for (int y = h - 1; y >= 0; y--) reader.read_rows(y, 1, parts.row(y));
      expect_same(parts.data, image.data, what + " from the bottom");
    }
}

// An EXR whose windows do not start at the origin is an image like any other; one that holds a part of its picture is
// not.
TEST(ImageIo, AnOffsetDataWindowIsReadFromItsFirstRow) {
  const ScratchDir dir;
  for (int tile : {0, 16}) {
    const Image image = random_image(20, 40, 1, SampleType::kFloat);
    auto out = OIIO::ImageOutput::create(dir / "w.exr");
    OIIO::ImageSpec spec(20, 40, 1, OIIO::TypeDesc::FLOAT);
    spec.x = spec.full_x = 5, spec.y = spec.full_y = -3;
    if (tile) spec.tile_width = spec.tile_height = tile, spec.tile_depth = 1;
    ASSERT_TRUE(out->open(dir / "w.exr", spec));
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, image.data.data()));
    ASSERT_TRUE(out->close());
    out.reset();
    EXPECT_EQ(read_image(dir / "w.exr").data, image.data) << "tile " << tile;
    spec.full_x = 0;
    out = OIIO::ImageOutput::create(dir / "w.exr");
    ASSERT_TRUE(out->open(dir / "w.exr", spec));
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, image.data.data()));
    ASSERT_TRUE(out->close());
    out.reset();
    EXPECT_ERROR(read_image(dir / "w.exr"), ErrorKind::kUnsupported, "data window");
  }
}

TEST(ImageChain, SizesRoundedUpAreRefused) {
  const ScratchDir dir;
  std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create("openexr");
  int w = 5;
  for (auto mode : {OIIO::ImageOutput::Create, OIIO::ImageOutput::AppendMIPLevel, OIIO::ImageOutput::AppendMIPLevel,
                    OIIO::ImageOutput::AppendMIPLevel}) {
    OIIO::ImageSpec spec(w, w, 1, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 64;
    spec.attribute("textureformat", "Plain Texture");
    spec.attribute("openexr:roundingmode", 1);
    ASSERT_TRUE(out->open(dir / "up.exr", spec, mode)) << out->geterror();
    const std::vector<float> texels(std::size_t(w) * w);
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, texels.data()));
    w = (w + 1) / 2;
  }
  out->close();
  out.reset();  // the file is complete only now
  ImageReader reader(dir / "up.exr");
  EXPECT_ERROR(read_image_chain(reader), ErrorKind::kMalformed, "expected 2x2 texels in level 1, got 3x3");
}

TEST(ImageIo, OthersReadWhatIsWritten) {
  const ScratchDir dir;
  const Attributes attributes{{"burnish:function", std::string("ward-s")},
                              {"burnish:scale", std::vector<double>{0.5, 2, 4}},
                              {"burnish:bias", std::vector<double>{1, 2, 3, 4}},
                              {"burnish:domain", std::vector<double>{-1, 1}},
                              {"burnish:peak", std::vector<double>{0.25}}};
  using enum SampleType;
  for (const auto& [file, sample] : std::vector<std::pair<std::string, SampleType>>{
           {"x.png", kUint8}, {"x.png", kUint16}, {"x.exr", kHalf}, {"x.exr", kFloat}, {"x.tif", kUint16}})
    for (int channels = 1; channels <= 4; channels++) {
      const Image image = random_image(37, 150, channels, sample);
      write_image(dir / file, file_type_of(file), sample, image, attributes);
      OIIO::ImageSpec config;
      config.attribute("oiio:UnassociatedAlpha", 1);
      const auto in = OIIO::ImageInput::open(dir / file, &config);
      ASSERT_TRUE(in);
      const std::string what = file + " " + name(sample) + " " + std::to_string(channels);
      EXPECT_EQ(in->spec().format.c_str(), std::string(sample == kUint16  ? "uint16"
                                                       : sample == kUint8 ? "uint8"
                                                                          : name(sample)));
      EXPECT_EQ(in->spec().get_string_attribute("DateTime"), "") << what;
      std::vector<float> texels(image.data.size());
      ASSERT_TRUE(in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, texels.data())) << what;
      expect_same(texels, image.data, what);
      if (file == "x.exr") {
        EXPECT_EQ(in->spec().get_string_attribute("burnish:function"), "ward-s");
        const auto* domain =
            in->spec().find_attribute("burnish:domain", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC2));
        ASSERT_TRUE(domain);
        EXPECT_EQ(static_cast<const float*>(domain->data())[1], 1);
        EXPECT_TRUE(in->spec().find_attribute(
            "burnish:scale", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC3, OIIO::TypeDesc::VECTOR)));
        EXPECT_TRUE(in->spec().find_attribute("burnish:bias", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 4)));
        EXPECT_EQ(in->spec().get_float_attribute("burnish:peak"), 0.25f);
      } else {
        EXPECT_EQ(in->spec().get_string_attribute("ImageDescription"),
                  R"({"burnish:function":"ward-s","burnish:scale":[0.5,2.0,4.0],"burnish:bias":[1.0,2.0,3.0,4.0],)"
                  R"("burnish:domain":[-1.0,1.0],"burnish:peak":0.25})");
      }
    }
}

}  // namespace
}  // namespace burnish
