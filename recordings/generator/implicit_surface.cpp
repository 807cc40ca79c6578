#include "recordings/generator/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::recordings {
namespace {

// A cell's corner i lies at (i & 1, i >> 1 & 1, i >> 2).
constexpr int edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                              {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

// Whether the surface passes through a cell as one sheet: on no face may the signs lie crosswise, and the corners
// inside as well as those outside must hang together along edges.
bool is_one_sheet(const std::array<bool, 8>& inside) {
  for (const int axis : {1, 2, 4}) {
    const int u = axis == 1 ? 2 : 1, v = axis == 4 ? 2 : 4;
    for (const int base : {0, axis}) {
      const auto at = [&](int corner) { return inside[static_cast<std::size_t>(base + corner)]; };
      if (at(0) == at(u + v) && at(u) == at(v) && at(0) != at(u)) return false;
    }
  }
  std::array<int, 8> part{0, 1, 2, 3, 4, 5, 6, 7};
  for (int round = 0; round < 8; ++round) {
    for (const auto& edge : edges) {
      const std::size_t a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
      if (inside[a] == inside[b]) part[a] = part[b] = std::min(part[a], part[b]);
    }
  }
  return std::set<int>(part.begin(), part.end()).size() <= 2;
}

// Where two sheets pass through one cell, dual vertices would join them to something that is no manifold. There the
// outside corner nearest to the surface is taken in, until it happens nowhere.
void fill_ambiguous(std::vector<float>& value, glm::ivec3 n) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z + 1 < n.z; ++z) {
      for (int y = 0; y + 1 < n.y; ++y) {
        for (int x = 0; x + 1 < n.x; ++x) {
          std::array<bool, 8> inside{};
          float* least = nullptr;
          for (int i = 0; i < 8; ++i) {
            float& f = value[static_cast<std::size_t>(((z + (i >> 2)) * n.y + y + ((i >> 1) & 1)) * n.x + x + (i & 1))];
            inside[static_cast<std::size_t>(i)] = f < 0;
            if (f >= 0 && (!least || f < *least)) least = &f;
          }
          if (!least || is_one_sheet(inside)) continue;
          *least = -1e-4f;
          changed = true;
        }
      }
    }
  }
}

void evenly_onto_surface(ColouredMesh& mesh, const Implicit& f, float cell) {
  const std::size_t count = mesh.positions.size();
  std::vector<std::set<int>> neighbours(count);
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      neighbours[static_cast<std::size_t>(t[i])].insert(t[(i + 1) % 3]);
      neighbours[static_cast<std::size_t>(t[(i + 1) % 3])].insert(t[i]);
    }
  }
  constexpr int rounds = 12;
  for (int round = 0; round < rounds; ++round) {
    std::vector<glm::vec3> moved(count);
    for (std::size_t v = 0; v < count; ++v) {
      glm::vec3 mean(0);
      for (const int n : neighbours[v]) mean += mesh.positions[static_cast<std::size_t>(n)];
      mean /= static_cast<float>(neighbours[v].size());
      const glm::vec3 p = mesh.positions[v], normal = surface_normal(f, p);
      const glm::vec3 shift = mean - p;
      moved[v] = p + 0.5f * (shift - normal * glm::dot(shift, normal));
      for (int step = 0; step < 2; ++step) {
        const glm::vec3 n = surface_normal(f, moved[v]);
        moved[v] -= n * glm::clamp(f(moved[v]), -0.5f * cell, 0.5f * cell);
      }
    }
    mesh.positions = std::move(moved);
  }
}

}  // namespace

float ellipsoid(glm::vec3 p, glm::vec3 centre, glm::vec3 radii) {
  const glm::vec3 q = (p - centre) / radii;
  const float k0 = glm::length(q), k1 = glm::length(q / radii);
  if (k1 < 1e-9f) return -std::min({radii.x, radii.y, radii.z});
  return k0 * (k0 - 1.0f) / k1;
}

float rounded_cone(glm::vec3 p, glm::vec3 a, glm::vec3 b, float radius_a, float radius_b) {
  const glm::vec3 axis = b - a;
  const float t = glm::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
  return glm::length(p - a - t * axis) - (radius_a + t * (radius_b - radius_a));
}

float smooth_union(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * h * k / 6.0f;
}

glm::vec3 surface_normal(const Implicit& f, glm::vec3 p, float step) {
  const glm::vec3 x(step, 0, 0), y(0, step, 0), z(0, 0, step);
  const glm::vec3 gradient(f(p + x) - f(p - x), f(p + y) - f(p - y), f(p + z) - f(p - z));
  const float length = glm::length(gradient);
  return length > 0 ? gradient / length : glm::vec3(0, 1, 0);
}

ColouredMesh mesh_surface(const Implicit& f, glm::vec3 low, glm::vec3 high, float cell, int material) {
  const glm::ivec3 n = glm::ivec3(glm::ceil((high - low) / cell)) + 2;
  const auto at = [&](int x, int y, int z) { return static_cast<std::size_t>((z * n.y + y) * n.x + x); };
  const auto corner = [&](int x, int y, int z) { return low + cell * glm::vec3(x - 0.5f, y - 0.5f, z - 0.5f); };
  std::vector<float> value(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                           static_cast<std::size_t>(n.z));
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x; ++x) value[at(x, y, z)] = f(corner(x, y, z));
    }
  }

  fill_ambiguous(value, n);

  ColouredMesh mesh;
  std::vector<int> vertex(value.size(), -1);
  for (int z = 0; z + 1 < n.z; ++z) {
    for (int y = 0; y + 1 < n.y; ++y) {
      for (int x = 0; x + 1 < n.x; ++x) {
        glm::vec3 sum(0);
        int crossings = 0;
        for (const auto& edge : edges) {
          const glm::ivec3 a(edge[0] & 1, (edge[0] >> 1) & 1, edge[0] >> 2);
          const glm::ivec3 b(edge[1] & 1, (edge[1] >> 1) & 1, edge[1] >> 2);
          const float fa = value[at(x + a.x, y + a.y, z + a.z)], fb = value[at(x + b.x, y + b.y, z + b.z)];
          if ((fa < 0) == (fb < 0)) continue;
          sum += glm::mix(corner(x + a.x, y + a.y, z + a.z), corner(x + b.x, y + b.y, z + b.z), fa / (fa - fb));
          ++crossings;
        }
        if (crossings == 0) continue;
        vertex[at(x, y, z)] = static_cast<int>(mesh.positions.size());
        mesh.positions.push_back(sum / static_cast<float>(crossings));
      }
    }
  }

  // Every grid edge that crosses the surface is ringed by four cells, whose vertices make a quad.
  const auto quad = [&](int a, int b, int c, int d, bool flip) {
    if (flip) std::swap(b, d);
    const auto& p = mesh.positions;
    const auto length = [&](int i, int j) {
      return glm::distance(p[static_cast<std::size_t>(i)], p[static_cast<std::size_t>(j)]);
    };
    if (length(a, c) < length(b, d)) {
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
    } else {
      mesh.triangles.insert(mesh.triangles.end(), {{b, c, d}, {b, d, a}});
    }
  };
  for (int z = 1; z + 1 < n.z; ++z) {
    for (int y = 1; y + 1 < n.y; ++y) {
      for (int x = 1; x + 1 < n.x; ++x) {
        const bool inside = value[at(x, y, z)] < 0;
        if (inside != (value[at(x + 1, y, z)] < 0)) {
          quad(vertex[at(x, y - 1, z - 1)], vertex[at(x, y, z - 1)], vertex[at(x, y, z)], vertex[at(x, y - 1, z)],
               !inside);
        }
        if (inside != (value[at(x, y + 1, z)] < 0)) {
          quad(vertex[at(x - 1, y, z - 1)], vertex[at(x - 1, y, z)], vertex[at(x, y, z)], vertex[at(x, y, z - 1)],
               !inside);
        }
        if (inside != (value[at(x, y, z + 1)] < 0)) {
          quad(vertex[at(x - 1, y - 1, z)], vertex[at(x, y - 1, z)], vertex[at(x, y, z)], vertex[at(x - 1, y, z)],
               !inside);
        }
      }
    }
  }
  mesh.materials.assign(mesh.triangles.size(), material);
  evenly_onto_surface(mesh, f, cell);
  for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(surface_normal(f, p));
  return mesh;
}

void paint(ColouredMesh& mesh, const Implicit& region, int material, const std::vector<int>& from) {
  std::vector<float> value;
  for (const glm::vec3& p : mesh.positions) value.push_back(region(p));
  const auto changes = [&](std::size_t triangle) {
    return from.empty() || std::find(from.begin(), from.end(), mesh.materials[triangle]) != from.end();
  };

  // A border that passes very near a vertex goes through it, lest slivers arise.
  constexpr float snap = 0.12f;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      float& a = value[static_cast<std::size_t>(mesh.triangles[t][i])];
      float& b = value[static_cast<std::size_t>(mesh.triangles[t][(i + 1) % 3])];
      if ((a < 0) == (b < 0) || a == 0 || b == 0) continue;
      const float along = a / (a - b);
      if (along < snap) a = 0;
      if (along > 1 - snap) b = 0;
    }
  }

  std::map<std::pair<int, int>, int> cut;
  const auto cut_vertex = [&](int a, int b) {
    const std::pair<int, int> key = std::minmax(a, b);
    if (const auto found = cut.find(key); found != cut.end()) return found->second;
    const std::size_t i = static_cast<std::size_t>(key.first), j = static_cast<std::size_t>(key.second);
    const float along = value[i] / (value[i] - value[j]);
    mesh.positions.push_back(glm::mix(mesh.positions[i], mesh.positions[j], along));
    mesh.normals.push_back(glm::normalize(glm::mix(mesh.normals[i], mesh.normals[j], along)));
    value.push_back(0);
    return cut[key] = static_cast<int>(mesh.positions.size()) - 1;
  };
  const auto sign = [&](int v) {
    const float x = value[static_cast<std::size_t>(v)];
    return x < 0 ? -1 : x > 0 ? 1 : 0;
  };

  // Every edge that changes sign is cut in all its triangles, painted or not, so that the mesh stays closed.
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> materials;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<int> below, above;
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      if (sign(a) <= 0) below.push_back(a);
      if (sign(a) >= 0) above.push_back(a);
      if (sign(a) * sign(b) < 0) {
        const int c = cut_vertex(a, b);
        below.push_back(c);
        above.push_back(c);
      }
    }
    const auto is_area = [&](const std::vector<int>& part) {
      return part.size() >= 3 && std::any_of(part.begin(), part.end(), [&](int v) { return sign(v) != 0; });
    };
    const auto emit = [&](const std::vector<int>& part, int m) {
      for (std::size_t i = 2; i < part.size(); ++i) {
        triangles.push_back({part[0], part[i - 1], part[i]});
        materials.push_back(m);
      }
    };
    const int old = mesh.materials[t];
    if (!is_area(below) && !is_area(above)) {
      emit({mesh.triangles[t].begin(), mesh.triangles[t].end()}, old);
      continue;
    }
    if (is_area(below)) emit(below, changes(t) ? material : old);
    if (is_area(above)) emit(above, old);
  }
  mesh.triangles = std::move(triangles);
  mesh.materials = std::move(materials);
}

void append(ColouredMesh& mesh, const ColouredMesh& other) {
  const int base = static_cast<int>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  mesh.materials.insert(mesh.materials.end(), other.materials.begin(), other.materials.end());
}

bool is_closed_manifold(const ColouredMesh& mesh) {
  std::map<std::pair<int, int>, int> directed;
  std::vector<std::map<int, int>> fan(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++directed[{t[i], t[(i + 1) % 3]}];
      fan[static_cast<std::size_t>(t[i])][t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
  }
  for (const auto& [edge, count] : directed) {
    const auto back = directed.find({edge.second, edge.first});
    if (count != 1 || back == directed.end() || back->second != 1) return false;
  }
  return std::all_of(fan.begin(), fan.end(), [](const std::map<int, int>& next) {
    if (next.empty()) return true;
    std::size_t steps = 0;
    int v = next.begin()->first;
    do {
      v = next.at(v);
      ++steps;
    } while (v != next.begin()->first && steps <= next.size());
    return steps == next.size();
  });
}

}  // namespace rinkaku::recordings
