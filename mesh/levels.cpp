#include "mesh/levels.h"

#include <algorithm>

#include <meshoptimizer.h>

namespace rinkaku::mesh {
namespace {

constexpr std::size_t least_triangles = 500;
// Of the mesh's extent. From step to step about a third of the triangles go.
constexpr double least_error = 2.5e-4, most_error_of_all = 1.1e-2, error_step = 1.7;

void append(Level& level, const Part& part, const std::vector<unsigned>& indices) {
  Part coarse = part;
  coarse.first_triangle = static_cast<std::uint32_t>(level.triangles.size());
  coarse.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    level.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  }
  level.parts.push_back(std::move(coarse));
}

}  // namespace

Levels::Levels(const Mesh& mesh, std::span<const std::uint8_t> kept) {
  if (mesh.triangles.size() <= least_triangles || !mesh.colours.empty()) return;
  bool any_free = false;
  for (const Part& part : mesh.parts) {
    SplitPart& split = parts_.emplace_back();
    split.part = part;
    const bool textured = mesh.materials[part.material].texture >= 0;
    for (std::uint32_t f = part.first_triangle; f < part.first_triangle + part.triangle_count; ++f) {
      const glm::uvec3& triangle = mesh.triangles[f];
      std::vector<unsigned>& to = textured || (!kept.empty() && kept[f] != 0) ? split.kept : split.free;
      to.insert(to.end(), {triangle.x, triangle.y, triangle.z});
    }
    any_free = any_free || !split.free.empty();
  }
  if (!any_free) return;
  positions_ = mesh.positions;
  extent_ = meshopt_simplifyScale(&positions_[0].x, positions_.size(), sizeof(positions_[0]));
  for (double error = least_error; error <= most_error_of_all; error *= error_step) errors_.push_back(error * extent_);
}

Level Levels::make(std::size_t index) const {
  Level level;
  const auto most = static_cast<float>(errors_[index] / extent_);
  for (const SplitPart& split : parts_) {
    append(level, split.part, split.kept);
    std::vector<unsigned> left(split.free.size());
    float reached = 0;
    left.resize(meshopt_simplify(left.data(), split.free.data(), split.free.size(), &positions_[0].x, positions_.size(),
                                 sizeof(positions_[0]), 0, most, meshopt_SimplifyLockBorder, &reached));
    meshopt_optimizeVertexCache(left.data(), left.data(), left.size(), positions_.size());
    append(level, split.part, left);
    level.error = std::max(level.error, reached * extent_);
  }
  return level;
}

}  // namespace rinkaku::mesh
