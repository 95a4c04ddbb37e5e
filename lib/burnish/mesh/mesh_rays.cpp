#include "burnish/mesh/mesh_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/core/error.h"

namespace burnish {
namespace {

template <typename Handle, void (*release)(Handle)>
class Owned {
 public:
  explicit Owned(Handle handle) : handle_(handle) {
    if (!handle_) throw Error(ErrorKind::kInternal, "Embree cannot be set up");
  }
  ~Owned() { release(handle_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  operator Handle() const { return handle_; }

 private:
  Handle handle_;
};

// The point of a triangle nearest to p (Ericson, "Real-time collision detection", 2005, section 5.1.5).
MeshPoint nearest_of_triangle(const Mesh& mesh, std::uint32_t triangle, Vec3d p) {
  const Vec3d a = mesh.position(triangle, 0), b = mesh.position(triangle, 1), c = mesh.position(triangle, 2);
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {triangle, {1, 0, 0}};
  if (d3 >= 0 && d4 <= d3) return {triangle, {0, 1, 0}};
  if (d6 >= 0 && d5 <= d6) return {triangle, {0, 0, 1}};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {triangle, {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0}};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {triangle, {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)}};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {triangle, {0, 1 - w, w}};
  }
  const double sum = va + vb + vc;
  return {triangle, {va / sum, vb / sum, vc / sum}};
}

// The largest where that is less.
float float_of(double x) { return float(std::min(x, double(std::numeric_limits<float>::max()))); }

}  // namespace

void require_traceable(const Mesh& mesh) {
  constexpr double kMost = 1e18;  // squares stay within float
  const Vec3d centre = bounds(mesh).centre();
  for (const Corners& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle) {
      const Vec3d p = mesh.positions[i] - centre;
      if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kMost))
        throw file_error(ErrorKind::kMalformed, mesh.name, "expected coordinates below 1e18, got larger ones");
    }
}

struct MeshRays::Impl {
  // One thread and one instruction set: the tree, and so which of two touching triangles is met, is the same
  // everywhere.
  Owned<RTCDevice, rtcReleaseDevice> device{rtcNewDevice("threads=1,isa=sse2")};
  Owned<RTCScene, rtcReleaseScene> scene{rtcNewScene(device)};
  Mesh mesh;  // positions and triangles only
  Vec3d centre;

  explicit Impl(const Mesh& source) : centre(bounds(source).centre()) {
    require_traceable(source);
    mesh.positions = source.positions, mesh.triangles = source.triangles;
    const Owned<RTCGeometry, rtcReleaseGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Corners), mesh.triangles.size()));
    if (!vertices || !indices) throw Error(ErrorKind::kInternal, "no memory for the mesh's triangles");
    std::fill_n(vertices, 3 * mesh.positions.size(), 0.f);
    for (const Corners& t : mesh.triangles) {
      for (const std::uint32_t i : t) {
        const Vec3d p = mesh.positions[i] - centre;
        vertices[3 * i] = float(p.x), vertices[3 * i + 1] = float(p.y), vertices[3 * i + 2] = float(p.z);
      }
      indices = std::ranges::copy(t, indices).out;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
      throw Error(ErrorKind::kInternal, "the mesh's acceleration structure cannot be built");
  }

  // Where the ray meets the triangle's plane, kept within the triangle.
  RayHit refine(std::uint32_t triangle, Vec3d origin, Vec3d direction) const {
    const Vec3d a = mesh.position(triangle, 0), ab = mesh.position(triangle, 1) - a,
                ac = mesh.position(triangle, 2) - a, n = cross(ab, ac);
    const double t = dot(a - origin, n) / dot(direction, n);
    const Vec3d ap = origin + direction * t - a;
    const double area2 = dot(n, n);
    double b = std::max(0.0, dot(cross(ap, ac), n) / area2), c = std::max(0.0, dot(cross(ab, ap), n) / area2);
    if (const double sum = b + c; sum > 1) b /= sum, c /= sum;
    return {{triangle, {1 - b - c, b, c}}, t};
  }
};

MeshRays::MeshRays(const Mesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
MeshRays::~MeshRays() = default;
MeshRays::MeshRays(MeshRays&&) noexcept = default;

std::optional<RayHit> MeshRays::first_hit(Vec3d origin, Vec3d direction, double least, double most,
                                          Facing facing) const {
  struct Context : RTCIntersectContext {
    const Mesh* mesh;
    Vec3d direction;
    Facing facing;
  } context;
  rtcInitIntersectContext(&context);
  context.mesh = &impl_->mesh, context.direction = direction, context.facing = facing;
  // Refuses triangles that face the wrong way, or lie edge on, where double precision finds no place.
  context.filter = [](const RTCFilterFunctionNArguments* args) {
    const auto* c = static_cast<const Context*>(args->context);
    const double along = dot(c->mesh->perpendicular(RTCHitN_primID(args->hit, args->N, 0)), c->direction);
    const bool met = c->facing == Facing::kFront ? along < 0 : c->facing == Facing::kBack ? along > 0 : along != 0;
    if (!met) args->valid[0] = 0;
  };
  const Vec3d o = origin - impl_->centre;
  RTCRayHit query{};
  query.ray.org_x = float(o.x), query.ray.org_y = float(o.y), query.ray.org_z = float(o.z);
  query.ray.dir_x = float(direction.x), query.ray.dir_y = float(direction.y), query.ray.dir_z = float(direction.z);
  query.ray.tnear = float(least), query.ray.tfar = float_of(most);
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return impl_->refine(query.hit.primID, origin, direction);
}

std::optional<MeshRays::Nearest> MeshRays::nearest(Vec3d from, double most, Vec3d direction) const {
  struct Search {
    const Mesh& mesh;
    Vec3d from, direction;
    double distance;
    std::optional<MeshPoint> best;
  } search{impl_->mesh, from, direction, most, {}};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const Vec3d p = from - impl_->centre;
  constexpr double kMargin = 1 + 1e-5;  // single precision must not shut out what is as near
  RTCPointQuery query{float(p.x), float(p.y), float(p.z), 0, float_of(most * kMargin)};
  rtcPointQuery(
      impl_->scene, &query, &context,
      [](RTCPointQueryFunctionArguments* args) {
        auto& s = *static_cast<Search*>(args->userPtr);
        const Vec3d outwards = s.mesh.perpendicular(args->primID);
        if (outwards == Vec3d{} || (s.direction != Vec3d{} && !(dot(outwards, s.direction) > 0))) return false;
        const MeshPoint point = nearest_of_triangle(s.mesh, args->primID, s.from);
        const double distance = length(position_at(s.mesh, point) - s.from);
        const bool nearer =
            distance < s.distance || (distance == s.distance && (!s.best || point.triangle < s.best->triangle));
        if (!nearer) return false;
        s.distance = distance, s.best = point;
        args->query->radius = std::min(args->query->radius, float(distance * kMargin) + 1e-30f);
        return true;
      },
      &search);
  if (!search.best) return {};
  return Nearest{*search.best, search.distance};
}

}  // namespace burnish
