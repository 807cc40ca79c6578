#include "pipeline/objects/line_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <glm/common.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/objects/texture_file.h"

namespace rinkaku::pipeline {
namespace {

// Multiplies each point's weight by the mean of what its vertices or corners say.
class PointMeans {
 public:
  explicit PointMeans(std::size_t points) : sum_(points, 0.0f), count_(points, 0) {}
  void add(std::uint32_t point, float value) { sum_[point] += value, ++count_[point]; }
  void multiply(std::vector<float>& weights) const {
    for (std::size_t p = 0; p < weights.size(); ++p) {
      if (count_[p] > 0) weights[p] *= sum_[p] / static_cast<float>(count_[p]);
    }
  }

 private:
  std::vector<float> sum_;
  std::vector<int> count_;
};

void weigh_by_paint(const ObjectScene& object, const mesh::Mesh& mesh, std::vector<float>& weights) {
  if (mesh.colours.empty()) {
    throw input_error(object.mesh.string(), "has no vertex colours, which 'paint' of the outline's 'weight' needs",
                      "paint its vertices, or leave 'paint' out");
  }
  PointMeans means(weights.size());
  for (std::size_t v = 0; v < mesh.colours.size(); ++v) {
    means.add(mesh.welded[v], mesh.colours[v][*object.outline->weight.paint]);
  }
  means.multiply(weights);
}

// Of a repeating image, between texels; `value` of a texel's four bytes is what is interpolated.
template <class Value>
float value_at(const mesh::Texture& image, const glm::vec2& uv, Value value) {
  const auto texel = [&](int x, int y) -> float {
    const auto wrap = [](int i, int size) { return static_cast<std::size_t>(((i % size) + size) % size); };
    const auto width = static_cast<std::size_t>(image.width_px);
    return value(image.rgba.data() + (wrap(y, image.height_px) * width + wrap(x, image.width_px)) * 4);
  };
  const glm::vec2 at = glm::fract(uv) * glm::vec2(image.width_px, image.height_px) - 0.5f;
  const glm::vec2 corner = glm::floor(at), part = at - corner;
  const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), part.x),
                  glm::mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
}

void weigh_by_map(const ObjectScene& object, const mesh::Mesh& mesh, std::vector<float>& weights) {
  if (mesh.uvs.empty()) {
    throw input_error(object.mesh.string(), "has no texture coordinates, which 'map' of the outline's 'weight' needs",
                      "unwrap it, or leave 'map' out");
  }
  const mesh::Texture image = read_texture(object.outline->weight.map);
  PointMeans means(weights.size());
  const auto brightness = [](const std::uint8_t* c) { return (0.299f * c[0] + 0.587f * c[1] + 0.114f * c[2]) / 255; };
  for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
    means.add(mesh.welded[v], value_at(image, mesh.uvs[v], brightness));
  }
  means.multiply(weights);
}

// By the width textures that the mesh's materials have in its file.
void weigh_by_file_maps(const mesh::Mesh& mesh, std::vector<float>& weights) {
  PointMeans means(weights.size());
  for (const mesh::Part& part : mesh.parts) {
    const mesh::MaterialLine line = mesh.materials[part.material].line.value_or(mesh::MaterialLine{});
    for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
      const glm::uvec3& triangle = mesh.triangles[part.first_triangle + t];
      for (int k = 0; k < 3; ++k) {
        float value = 1;
        if (line.width_texture >= 0) {
          const auto channel = [&](const std::uint8_t* c) { return static_cast<float>(c[line.width_channel]) / 255; };
          value = value_at(mesh.textures[static_cast<std::size_t>(line.width_texture)], mesh.uvs[triangle[k]], channel);
        }
        means.add(mesh.welded[triangle[k]], value);
      }
    }
  }
  means.multiply(weights);
}

void weigh_by_material(const ObjectScene& object, const mesh::Mesh& mesh, std::vector<float>& weights) {
  const std::vector<double>& of_file = object.outline->weight.of_file;
  std::vector<float> of_material(of_file.begin(), of_file.end());
  of_material.resize(mesh.materials.size(), 1.0f);
  for (const LineWeightScene::OfMaterial& wanted : object.outline->weight.materials) {
    bool found = false;
    std::string names;
    for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
      names += (m > 0 ? ", '" : "'") + mesh.materials[m].name + "'";
      if (mesh.materials[m].name != wanted.name) continue;
      of_material[m] = static_cast<float>(wanted.factor);
      found = true;
    }
    constexpr std::size_t longest = 300;
    if (names.size() > longest) names = names.substr(0, longest) + "...";
    if (!found) {
      throw input_error(object.mesh.string(),
                        "has no material '" + wanted.name + "', which the outline's 'weight' names",
                        "its materials are " + names);
    }
  }
  PointMeans means(weights.size());
  for (const mesh::Part& part : mesh.parts) {
    for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
      const glm::uvec3& triangle = mesh.triangles[part.first_triangle + t];
      for (int k = 0; k < 3; ++k) means.add(mesh.welded[triangle[k]], of_material[part.material]);
    }
  }
  means.multiply(weights);
}

}  // namespace

std::vector<float> line_weights(const ObjectScene& object, const mesh::Mesh& mesh) {
  if (!object.outline) return {};
  const LineWeightScene& scene = object.outline->weight;
  const bool of_materials = !scene.materials.empty() || !scene.of_file.empty();
  if (!scene.paint && scene.map.empty() && !of_materials && !scene.file_maps) return {};
  std::vector<float> weights(mesh.point_count, 1.0f);
  if (scene.paint) weigh_by_paint(object, mesh, weights);
  if (!scene.map.empty()) weigh_by_map(object, mesh, weights);
  if (of_materials) weigh_by_material(object, mesh, weights);
  if (scene.file_maps) weigh_by_file_maps(mesh, weights);
  // A line of no width at all would be a strip without a direction to fade in; this can't be seen.
  constexpr float unseen = 0.002f;
  for (float& weight : weights) weight = std::max(weight, unseen);
  return weights;
}

}  // namespace rinkaku::pipeline
