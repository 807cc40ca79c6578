#include "mesh/levels.h"

#include <algorithm>
#include <functional>
#include <future>

#include <meshoptimizer.h>

namespace rinkaku::mesh {
namespace {

constexpr std::size_t least_triangles = 500;
// A level that keeps more than this of the one before is not worth its memory.
constexpr double most_kept = 0.85;
// Of the mesh's extent.
constexpr double least_error = 2.5e-4, most_error = 1.1e-2, error_step = 1.7;

// A part's triangles: those that stay, and those that may be simplified.
struct SplitPart {
  std::vector<unsigned> kept, free;
};

SplitPart split(const Mesh& mesh, const Part& part, std::span<const std::uint8_t> kept) {
  SplitPart indices;
  const bool textured = mesh.materials[part.material].texture >= 0;
  for (std::uint32_t f = part.first_triangle; f < part.first_triangle + part.triangle_count; ++f) {
    const glm::uvec3& triangle = mesh.triangles[f];
    std::vector<unsigned>& to = textured || (!kept.empty() && kept[f] != 0) ? indices.kept : indices.free;
    to.insert(to.end(), {triangle.x, triangle.y, triangle.z});
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

Level simplified(const Mesh& mesh, const std::vector<SplitPart>& parts, double error) {
  Level level;
  const double scale = meshopt_simplifyScale(&mesh.positions[0].x, mesh.positions.size(), sizeof(mesh.positions[0]));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::vector<unsigned>& whole = parts[p].free;
    append(level, mesh.parts[p], parts[p].kept);
    std::vector<unsigned> left(whole.size());
    float reached = 0;
    left.resize(meshopt_simplify(left.data(), whole.data(), whole.size(), &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(mesh.positions[0]), 0, static_cast<float>(error), meshopt_SimplifyLockBorder,
                                 &reached));
    meshopt_optimizeVertexCache(left.data(), left.data(), left.size(), mesh.positions.size());
    append(level, mesh.parts[p], left);
    level.error = std::max(level.error, reached * scale);
  }
  return level;
}

}  // namespace

std::vector<Level> levels(const Mesh& mesh, std::span<const std::uint8_t> kept) {
  std::vector<Level> all;
  if (!mesh.colours.empty()) return all;
  std::vector<SplitPart> parts;
  for (const Part& part : mesh.parts) parts.push_back(split(mesh, part, kept));
  if (mesh.triangles.size() <= least_triangles) return all;
  std::vector<std::future<Level>> working;
  for (double error = least_error; error <= most_error; error *= error_step) {
    working.push_back(std::async(std::launch::async, simplified, std::cref(mesh), std::cref(parts), error));
  }
  std::size_t before = mesh.triangles.size();
  for (std::future<Level>& work : working) {
    Level level = work.get();
    if (static_cast<double>(level.triangles.size()) > most_kept * static_cast<double>(before)) continue;
    before = level.triangles.size();
    all.push_back(std::move(level));
  }
  return all;
}

}  // namespace rinkaku::mesh
