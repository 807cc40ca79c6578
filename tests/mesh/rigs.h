#pragma once

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "mesh/assemble.h"
#include "mesh/skin.h"
#include "mesh/topology.h"
#include "tests/mesh/shapes.h"

// Meshes that move in ways that are known.
namespace rinkaku::test {

struct Rigged {
  mesh::Mesh mesh;
  mesh::Rig rig;
};

inline Rigged assembled(mesh::Soup soup) {
  mesh::Assembled whole = mesh::assemble(std::move(soup), 180);
  return {std::move(whole.mesh), std::move(whole.rig)};
}

/// Every vertex of the soup carried by one node that stands at `object_from_node` at rest.
inline Rigged on_one_node(mesh::Soup soup, const glm::mat4& object_from_node = glm::mat4(1)) {
  mesh::Rig& rig = soup.rig;
  rig.nodes.push_back({"root", mesh::RigNode::kNoParent, object_from_node});
  rig.joints.push_back({0, glm::mat4(1)});
  rig.bind_points = soup.positions;
  for (glm::vec3& p : soup.positions) p = glm::vec3(object_from_node * glm::vec4(p, 1));
  for (std::uint32_t v = 0; v < rig.bind_points.size(); ++v) {
    rig.first_influence.push_back(v);
    rig.influences.push_back({0, 1.0f});
  }
  rig.first_influence.push_back(static_cast<std::uint32_t>(rig.bind_points.size()));
  return assembled(std::move(soup));
}

template <typename Value>
mesh::Keys<Value> key(const Value& value) {
  return {{0.0f}, {value}};
}

/// An animation of one moment, in which node `node` stands so.
inline mesh::Animation still(std::uint32_t node, const glm::vec3& position, const glm::quat& rotation,
                             const glm::vec3& scale) {
  mesh::Animation animation{"still", 1, {}, {}};
  animation.tracks.push_back({node, key(position), key(rotation), key(scale)});
  return animation;
}

/// How the upper bone of the bending cylinder shares a point at height y: 0 below, 1 above, smooth between.
inline float bend_weight(float y) {
  const float t = std::min(std::max((y - 0.5f) / 1.0f, 0.0f), 1.0f);
  return t * t * (3 - 2 * t);
}

/// A closed cylinder about y with round caps' rims left hard: radius 0.3, from 0 to 2, and two bones that meet at 1.
/// Its clip "bend" turns the upper one about z by 90 degrees within a second, evenly, and "twist" about y by 180.
inline mesh::Soup bending_cylinder_soup(int around, int along) {
  mesh::Soup soup;
  for (int row = 0; row <= along; ++row) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      soup.positions.emplace_back(0.3 * std::cos(angle), 2.0 * row / along, -0.3 * std::sin(angle));
    }
  }
  const auto at = [&](int row, int k) { return static_cast<std::uint32_t>(row * around + k % around); };
  for (int row = 0; row < along; ++row) {
    for (int k = 0; k < around; ++k) {
      soup.triangles.emplace_back(at(row, k), at(row, k + 1), at(row + 1, k + 1));
      soup.triangles.emplace_back(at(row, k), at(row + 1, k + 1), at(row + 1, k));
    }
  }
  const auto bottom = static_cast<std::uint32_t>(soup.positions.size()), top = bottom + 1;
  soup.positions.insert(soup.positions.end(), {{0, 0, 0}, {0, 2, 0}});
  for (int k = 0; k < around; ++k) {
    soup.triangles.emplace_back(bottom, at(0, k + 1), at(0, k));
    soup.triangles.emplace_back(top, at(along, k), at(along, k + 1));
  }
  mesh::Rig& rig = soup.rig;
  rig.nodes = {{"lower", mesh::RigNode::kNoParent, glm::mat4(1)},
               {"upper", 0, glm::translate(glm::mat4(1), glm::vec3(0, 1, 0))}};
  rig.joints = {{0, glm::mat4(1)}, {1, glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))}};
  rig.bind_points = soup.positions;
  rig.first_influence.push_back(0);
  for (const glm::vec3& p : soup.positions) {
    const float upper = bend_weight(p.y);
    if (upper < 1) rig.influences.push_back({0, 1 - upper});
    if (upper > 0) rig.influences.push_back({1, upper});
    rig.first_influence.push_back(static_cast<std::uint32_t>(rig.influences.size()));
  }
  const auto turning = [](const char* name, const glm::vec3& axis, float degrees) {
    mesh::Animation clip{name, 1, {}, {}};
    mesh::NodeTrack track{1, key(glm::vec3(0, 1, 0)), {}, key(glm::vec3(1))};
    for (int i = 0; i <= 4; ++i) {
      track.rotation.times_s.push_back(static_cast<float>(i) / 4);
      track.rotation.values.push_back(glm::angleAxis(glm::radians(degrees) * static_cast<float>(i) / 4, axis));
    }
    clip.tracks.push_back(track);
    return clip;
  };
  rig.animations = {turning("bend", {0, 0, 1}, 90), turning("twist", {0, 1, 0}, 180)};
  return one_part(std::move(soup));
}
inline Rigged bending_cylinder(int around, int along) { return assembled(bending_cylinder_soup(around, along)); }

/// A mesh as a skin has posed it, to be taken for one that stands so.
inline mesh::Mesh posed(const mesh::Mesh& mesh, const mesh::Skin& skin) {
  mesh::Mesh standing = mesh;
  for (std::size_t v = 0; v < standing.positions.size(); ++v) standing.positions[v] = skin.points()[mesh.welded[v]];
  standing.normals.assign(skin.normals().begin(), skin.normals().end());
  return standing;
}

}  // namespace rinkaku::test
