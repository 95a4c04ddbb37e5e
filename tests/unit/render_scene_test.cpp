#include <gtest/gtest.h>

#include "burnish/render/scene.h"
#include "expect_error.h"
#include "render_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

Scene parse(const std::string& text) { return parse_scene(text, "s.toml", "maps"); }

const std::string kObject = "[[object]]\nnormal_map = 'n.png'\n";

TEST(RenderScene, DefaultsAreAWhiteQuadSeenStraightOn) {
  const Scene s = parse(kObject);
  EXPECT_EQ(s.path, RenderPath::kAnalytic);
  EXPECT_EQ(s.samples, 1);
  EXPECT_EQ(s.image.width, 512);
  EXPECT_EQ(s.camera.type, CameraType::kOrthographic);
  ASSERT_EQ(s.objects.size(), 1u);
  EXPECT_EQ(s.objects[0].surface.type, SurfaceType::kQuad);
  EXPECT_EQ(s.objects[0].normal_map, "maps/n.png");
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_FALSE(s.materials[0].id);
  EXPECT_EQ(s.files(), std::vector<std::string>{"maps/n.png"});
}

TEST(RenderScene, EveryKeyArrives) {
  const Scene s = parse(R"(
path = "palette"
samples = 3
ambient = [0.1, 0, 0]
turn_axis = [0, 0, 2]
[image]
width = 20
height = 10
background = [1, 2, 3]
exposure = -1.5
[camera]
type = "perspective"
position = [0, 0, 4]
look_at = [0, 1, 0]
up = [0, 2, 0]
fov_deg = 30
[[light]]
direction = [0, 3, 4]
color = [1, 0.5, 0]
intensity = 2
[[light]]
type = "point"
position = [1, 2, 3]
falloff = "inverse-square"
[[object]]
surface = "sphere"
radius = 2
translate = [1, 0, 0]
rotate_deg = [0, 90, 0]
normal_map = "n.png"
normal_space = "object"
y = "down"
encoding = "signed"
channels = "xy"
indexed_map = "i.exr"
filter = "bilinear"
mip = "nearest"
[[object]]
size = [2, 1]
repeat = [3, 4]
indexed_map = "i.exr"
[[material]]
id = 4
model = "phong"
ambient = [0, 0, 1]
diffuse = [0, 1, 0]
specular = [1, 0, 0]
exponent = 9
[[material]]
id = 5
diffuse = [0.5, 0.5, 0.5]
[validate]
min_psnr_db = 40
max_abs = 0.1
max_rmse = 0.01
max_p95_abs = 0.02
samples = 8
heat_max = 0.25
)");
  EXPECT_EQ(s.path, RenderPath::kPalette);
  EXPECT_EQ(s.turn_axis, (Vec3d{0, 0, 1}));
  EXPECT_EQ(s.image.background, (Vec3d{1, 2, 3}));
  EXPECT_EQ(s.image.exposure_stops, -1.5);
  EXPECT_EQ(s.camera.fov_deg, 30);
  EXPECT_NEAR(s.lights[0].direction.z, 0.8, 1e-15);
  EXPECT_EQ(s.lights[1].falloff, Falloff::kInverseSquare);
  const Object& o = s.objects[0];
  EXPECT_EQ(o.surface.radius, 2);
  EXPECT_NEAR(o.transform.normal_to_world({0, 0, 1}).x, 1, 1e-15);
  EXPECT_EQ(o.normal_space, NormalSpace::kObject);
  EXPECT_EQ(o.coding.green, GreenAxis::kDown);
  EXPECT_EQ(o.coding.encoding, NormalEncoding::kSigned);
  EXPECT_EQ(o.coding.channels, "xy");
  EXPECT_EQ(o.filter, Filter::kBilinear);
  EXPECT_EQ(o.mip, MipMode::kNearest);
  EXPECT_EQ(s.objects[1].surface.repeat_v, 4);
  EXPECT_EQ(std::get<Phong>(s.materials[0].terms[0]).exponent, 9);
  EXPECT_EQ(std::get<Lambert>(s.materials[1].terms[0]).ambient, (Vec3d{0.5, 0.5, 0.5})) << "as the diffuse colour";
  EXPECT_EQ(s.validation.samples, 8);
  EXPECT_EQ(s.validation.tolerances.max_p95_abs, 0.02);
  EXPECT_EQ(s.files(), (std::vector<std::string>{"maps/n.png", "maps/i.exr"})) << "each once";
}

TEST(RenderScene, RefusalsNameFileLineAndKey) {
  using enum ErrorKind;
  const auto refused = [](const std::string& text, const std::string& message) {
    EXPECT_ERROR(parse(text), kMalformed, message);
  };
  refused(kObject + "colour = 1\n", "'s.toml': line 3: 'object[0].colour': unknown key; expected one of");
  refused("smaples = 1\n" + kObject, "'s.toml': line 1: 'smaples': unknown key");
  refused("samples = 'four'\n" + kObject, "line 1: 'samples': expected an integer from 1 to 64, got 'four'");
  refused("samples = 0\n" + kObject, "'samples': expected an integer from 1 to 64, got 0");
  refused("samples = 2.5\n" + kObject, "'samples': expected an integer from 1 to 64, got 2.5");
  refused("samples = 2.0\n" + kObject, "'samples': expected an integer from 1 to 64, got 2.0");
  refused("ambient = [0, 1]\n" + kObject,
          "'ambient': expected an array of 3, each a number of at least 0, got an array of 2");
  refused("ambient = [0, 1, -1]\n" + kObject, "'ambient': expected an array of 3, each a number of at least 0, got -1");
  refused("ambient = [0, 1, nan]\n" + kObject, "'ambient'");
  refused("path = 'palete'\n" + kObject,
          "line 1: 'path': expected a path, one of analytic, palette, palette-expanded, banks,");
  refused("image = 3\n" + kObject, "'image': expected a table [image], got 3");
  refused("[image]\nwidth = 100000\n" + kObject, "line 2: 'image.width': expected an integer from 1 to");
  refused("[camera]\ntype = 'fisheye'\n" + kObject, "'camera.type': expected orthographic|perspective, got 'fisheye'");
  refused("[camera]\ntype = 'perspective'\nfov_deg = 200\n" + kObject,
          "line 3: 'camera.fov_deg': expected an angle above 0 and below 180, got 200");
  refused("[camera]\nfov_deg = 20\n" + kObject, "'camera.fov_deg': unknown key");
  refused("[camera]\nup = [0, 0, 1]\n" + kObject, "'camera.up': expected a direction other than the view's own");
  refused("[camera]\nposition = [0, 0, 0]\n" + kObject, "'camera.look_at': expected a point other than");
  refused(kObject + "[[light]]\n", "'light[0].direction': expected an array of 3");
  refused(kObject + "[[light]]\ndirection = [0, 0, 0]\n", "line 4: 'light[0].direction': expected a direction");
  refused(kObject + "[[light]]\ntype = 'point'\nposition = [0,0,1]\ndirection = [0, 0, 1]\n",
          "'light[0].direction': unknown key");
  refused(kObject + "[light]\ndirection = [0, 0, 1]\n", "'light': expected tables [[light]], got a table");
  refused("", "'object': expected at least one [[object]]");
  refused("[[object]]\nsurface = 'mesh'\n", "line 1: 'object[0].mesh': expected the mesh's file name");
  refused(kObject + "scale = [1, 0, 1]\n", "'object[0].scale': expected an array of 3, each a number above 0, got 0");
  refused("[camera]\ntype = 'perspective'\nfov_deg = 180.1\n" + kObject, "above 0 and below 180, got 180.1");
  refused(kObject + "base_color = [1, 1, 1]\nblend = 'material'\n", "'object[0].blend': expected exact or approximate");
  refused(kObject + "[[material]]\n[[material.term]]\nmodel = 'phnog'\n",
          "'material[0].term[0].model': expected lambert|");
  refused(kObject + "[[material]]\nmodel = 'phong'\n[[material.term]]\nmodel = 'chrome'\n",
          "'material[0].model': unknown key");
  refused(kObject + "[[material]]\nmodel = 'environment'\n", "'material[0].map': expected the panorama's file name");
  refused(kObject + "[[material]]\nmodel = 'cartoon'\nbands = 1\n", "'material[0].bands': expected an integer from 2");
  refused("[[object]]\nnormal_map = 'n.png'\nsurface = 'sphere'\nsize = [1, 1]\n", "'object[0].size': unknown key");
  refused("[[object]]\nnormal_map = 'n.png'\nmip = 'off'\n", "'object[0].mip': unknown key");
  refused("[[object]]\nnormal_map = 'n.png'\nchannels = 'xq'\n", "'object[0].channels': expected two or three letters");
  refused(kObject + "[[material]]\nexponent = 3\n", "'material[0].exponent': unknown key");
  refused(kObject + "[[material]]\nid = 1\n[[material]]\n", "'material[1].id': expected an id from 0 to 255");
  refused(kObject + "[[material]]\nid = 1\n[[material]]\nid = 1\n",
          "'material[1].id': expected ids that differ, got 1 twice");
  refused(kObject + "[validate]\nmax_abs = -1\n", "'validate.max_abs': expected a number of at least 0, got -1");
  refused("a = \n", "'s.toml': line 1: ");
  const std::string quad = "[[object]]\n";
  refused(quad + "[object.ptm]\n", "'object[0].ptm.map': expected the file of the map");
  refused(quad + "[object.ptm]\nmap = 'a.exr'\nbrdf = 'ward:'\n", "'object[0].ptm.map': expected the PREFIX/");
  refused(quad + "[object.ptm]\nmap = 'a/'\nbrdf = 'ward:'\ntransfer = 'srgb'\n", "transfer': unknown key");
  refused(quad + "[object.ptm]\nmap = 'a/'\ntransfer = 'gamma'\n", "transfer': expected");
  refused(kObject + "[object.ptm]\nmap = 'a.ptm'\n", "'object[0].normal_map': expected none beside [object.ptm]");
  refused(quad + "filter = 'nearest'\n[object.ptm]\nmap = 'a/'\nbrdf = 'ward:'\n", "filter': unknown key");
  refused(quad + "[object.ptm]\nmap = 'a.ptm'\n[[material]]\n", "expected no [[material]]");
  refused("[[object]]\nsurface = 'torus'\nradius = 0.2\ntube_radius = 0.2\n",
          "expected less than the ring's 'radius', 0.2");
  refused("[[object]]\nsurface = 'torus'\nsize = [1, 1]\n", "size': unknown key");
}

TEST(RenderScene, FilesThatCannotBeRead) {
  const testing::ScratchDir dir;
  EXPECT_ERROR(read_scene(dir / "none.toml"), ErrorKind::kIo, "cannot be read");
  EXPECT_ERROR(read_scene(dir.path()), ErrorKind::kIo, "expected a file, got a directory");
  testing::write_bytes(dir / "s.toml", kObject);
  EXPECT_EQ(read_scene(dir / "s.toml").files()[0], dir / "n.png") << "relative to the scene";
}

TEST(RenderAssets, EveryIntervalNeedsItsMaterial) {
  const testing::ScratchDir dir;
  Scene s = testing::quad_scene();
  s.objects[0].normal_map.clear();
  s.objects[0].indexed_map = dir / "i.exr";
  s.materials[0].id = 0;
  s.materials.push_back({1, {Lambert{}}});
  ObjectAssets made = testing::indexed_assets(s, 4, 8, true, 2);
  write_indexed_map(dir / "i.exr", FileType::kExr, *made.indexed);
  const std::vector<ObjectAssets> read = load_assets(s);
  EXPECT_EQ(read[0].normals, made.normals) << "without a normal map the palette's normals are the truth";
  EXPECT_EQ(read[0].interval_materials[1], &s.materials[1]);
  s.materials.pop_back();
  EXPECT_ERROR(load_assets(s), ErrorKind::kMalformed, "expected a [[material]] with id = 1");
  s.materials[0].id.reset();
  EXPECT_EQ(load_assets(s)[0].only_material, &s.materials[0]);
}

TEST(RenderAssets, MaterialIdsNeedAnIndexedMap) {
  const testing::ScratchDir dir;
  Scene s = testing::quad_scene();
  Image map(1, 1, 3);
  map.data = {0, 0, 1};
  write_image(dir / "n.exr", FileType::kExr, SampleType::kFloat, map);
  s.objects[0].normal_map = dir / "n.exr";
  EXPECT_EQ(load_assets(s)[0].normals[0], (Vec3f{0, 0, 1}));
  s.materials[0].id = 3;
  EXPECT_ERROR(load_assets(s), ErrorKind::kMalformed, "materials have ids");
}

}  // namespace
}  // namespace burnish
