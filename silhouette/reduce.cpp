#include "silhouette/reduce.h"

#include <cmath>
#include <limits>

#include "silhouette/classify.h"
#include "silhouette/front_collapse.h"
#include "silhouette/front_mesh.h"
#include "silhouette/hidden.h"
#include "silhouette/shorten_edges.h"

namespace rinkaku::silhouette {
struct Reducer::State {
  explicit State(const Surface& of) : surface(of), planes(triangle_planes(of)), builder(of), collapse(mesh) {}

  const Surface& surface;
  TrianglePlanes planes;
  EyeHull hull;
  std::vector<Side> sides;
  std::vector<FrontTriangle> front;
  FrontMeshBuilder builder;
  CollapseMesh mesh;
  FrontCollapse collapse;
  std::vector<std::uint32_t> points;  // of the collapse mesh's vertices

  HiddenFinder hidden;

  void split(RegionMeshes& out);
  void drop_hidden(const ViewRegion& region, RegionMeshes& out);
  std::uint32_t collapse_front(double depth_distance, std::vector<glm::uvec3>& out);
};

/// Sorts the triangles into front and silhouette mesh.
void Reducer::State::split(RegionMeshes& out) {
  const std::size_t count = surface.triangles.size();
  out.roles.assign(count, Role::Dropped);
  out.silhouette = 0;
  out.hidden = 0;
  front.clear();
  for (std::uint32_t t = 0; t < count; ++t) {
    if (sides[t] == Side::Silhouette) {
      out.roles[t] = Role::Silhouette;
      out.silhouette += surface.two_sided[t] ? 2 : 1;
    } else if (sides[t] == Side::Front || surface.two_sided[t]) {
      out.roles[t] = Role::Front;
      front.push_back({t, sides[t] == Side::Back});
    }
  }
}

/// Collapses the front mesh; returns how many triangles it can have at least.
std::uint32_t Reducer::State::collapse_front(double depth_distance, std::vector<glm::uvec3>& out) {
  // A triangulated surface has as many triangles as boundary edges less twice its Euler number, plus two for each
  // vertex that is not on its boundary.
  const std::uint32_t inner = builder.build(front, mesh, points);
  const std::uint32_t least = static_cast<std::uint32_t>(front.size()) - 2 * inner;
  collapse.run(hull, depth_distance);
  if (std::isinf(depth_distance)) shorten_edges(mesh, hull);
  out.clear();
  for (const auto face : mesh.all_faces()) {
    if (mesh.status(face).deleted()) continue;
    const auto a = mesh.halfedge_handle(face);
    const auto b = mesh.next_halfedge_handle(a);
    const auto c = mesh.next_halfedge_handle(b);
    out.emplace_back(points[mesh.to_vertex_handle(a).idx()], points[mesh.to_vertex_handle(b).idx()],
                     points[mesh.to_vertex_handle(c).idx()]);
  }
  return least;
}

/// Takes the silhouette triangles that the collapsed front mesh hides out of the matte.
void Reducer::State::drop_hidden(const ViewRegion& region, RegionMeshes& out) {
  hidden.start(region, mesh);
  for (std::size_t t = 0; t < out.roles.size(); ++t) {
    if (out.roles[t] != Role::Silhouette) continue;
    const glm::uvec3& v = surface.triangles[t];
    if (!hidden.is_hidden({surface.frame.to_unit(surface.points[v.x]), surface.frame.to_unit(surface.points[v.y]),
                           surface.frame.to_unit(surface.points[v.z])})) {
      continue;
    }
    const std::uint32_t drawn = surface.two_sided[t] ? 2 : 1;
    out.roles[t] = Role::Hidden;
    out.silhouette -= drawn;
    out.hidden += drawn;
  }
}

std::vector<glm::uvec3> triangles_of(const Surface& surface, const RegionMeshes& meshes, Role role) {
  std::vector<glm::uvec3> out;
  for (std::size_t t = 0; t < meshes.roles.size(); ++t) {
    if (meshes.roles[t] != role) continue;
    const glm::uvec3& v = surface.triangles[t];
    out.push_back(v);
    if (surface.two_sided[t]) out.emplace_back(v.x, v.z, v.y);
  }
  return out;
}

Reducer::Reducer(const Surface& surface) : state_(std::make_unique<State>(surface)) {}
Reducer::~Reducer() = default;

void Reducer::reduce(const ViewRegion& region, const ReduceOptions& options, RegionMeshes& out) {
  state_->hull.set(region);
  classify(state_->planes, region, state_->sides);
  state_->split(out);
  out.front_before = static_cast<std::uint32_t>(state_->front.size());
  out.front_least = state_->collapse_front(std::numeric_limits<double>::infinity(), out.matte_front);
  if (options.drop_hidden) state_->drop_hidden(region, out);
  out.depth_front.clear();
  if (options.depth_distance > 0) state_->collapse_front(options.depth_distance, out.depth_front);
}

}  // namespace rinkaku::silhouette
