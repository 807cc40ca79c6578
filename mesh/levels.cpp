#include "mesh/levels.h"

#include <algorithm>

#include <meshoptimizer.h>

namespace rinkaku::mesh {
namespace {

constexpr std::size_t least_triangles = 500;
// A level that keeps more than this of the one before is not worth its memory.
constexpr double most_kept = 0.8;

std::vector<unsigned> indices_of(const Mesh& mesh, const Part& part) {
  std::vector<unsigned> indices;
  indices.reserve(part.triangle_count * std::size_t{3});
  for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
    const glm::uvec3& triangle = mesh.triangles[part.first_triangle + t];
    indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
  }
  return indices;
}

void append(Level& level, const Part& part, const std::vector<unsigned>& indices) {
  Part coarse = part;
  coarse.first_triangle = static_cast<std::uint32_t>(level.triangles.size());
  coarse.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    level.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  }
  level.parts.push_back(std::move(coarse));
}

Level simplified(const Mesh& mesh, double ratio) {
  Level level;
  const double scale = meshopt_simplifyScale(&mesh.positions[0].x, mesh.positions.size(), sizeof(mesh.positions[0]));
  for (const Part& part : mesh.parts) {
    const std::vector<unsigned> whole = indices_of(mesh, part);
    if (mesh.materials[part.material].texture >= 0) {
      append(level, part, whole);
      continue;
    }
    std::vector<unsigned> kept(whole.size());
    const auto target = static_cast<std::size_t>(static_cast<double>(part.triangle_count) * ratio) * 3;
    float error = 0;
    kept.resize(meshopt_simplify(kept.data(), whole.data(), whole.size(), &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(mesh.positions[0]), target, 1.0f, meshopt_SimplifyLockBorder, &error));
    meshopt_optimizeVertexCache(kept.data(), kept.data(), kept.size(), mesh.positions.size());
    append(level, part, kept);
    level.error = std::max(level.error, error * scale);
  }
  return level;
}

}  // namespace

std::vector<Level> levels(const Mesh& mesh) {
  std::vector<Level> all;
  if (!mesh.colours.empty()) return all;
  std::size_t before = mesh.triangles.size();
  for (double ratio = 0.5; static_cast<double>(mesh.triangles.size()) * ratio >= least_triangles; ratio /= 2) {
    Level level = simplified(mesh, ratio);
    if (static_cast<double>(level.triangles.size()) > most_kept * static_cast<double>(before)) break;
    before = level.triangles.size();
    all.push_back(std::move(level));
  }
  return all;
}

}  // namespace rinkaku::mesh
