#include "outline/curvature_colours.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace rinkaku::outline {

glm::vec4 curvature_colour(float multiple_of_k95) {
  // Through a light tone half-way, so that the eye sees even steps where straight lines to white look pale.
  static constexpr glm::vec3 white(0.97f, 0.965f, 0.955f);
  static constexpr glm::vec3 pale_red(0.96f, 0.65f, 0.51f), red(0.75f, 0.05f, 0.13f);
  static constexpr glm::vec3 pale_blue(0.58f, 0.75f, 0.92f), blue(0.08f, 0.27f, 0.68f);
  const float size = std::min(std::abs(multiple_of_k95), 1.0f);
  const bool convex = multiple_of_k95 > 0;
  const glm::vec3 pale = convex ? pale_red : pale_blue, deep = convex ? red : blue;
  return glm::vec4(size < 0.5f ? glm::mix(white, pale, 2 * size) : glm::mix(pale, deep, 2 * size - 1), 1);
}

mesh::Mesh painted_with_curvature(mesh::Mesh mesh, const Curvature& curvature, double k95) {
  mesh.colours.resize(mesh.positions.size());
  const auto per_k95 = static_cast<float>(k95 > 0 ? 1 / k95 : 0);
  for (std::size_t v = 0; v < mesh.colours.size(); ++v) {
    mesh.colours[v] = curvature_colour(curvature.mean[mesh.welded[v]] * per_k95);
  }
  mesh.textures.clear();
  for (mesh::Material& material : mesh.materials) {
    material.base_colour = glm::vec4(1);
    material.texture = -1;
    material.alpha = mesh::Material::Alpha::Opaque;
  }
  return mesh;
}

}  // namespace rinkaku::outline
