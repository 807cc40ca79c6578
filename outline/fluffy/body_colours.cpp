#include "outline/fluffy/body_colours.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::fluffy {
namespace {

// Its nearest texel; textures repeat.
glm::vec4 texel_at(const mesh::Texture& texture, const glm::vec2& uv) {
  const auto place = [](float along, int size_px) {
    const float within = along - std::floor(along);
    return std::clamp(static_cast<int>(within * static_cast<float>(size_px)), 0, size_px - 1);
  };
  const int x = place(uv.x, texture.width_px), y = place(uv.y, texture.height_px);
  const std::uint8_t* rgba = texture.rgba.data() + (static_cast<std::size_t>(y) * texture.width_px + x) * 4;
  return glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0f;
}

struct Sum {
  glm::vec4 colour{0};
  float count = 0;
};

}  // namespace

std::vector<glm::vec4> body_colours(const mesh::Mesh& mesh) {
  std::vector<Sum> sums(mesh.positions.size());
  for (const mesh::Part& part : mesh.parts) {
    const mesh::Material& material = mesh.materials[part.material];
    const mesh::Texture* texture =
        material.texture >= 0 && !mesh.uvs.empty() ? &mesh.textures[material.texture] : nullptr;
    for (std::uint32_t f = part.first_triangle; f < part.first_triangle + part.triangle_count; ++f) {
      const glm::uvec3& t = mesh.triangles[f];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = t[k];
        glm::vec4 colour = material.base_colour;
        if (!mesh.colours.empty()) colour *= mesh.colours[v];
        if (texture != nullptr) {
          const glm::vec2 here = mesh.uvs[v], left = mesh.uvs[t[(k + 1) % 3]], right = mesh.uvs[t[(k + 2) % 3]];
          glm::vec4 mean(0);
          for (const glm::vec2& weights : {glm::vec2(0.1f, 0.1f), glm::vec2(0.3f, 0.1f), glm::vec2(0.1f, 0.3f)}) {
            mean += texel_at(*texture, here + (left - here) * weights.x + (right - here) * weights.y);
          }
          colour *= mean / 3.0f;
        }
        sums[v].colour += colour;
        sums[v].count += 1;
      }
    }
  }
  std::vector<glm::vec4> colours(sums.size(), glm::vec4(1));
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (sums[v].count > 0) colours[v] = sums[v].colour / sums[v].count;
  }
  return colours;
}

}  // namespace rinkaku::fluffy
