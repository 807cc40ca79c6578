#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/import_worker/read_file.h"
#include "mesh/import_worker/triangulate.h"

namespace rinkaku::mesh {

/// Takes a file's polygons and makes triangles of them, counting what is no polygon.
class PolygonSink {
 public:
  explicit PolygonSink(ReadScene& scene) : scene_(scene) {}

  /// `corners` are numbers of vertices that have been read; out of range or negative ones drop the polygon.
  void add(std::span<const std::int64_t> corners) {
    Soup& soup = scene_.soup;
    if (corners.size() == 1) ++scene_.summary.dropped_points;
    if (corners.size() == 2) ++scene_.summary.dropped_lines;
    if (corners.size() < 3) return;
    positions_.clear();
    for (const std::int64_t corner : corners) {
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= soup.positions.size()) {
        ++scene_.summary.dropped_bad_index;
        return;
      }
      positions_.push_back(soup.positions[static_cast<std::size_t>(corner)]);
    }
    cut_.clear();
    triangulate(positions_, cut_);
    for (const glm::uvec3& t : cut_) {
      soup.triangles.emplace_back(static_cast<std::uint32_t>(corners[t.x]), static_cast<std::uint32_t>(corners[t.y]),
                                  static_cast<std::uint32_t>(corners[t.z]));
    }
  }

  /// All triangles become one part with the given material.
  void finish(Material material) {
    Soup& soup = scene_.soup;
    Part part;
    part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
    soup.parts = {part};
    soup.materials = {std::move(material)};
  }

 private:
  ReadScene& scene_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::uvec3> cut_;
};

}  // namespace rinkaku::mesh
