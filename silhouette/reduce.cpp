#include "silhouette/reduce.h"

#include <limits>

#include "silhouette/classify.h"
#include "silhouette/front_collapse.h"
#include "silhouette/front_mesh.h"

namespace rinkaku::silhouette {
namespace {

glm::uvec3 reversed(const glm::uvec3& t) { return {t.x, t.z, t.y}; }

}  // namespace

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

  void split(RegionMeshes& out);
  std::uint32_t collapse_front(double depth_distance, std::vector<glm::uvec3>& out);
};

/// Sorts the triangles into front and silhouette mesh, and marks those that can show.
void Reducer::State::split(RegionMeshes& out) {
  const std::size_t count = surface.triangles.size();
  out.colour.assign((count + 7) / 8, 0);
  out.silhouette.clear();
  front.clear();
  for (std::uint32_t t = 0; t < count; ++t) {
    const glm::uvec3& v = surface.triangles[t];
    if (sides[t] != Side::Back || surface.drawn_from_behind[t]) out.colour[t / 8] |= std::uint8_t(1u << (t % 8));
    if (sides[t] == Side::Front) front.push_back({t, false});
    if (sides[t] == Side::Back && surface.two_sided[t]) front.push_back({t, true});
    if (sides[t] != Side::Silhouette) continue;
    out.silhouette.push_back(v);
    if (surface.two_sided[t]) out.silhouette.push_back(reversed(v));
  }
}

/// Collapses the front mesh; returns how many triangles it can have at least.
std::uint32_t Reducer::State::collapse_front(double depth_distance, std::vector<glm::uvec3>& out) {
  // A triangulated surface has as many triangles as boundary edges less twice its Euler number, plus two for each
  // vertex that is not on its boundary.
  const std::uint32_t inner = builder.build(front, mesh, points);
  const std::uint32_t least = static_cast<std::uint32_t>(front.size()) - 2 * inner;
  collapse.run(hull, depth_distance);
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

Reducer::Reducer(const Surface& surface) : state_(std::make_unique<State>(surface)) {}
Reducer::~Reducer() = default;

void Reducer::reduce(const ViewRegion& region, const ReduceOptions& options, RegionMeshes& out) {
  state_->hull.set(region);
  classify(state_->planes, region, state_->sides);
  state_->split(out);
  out.hidden.clear();
  out.front_before = static_cast<std::uint32_t>(state_->front.size());
  out.front_least = state_->collapse_front(std::numeric_limits<double>::infinity(), out.matte_front);
  out.depth_front.clear();
  if (options.depth_distance > 0) state_->collapse_front(options.depth_distance, out.depth_front);
}

}  // namespace rinkaku::silhouette
