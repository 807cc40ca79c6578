#include "pipeline/passes/toon/band_borders.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::passes {

std::vector<std::uint8_t> band_borders(const mesh::Mesh& mesh, const glm::dmat4& world_from_object,
                                       const ToonOptions& options) {
  if (options.bands <= 1) return {};
  const glm::mat3 world_from_normal(glm::transpose(glm::inverse(glm::dmat3(world_from_object))));
  const glm::vec3 light = glm::normalize(options.light);
  const auto bands = static_cast<float>(options.bands);
  std::vector<float> brightness(mesh.normals.size());
  for (std::size_t v = 0; v < brightness.size(); ++v) {
    brightness[v] = (glm::dot(glm::normalize(world_from_normal * mesh.normals[v]), light) * 0.5f + 0.5f) * bands;
  }
  // Whether one of the borders 1 .. bands - 1 lies between the two.
  const auto crossed = [bands](float least, float most) {
    const float border = std::max(std::ceil(least), 1.0f);
    return border <= std::min(most, bands - 1);
  };
  // Of the corners' spread: so that a border's smooth pixel lies in triangles that are kept, and that the shader's
  // rounding does not matter.
  constexpr float margin = 0.25f;
  std::vector<std::uint8_t> on_border(mesh.triangles.size());
  for (std::size_t f = 0; f < on_border.size(); ++f) {
    const glm::uvec3& t = mesh.triangles[f];
    const auto [low, high] = std::minmax({brightness[t.x], brightness[t.y], brightness[t.z]});
    const float more = margin * (high - low) + 1e-4f;
    const bool front = crossed(low - more, high + more);
    // Seen from behind, a two-sided triangle is as bright as it is dark from the front.
    const bool back = crossed(bands - high - more, bands - low + more);
    on_border[f] = front || back ? 1 : 0;
  }
  return on_border;
}

}  // namespace rinkaku::passes
