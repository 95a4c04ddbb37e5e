#include "burnish/mesh/simplify/connectivity.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace burnish {
namespace {

using TriMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using VertexHandle = TriMesh::VertexHandle;
using HalfedgeHandle = TriMesh::HalfedgeHandle;

VertexHandle vertex(std::uint32_t v) { return VertexHandle(int(v)); }

}  // namespace

struct Connectivity::Impl {
  // Asking whether an edge may collapse leaves marks on vertices.
  mutable TriMesh mesh;

  HalfedgeHandle halfedge(std::uint32_t from, std::uint32_t to) const {
    return mesh.find_halfedge(vertex(from), vertex(to));
  }
};

Connectivity::Connectivity() : impl_(std::make_unique<Impl>()) {
  impl_->mesh.request_vertex_status();
  impl_->mesh.request_edge_status();
  impl_->mesh.request_face_status();
}
Connectivity::~Connectivity() = default;
Connectivity::Connectivity(Connectivity&&) noexcept = default;

std::uint32_t Connectivity::add_vertex() { return std::uint32_t(impl_->mesh.add_vertex({}).idx()); }

bool Connectivity::add_triangle(const Corners& v) {
  omerr().disable();  // it would tell standard error why not
  const bool added = impl_->mesh.add_face(vertex(v[0]), vertex(v[1]), vertex(v[2])).is_valid();
  omerr().enable();
  return added;
}

bool Connectivity::has_vertex(std::uint32_t v) const { return !impl_->mesh.status(vertex(v)).deleted(); }
bool Connectivity::has_triangle(std::uint32_t t) const {
  return !impl_->mesh.status(TriMesh::FaceHandle(int(t))).deleted();
}
bool Connectivity::is_border(std::uint32_t v) const { return impl_->mesh.is_boundary(vertex(v)); }

std::vector<std::pair<std::uint32_t, std::uint32_t>> Connectivity::edges() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (const auto e : impl_->mesh.edges())
    if (!impl_->mesh.status(e).deleted()) out.emplace_back(e.v0().idx(), e.v1().idx());
  return out;
}

std::vector<std::uint32_t> Connectivity::neighbours(std::uint32_t v) const {
  std::vector<std::uint32_t> out;
  for (const auto n : impl_->mesh.vv_range(vertex(v))) out.push_back(std::uint32_t(n.idx()));
  return out;
}

std::vector<std::uint32_t> Connectivity::triangles_at(std::uint32_t v) const {
  std::vector<std::uint32_t> out;
  for (const auto f : impl_->mesh.vf_range(vertex(v))) out.push_back(std::uint32_t(f.idx()));
  return out;
}

std::vector<std::uint32_t> Connectivity::triangles_on(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> out;
  const HalfedgeHandle h = impl_->halfedge(a, b);
  for (const HalfedgeHandle side : {h, impl_->mesh.opposite_halfedge_handle(h)})
    if (const auto f = impl_->mesh.face_handle(side); f.is_valid()) out.push_back(std::uint32_t(f.idx()));
  return out;
}

bool Connectivity::can_collapse(std::uint32_t from, std::uint32_t to) const {
  TriMesh& mesh = impl_->mesh;
  const HalfedgeHandle h = impl_->halfedge(from, to), opposite = mesh.opposite_halfedge_handle(h);
  if (!mesh.is_collapse_ok(h) || (is_border(from) && !is_border(to))) return false;
  if (mesh.is_boundary(h) || mesh.is_boundary(opposite)) return true;
  const VertexHandle left = mesh.to_vertex_handle(mesh.next_halfedge_handle(h)),
                     right = mesh.to_vertex_handle(mesh.next_halfedge_handle(opposite));
  return mesh.valence(left) > 3 || mesh.valence(right) > 3 || !mesh.find_halfedge(left, right).is_valid();
}

void Connectivity::collapse(std::uint32_t from, std::uint32_t to) { impl_->mesh.collapse(impl_->halfedge(from, to)); }

}  // namespace burnish
