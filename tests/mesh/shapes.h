#pragma once

#include <cmath>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/assemble.h"

namespace rinkaku::test {

using mesh::Part;
using mesh::Soup;

inline Soup one_part(Soup soup) {
  Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return soup;
}

/// The cube from -1 to 1, two triangles a side.
inline Soup cube() {
  Soup soup;
  for (int i = 0; i < 8; ++i) soup.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const glm::uvec4 sides[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const glm::uvec4& s : sides) {
    soup.triangles.emplace_back(s.x, s.y, s.z);
    soup.triangles.emplace_back(s.x, s.z, s.w);
  }
  return one_part(std::move(soup));
}

/// A unit sphere: an octahedron cut finer `levels` times; 8 * 4^levels triangles.
inline Soup sphere(int levels) {
  Soup soup;
  soup.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  soup.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), soup.positions.size());
      if (fresh) soup.positions.push_back(glm::normalize(soup.positions[a] + soup.positions[b]));
      return at->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : soup.triangles) {
      const glm::uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
      finer.insert(finer.end(), {{t.x, m.x, m.z}, {m.x, t.y, m.y}, {m.z, m.y, t.z}, m});
    }
    soup.triangles = std::move(finer);
  }
  return one_part(std::move(soup));
}

/// A flat square from 0 to 1 in z = 0, facing +z.
inline Soup square() {
  Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 2, 3}};
  return one_part(std::move(soup));
}

}  // namespace rinkaku::test
