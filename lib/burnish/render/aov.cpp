#include "burnish/render/aov.h"

#include <algorithm>
#include <utility>

#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr std::pair<Aov, const char*> kNames[]{
    {Aov::kNormal, "normal"}, {Aov::kPosition, "position"}, {Aov::kUv, "uv"},      {Aov::kDepth, "depth"},
    {Aov::kIndex, "index"},   {Aov::kMaterial, "material"}, {Aov::kLevel, "level"}};

void store(Vec3d v, float* out) { out[0] = float(v.x), out[1] = float(v.y), out[2] = float(v.z); }

}  // namespace

const char* name(Aov aov) { return std::ranges::find(kNames, aov, &std::pair<Aov, const char*>::first)->second; }

std::vector<Aov> parse_aovs(const std::string& list) {
  std::vector<Aov> out;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    const auto found = std::ranges::find_if(kNames, [&](const auto& entry) { return word == entry.second; });
    if (found == std::end(kNames))
      throw Error(
          ErrorKind::kUsage,
          "--aov: expected names out of normal, position, uv, depth, index, material, level, got '" + word + "'");
    if (std::ranges::find(out, found->first) != out.end())
      throw Error(ErrorKind::kUsage, "--aov: '" + word + "' is named twice");
    out.push_back(found->first);
    begin = end + 1;
  }
  return out;
}

int channel_count(Aov aov) { return aov == Aov::kNormal || aov == Aov::kPosition || aov == Aov::kUv ? 3 : 1; }

void write_aov(Aov aov, const FrameSetup& setup, const ShadingPath& path, std::size_t object, const SurfacePoint* point,
               float* out) {
  if (!point) return void(std::fill_n(out, channel_count(aov), channel_count(aov) == 3 ? 0.f : -1.f));
  const Transform& transform = setup.scene.objects[object].transform;
  switch (aov) {
    case Aov::kNormal:
      return store(transform.normal_to_world(path.look_up(object, *point).normal), out);
    case Aov::kPosition:
      return store(transform.point_to_world(point->position), out);
    case Aov::kUv:
      return store({point->u, point->v, 0}, out);
    case Aov::kDepth:
      return void(*out = float(setup.camera.depth(transform.point_to_world(point->position))));
    case Aov::kIndex:
      return void(*out = float(path.look_up(object, *point).index));
    case Aov::kMaterial:
      return void(*out = float(path.look_up(object, *point).material));
    case Aov::kLevel:
      return void(*out = float(path.look_up(object, *point).level));
  }
}

}  // namespace burnish
