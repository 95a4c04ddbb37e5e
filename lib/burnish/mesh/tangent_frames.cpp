#include "burnish/mesh/tangent_frames.h"

#include <algorithm>

#include "burnish/mesh/weld.h"

namespace burnish {
namespace {

constexpr std::uint32_t kNone = ~0u;
// What is left by rounding of texture coordinates on one line, and of opposite unit vectors.
constexpr double kRounding = 1e-12;

struct Triangle {
  Corners vertex{};                     // corners with equal position, normal and texture coordinates share one
  Vec3d along_u, along_v;               // unit
  bool degenerate = false;              // two corners at one position: takes part in nothing
  bool blank = false;                   // no texture area: goes with neighbours of either handedness
  bool mirrored = false;                // of a blank one: as the first group that reaches it
  Corners across{kNone, kNone, kNone};  // the triangle on the other side of edge c → c + 1
  Corners group{kNone, kNone, kNone};   // of each corner

  int corner_at(std::uint32_t v) const { return v == vertex[0] ? 0 : v == vertex[1] ? 1 : 2; }
};

struct Group {
  std::uint32_t vertex = 0;
  bool mirrored = false;
  std::vector<std::uint32_t> triangles;
};

std::vector<Corners> welded_vertices(const Mesh& mesh) {
  const std::vector<std::uint32_t> p = weld(mesh.positions), n = weld(mesh.normals), uv = weld(mesh.uvs);
  std::vector<Corners> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      corners.push_back({p[mesh.triangles[t][c]], n[mesh.triangle_normals[t][c]], uv[mesh.triangle_uvs[t][c]]});
  const std::vector<std::uint32_t> first = weld(corners);
  std::vector<Corners> out(mesh.triangles.size());
  for (std::size_t i = 0; i < first.size(); i++) out[i / 3][i % 3] = first[i];
  return out;
}

// Mikkelsen, equations 18 and 19.
void set_directions(const Mesh& mesh, std::size_t t, Triangle& triangle) {
  const Vec3d p = mesh.position(t, 0), p1 = mesh.position(t, 1), p2 = mesh.position(t, 2);
  const Vec2d a = mesh.uv(t, 1) - mesh.uv(t, 0), b = mesh.uv(t, 2) - mesh.uv(t, 0);
  triangle.degenerate = p == p1 || p == p2 || p1 == p2;
  const double area = cross(a, b);
  triangle.blank = !(std::abs(area) > kRounding * std::sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y)));
  if (triangle.blank) return;
  triangle.mirrored = area < 0;
  const double sign = triangle.mirrored ? -1 : 1;
  const Vec3d u = ((p1 - p) * b.y - (p2 - p) * a.y) * sign, v = ((p2 - p) * a.x - (p1 - p) * b.x) * sign;
  triangle.blank = !(length(u) > 0 && length(v) > 0);
  if (triangle.blank) return;
  triangle.along_u = normalized(u);
  triangle.along_v = normalized(v);
}

// Pairs up triangles that run along one edge in opposite directions, in the order of their numbers.
void connect(std::vector<Triangle>& triangles) {
  struct Edge {
    std::uint32_t low, high, triangle, corner;
    auto key() const { return std::tie(low, high, triangle, corner); }
    bool same_vertices(const Edge& e) const { return low == e.low && high == e.high; }
  };
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); t++)
    for (std::uint32_t c = 0; c < 3 && !triangles[t].degenerate; c++) {
      const std::uint32_t a = triangles[t].vertex[c], b = triangles[t].vertex[(c + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, c});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  for (std::size_t i = 0; i < edges.size(); i++) {
    Triangle& one = triangles[edges[i].triangle];
    if (one.across[edges[i].corner] != kNone) continue;
    for (std::size_t j = i + 1; j < edges.size() && edges[i].same_vertices(edges[j]); j++) {
      Triangle& other = triangles[edges[j].triangle];
      if (other.across[edges[j].corner] != kNone || one.vertex[edges[i].corner] == other.vertex[edges[j].corner])
        continue;
      one.across[edges[i].corner] = edges[j].triangle;
      other.across[edges[j].corner] = edges[i].triangle;
      break;
    }
  }
}

// Around the vertex at corner c of triangle t, as far as neighbours of one handedness reach.
Group flood(std::vector<Triangle>& triangles, std::uint32_t t, int c, std::uint32_t number) {
  Group group{triangles[t].vertex[c], triangles[t].mirrored, {}};
  std::vector<std::uint32_t> open{t};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    Triangle& triangle = triangles[at];
    const int corner = triangle.corner_at(group.vertex);
    if (triangle.group[corner] != kNone) continue;
    if (triangle.blank && triangle.group == Corners{kNone, kNone, kNone}) triangle.mirrored = group.mirrored;
    if (triangle.mirrored != group.mirrored) continue;
    triangle.group[corner] = number;
    group.triangles.push_back(at);
    for (const std::uint32_t next : {triangle.across[corner], triangle.across[(corner + 2) % 3]})
      if (next != kNone) open.push_back(next);
  }
  std::sort(group.triangles.begin(), group.triangles.end());
  return group;
}

std::vector<Group> build_groups(std::vector<Triangle>& triangles) {
  std::vector<Group> groups;
  for (std::uint32_t t = 0; t < triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      if (!triangles[t].degenerate && !triangles[t].blank && triangles[t].group[c] == kNone)
        groups.push_back(flood(triangles, t, c, std::uint32_t(groups.size())));
  return groups;
}

Vec3d unit_in_plane(Vec3d v, Vec3d normal) {
  const Vec3d p = v - normal * dot(normal, v);
  return length(p) > 0 ? normalized(p) : p;
}

Vec3d any_tangent(Vec3d n) {
  const Vec3d axis = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vec3d{1, 0, 0}
                     : std::abs(n.y) <= std::abs(n.z)                                 ? Vec3d{0, 1, 0}
                                                                                      : Vec3d{0, 0, 1};
  return normalized(cross(axis, n));
}

// What a triangle of a group adds to the mean.
struct Member {
  Vec3d u, v;
  double angle;
  bool blank;

  bool is_opposite(const Member& m) const { return dot(u, m.u) <= kRounding - 1 || dot(v, m.v) <= kRounding - 1; }
};

// All on one side, as nearly everywhere: then no two are opposite.
bool all_on_one_side(const std::vector<Member>& members, Vec3d Member::*direction) {
  Vec3d sum;
  for (const Member& m : members) sum += m.*direction;
  constexpr double kClear = 1e-5;  // beyond what kRounding takes for opposite
  return std::ranges::all_of(members,
                             [&](const Member& m) { return m.blank || dot(m.*direction, sum) > kClear * length(sum); });
}

// The mean over the group, weighted by angle. Those that point exactly the other way take no part in a triangle's own:
// the standard's angular threshold of 180°.
void set_tangents(const Mesh& mesh, const std::vector<Triangle>& triangles, const Group& group, TangentFrames& frames) {
  std::vector<Member> members;
  const Vec3d n = mesh.normal(group.triangles[0], triangles[group.triangles[0]].corner_at(group.vertex));
  for (const std::uint32_t t : group.triangles) {
    const int c = triangles[t].corner_at(group.vertex);
    const Vec3d at = mesh.position(t, c);
    members.push_back({unit_in_plane(triangles[t].along_u, n), unit_in_plane(triangles[t].along_v, n),
                       angle_rad(unit_in_plane(mesh.position(t, (c + 1) % 3) - at, n),
                                 unit_in_plane(mesh.position(t, (c + 2) % 3) - at, n)),
                       triangles[t].blank});
  }
  const auto sum_for = [&](const Member& one) {
    Vec3d sum;
    for (const Member& m : members)
      if (!m.blank && (one.blank || !one.is_opposite(m))) sum += m.u * m.angle;
    return sum;
  };
  const bool one_sum = all_on_one_side(members, &Member::u) && all_on_one_side(members, &Member::v);
  Vec3d sum;
  for (std::size_t i = 0; i < members.size(); i++) {
    if (i == 0 || !one_sum) sum = sum_for(members[i]);
    const std::uint32_t t = group.triangles[i];
    frames[t][triangles[t].corner_at(group.vertex)] = {length(sum) > 1e-9 ? normalized(sum) : any_tangent(n),
                                                       group.mirrored ? -1.0 : 1.0};
  }
}

// Corners that no group has: they copy from the first corner of the same vertex that has one.
void set_remaining(const Mesh& mesh, const std::vector<Triangle>& triangles, TangentFrames& frames) {
  std::vector<const CornerTangent*> known(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      if (const CornerTangent*& first = known[triangles[t].vertex[c]]; triangles[t].group[c] != kNone && !first)
        first = &frames[t][c];
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (int c = 0; c < 3; c++)
      if (triangles[t].group[c] == kNone) {
        const CornerTangent* source = known[triangles[t].vertex[c]];
        frames[t][c] = source ? *source : CornerTangent{any_tangent(mesh.normal(t, c)), 1};
      }
}

}  // namespace

TangentFrames tangent_frames(const Mesh& mesh) {
  const std::vector<Corners> vertices = welded_vertices(mesh);
  std::vector<Triangle> triangles(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); t++) {
    triangles[t].vertex = vertices[t];
    set_directions(mesh, t, triangles[t]);
  }
  connect(triangles);
  TangentFrames frames(triangles.size());
  for (const Group& group : build_groups(triangles)) set_tangents(mesh, triangles, group, frames);
  set_remaining(mesh, triangles, frames);
  return frames;
}

FrameAt frame_at(const Mesh& mesh, const TangentFrames& frames, const MeshPoint& point) {
  FrameAt at;
  for (int c = 0; c < 3; c++) {
    const auto& [tangent, sign] = frames[point.triangle][c];
    const Vec3d normal = mesh.normal(point.triangle, c);
    at.t += tangent * point.weight[c];
    at.b += cross(normal, tangent) * (sign * point.weight[c]);
    at.n += normal * point.weight[c];
  }
  return at;
}

Vec3d FrameAt::to_tangent(Vec3d object) const {
  const Vec3d across_t = cross(b, n), across_b = cross(n, t), across_n = cross(t, b);
  const Vec3d mapped =
      Vec3d{dot(across_t, object), dot(across_b, object), dot(across_n, object)} * (dot(t, across_t) < 0 ? -1.0 : 1.0);
  return length(mapped) > 0 ? normalized(mapped) : Vec3d{0, 0, 1};
}

}  // namespace burnish
