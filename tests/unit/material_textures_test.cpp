// Files of material textures that do not belong together, or are none.
#include "burnish/material/material_textures.h"

#include <gtest/gtest.h>

#include <limits>

#include "expect_error.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::ScratchDir;
using enum MaterialModel;

struct Files {
  ScratchDir dir;
  FileRef t = dir / "m_t.exr", b = dir / "m_b.exr", n = dir / "m_n.exr";

  Files() { write(textures(kWard, 8, 4)); }
  static MaterialTextures textures(MaterialModel model, int w, int h, int levels = 1) {
    MaterialTextures m;
    m.model = model;
    for (int l = 0; l < levels; l++) {
      const int lw = std::max(1, w >> l), lh = std::max(1, h >> l);
      m.t.levels.emplace_back(lw, lh, model == kWard ? 3 : 4);
      m.b.levels.emplace_back(lw, lh, model == kBlinnPhong ? 4 : 3);
      m.n.levels.emplace_back(lw, lh, model == kWard ? 4 : 3);
    }
    m.n.scale = {2, 2, 2, 9};
    m.t.levels.back().data[0] = 0.5f;
    return m;
  }
  void write(const MaterialTextures& m) { write_material_textures(m, t, b, n, FileType::kExr, SampleType::kFloat); }
  MaterialTextures read() { return read_material_textures(t, b, n); }
};

TEST(MaterialTextureFiles, AllLevelsComeBack) {
  Files files;
  EXPECT_EQ(files.read().n.scale, (std::array<float, 4>{2, 2, 2, 9}));
  files.write(Files::textures(kBanks, 8, 4, 4));
  const MaterialTextures m = files.read();
  EXPECT_EQ(m.model, kBanks);
  ASSERT_EQ(m.b.levels.size(), 4u);
  EXPECT_EQ(m.t.levels[2].width, 2);
  EXPECT_EQ(m.t.levels[3].data[0], 0.5f);
  EXPECT_ERROR(
      write_material_textures(m, files.dir / "x", files.dir / "y", files.dir / "z", FileType::kPng, SampleType::kUint8),
      ErrorKind::kUnsupported, "several levels");
}

TEST(MaterialTextureFiles, ThatAreNoneOrNotOfOneMaterial) {
  Files files;
  const FileRef plain = files.dir / "plain.exr";
  write_image(plain, FileType::kExr, SampleType::kFloat, Image(8, 4, 3));
  EXPECT_ERROR(read_material_textures(plain, files.b, files.n), ErrorKind::kMalformed,
               "plain.exr': expected a material texture, whose burnish:model is banks, blinn-phong or ward, got 'noth");
  EXPECT_ERROR(read_material_textures(files.t, files.b, plain), ErrorKind::kMalformed, "plain.exr'");
  EXPECT_ERROR(read_material_textures(files.t, files.n, files.b), ErrorKind::kMalformed,
               "m_n.exr': expected 3 channels of ward's b, got 4");
  Files other;
  other.write(Files::textures(kBlinnPhong, 8, 4));
  EXPECT_ERROR(read_material_textures(files.t, other.b, files.n), ErrorKind::kMalformed,
               "expected the model ward as in");
  EXPECT_ERROR(read_material_textures(other.b, other.t, other.n), ErrorKind::kMalformed,
               "m_b.exr': expected burnish:alpha 'k_s' of blinn-phong's t, got 'N'");
  other.write(Files::textures(kWard, 4, 4));
  EXPECT_ERROR(read_material_textures(files.t, files.b, other.n), ErrorKind::kMalformed, "expected 8x4 texels as in");
  other.write(Files::textures(kWard, 8, 4, 4));
  EXPECT_ERROR(read_material_textures(files.t, files.b, other.n), ErrorKind::kMalformed, "expected 1 level as in");
  MaterialTextures broken = Files::textures(kWard, 8, 4);
  broken.n.levels[0].at(2, 1)[3] = std::numeric_limits<float>::quiet_NaN();
  files.write(broken);
  EXPECT_ERROR(files.read(), ErrorKind::kMalformed, "m_n.exr': expected finite values, got nan at column 2, row 1");
  write_image(files.n, FileType::kExr, SampleType::kFloat, Image(8, 4, 4),
              {{"burnish:model", "ward"},
               {"burnish:alpha", "k_s/(4 pi alpha_x alpha_y)"},
               {"burnish:scale", std::vector<double>{1, 1, 1}}});
  EXPECT_ERROR(files.read(), ErrorKind::kMalformed, "m_n.exr': expected burnish:scale of 4 numbers, got 3");
}

TEST(MaterialTextureFiles, AreFoundByTheirPrefix) {
  Files files;
  const std::string prefix = files.dir / "m";
  EXPECT_EQ(material_file(prefix, 't'), files.t.path);
  EXPECT_ERROR(material_file(files.dir / "no", 'b'), ErrorKind::kIo, "no_b.exr, .png or .tif': there is none");
  write_image(files.dir / "m_n.tif", FileType::kTiff, SampleType::kUint8, Image(1, 1, 3));
  EXPECT_ERROR(material_file(prefix, 'n'), ErrorKind::kUsage, "expected one of them, got '");
  EXPECT_ERROR(material_file(prefix, 'n'), ErrorKind::kUsage, "_n.tif': remove or rename one of them");
}

}  // namespace
}  // namespace burnish
