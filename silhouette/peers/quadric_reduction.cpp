#include <algorithm>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_cast.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <meshoptimizer.h>

#include "silhouette/peers/one_sided.h"
#include "silhouette/peers/reduction.h"

namespace rinkaku::silhouette {
namespace {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

// OpenMesh tells of each face that it can't hold on standard error.
class QuietOpenMesh {
 public:
  QuietOpenMesh() { omerr().disable(); }
  ~QuietOpenMesh() { omerr().enable(); }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;
};

std::vector<std::uint32_t> reduced(std::span<const glm::vec3> points, const std::vector<std::uint32_t>& list,
                                   std::size_t target) {
  const QuietOpenMesh quiet;
  HalfEdgeMesh mesh;
  for (const glm::vec3& p : points) mesh.add_vertex({p.x, p.y, p.z});
  std::vector<std::uint32_t> out;  // first what OpenMesh can't hold
  const auto vertex = [](std::uint32_t point) { return OpenMesh::VertexHandle(static_cast<int>(point)); };
  for (std::size_t i = 0; i < list.size(); i += 3) {
    const bool held = mesh.add_face(vertex(list[i]), vertex(list[i + 1]), vertex(list[i + 2])).is_valid();
    if (!held) out.insert(out.end(), {list[i], list[i + 1], list[i + 2]});
  }
  const std::size_t left_over = out.size() / 3;
  OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, target - std::min(target, left_over));
  for (const auto face : mesh.faces()) {
    if (mesh.status(face).deleted()) continue;
    for (const auto corner : mesh.fv_range(face)) out.push_back(static_cast<std::uint32_t>(corner.idx()));
  }
  meshopt_optimizeVertexCache(out.data(), out.data(), out.size(), points.size());
  return out;
}

}  // namespace

std::vector<std::uint32_t> reduce_with_quadrics(std::span<const glm::vec3> points,
                                                std::span<const std::uint32_t> indices, std::size_t target_triangles) {
  return reduced_sides(indices, target_triangles, [&](const std::vector<std::uint32_t>& list, std::size_t target) {
    return reduced(points, list, target);
  });
}

}  // namespace rinkaku::silhouette
