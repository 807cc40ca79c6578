#include <meshoptimizer.h>

#include "silhouette/peers/one_sided.h"
#include "silhouette/peers/reduction.h"

namespace rinkaku::silhouette {

std::vector<std::uint32_t> reduce_with_meshopt(std::span<const glm::vec3> points,
                                               std::span<const std::uint32_t> indices, std::size_t target_triangles) {
  return reduced_sides(indices, target_triangles, [&](const std::vector<std::uint32_t>& list, std::size_t target) {
    std::vector<std::uint32_t> out(list.size());
    constexpr float any_error = 1.0f;  // of the mesh's size: the count decides
    out.resize(meshopt_simplify(out.data(), list.data(), list.size(), &points[0].x, points.size(), sizeof(glm::vec3),
                                target * 3, any_error));
    meshopt_optimizeVertexCache(out.data(), out.data(), out.size(), points.size());
    return out;
  });
}

}  // namespace rinkaku::silhouette
