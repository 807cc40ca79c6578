#pragma once

#include <array>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::recordings {

/// A signed function of space: negative inside, about the distance near the surface.
using Implicit = std::function<float(glm::vec3)>;

/// Distance to an ellipsoid (first order), to a capsule whose radius changes linearly along it.
float ellipsoid(glm::vec3 p, glm::vec3 centre, glm::vec3 radii);
float rounded_cone(glm::vec3 p, glm::vec3 a, glm::vec3 b, float radius_a, float radius_b);
/// Union whose seam is filled over the width `k`; with -a and -b, and negated, an intersection.
float smooth_union(float a, float b, float k);

/// Triangles with a material number each; anticlockwise from outside.
struct ColouredMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< one a position
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> materials;  ///< one a triangle
};

/// The zero set inside [low, high] as a closed mesh of edges about `cell` long: dual vertices of the sign-changing
/// cells, evened out and drawn onto the surface.
ColouredMesh mesh_surface(const Implicit& f, glm::vec3 low, glm::vec3 high, float cell, int material);

/// Gives `material` to the part where region < 0. Triangles on its border are cut along it, so the border is crisp; the
/// mesh stays closed. Only triangles of a material in `from` change (all, if empty).
void paint(ColouredMesh& mesh, const Implicit& region, int material, const std::vector<int>& from = {});

/// Adds the other mesh's triangles as a component of its own.
void append(ColouredMesh& mesh, const ColouredMesh& other);

/// Unit gradient of f by central differences.
glm::vec3 surface_normal(const Implicit& f, glm::vec3 p, float step = 1e-3f);

/// Whether every edge joins exactly two triangles, in opposite directions, and every vertex has one fan of them.
bool is_closed_manifold(const ColouredMesh& mesh);

}  // namespace rinkaku::recordings
