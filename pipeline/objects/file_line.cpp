#include "pipeline/objects/file_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/frame/srgb.h"
#include "pipeline/track/camera_file.h"

namespace rinkaku::pipeline {
namespace {

using mesh::MaterialLine;
using Unit = MaterialLine::Unit;

bool has_line(const mesh::Material& material) {
  return material.line && material.line->unit != Unit::None && material.line->width > 0;
}

// The surface's own colour, linear: the mean of its texture, where that isn't transparent.
glm::vec3 surface_colour(const mesh::Mesh& mesh, const mesh::Material& material) {
  glm::vec3 colour(1);
  for (int k = 0; k < 3; ++k) colour[k] = linear_from_srgb(material.base_colour[k]);
  if (material.texture < 0) return colour;
  const std::vector<std::uint8_t>& rgba = mesh.textures[static_cast<std::size_t>(material.texture)].rgba;
  glm::vec3 sum(0);
  float covered = 0;
  constexpr std::size_t step = 4 * 7;  // every seventh texel is enough for a mean
  for (std::size_t i = 0; i + 3 < rgba.size(); i += step) {
    const float alpha = static_cast<float>(rgba[i + 3]) / 255;
    for (int k = 0; k < 3; ++k)
      sum[k] += alpha * linear_from_srgb(static_cast<float>(rgba[i + static_cast<std::size_t>(k)]) / 255);
    covered += alpha;
  }
  return covered > 0 ? colour * sum / covered : colour;
}

// The line's colour, mixed with the surface's as far as the file asks for: c (1 - m + m s), in linear light.
glm::vec3 ink_of(const mesh::Mesh& mesh, const mesh::Material& material) {
  const MaterialLine& line = *material.line;
  if (!(line.lit > 0)) return line.colour;
  const glm::vec3 surface = surface_colour(mesh, material);
  glm::vec3 ink;
  for (int k = 0; k < 3; ++k)
    ink[k] = srgb_from_linear(linear_from_srgb(line.colour[k]) * (1 - line.lit + line.lit * surface[k]));
  return ink;
}

// Of the material that covers most triangles, of those that have a line.
glm::vec3 most_common_ink(const mesh::Mesh& mesh) {
  std::vector<std::uint64_t> triangles(mesh.materials.size(), 0);
  for (const mesh::Part& part : mesh.parts) triangles[part.material] += part.triangle_count;
  const mesh::Material* found = nullptr;
  std::uint64_t most = 0;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    if (!has_line(mesh.materials[m]) || triangles[m] <= most) continue;
    most = triangles[m];
    found = &mesh.materials[m];
  }
  return found != nullptr ? ink_of(mesh, *found) : glm::vec3(0);
}

void take_width(OutlineScene& outline, const mesh::Mesh& mesh, Unit unit, double unit_m,
                const std::filesystem::path& camera) {
  float widest = 0;
  for (const mesh::Material& material : mesh.materials) {
    if (has_line(material) && material.line->unit == unit) widest = std::max(widest, material.line->width);
  }
  if (unit == Unit::Metres) {
    outline.width_m = std::min(widest * unit_m, most_line_m);
  } else {
    outline.width_px = std::min(static_cast<double>(widest) * track::read_camera(camera).height_px, most_line_px);
  }
  if (!pushes_contour(outline.method)) return;
  if (!mesh.uvs.empty()) {
    for (const mesh::Material& material : mesh.materials) {
      if (has_line(material) && material.line->width_texture >= 0) outline.weight.file_maps = true;
    }
  }
  bool even = true;
  for (const mesh::Material& material : mesh.materials) {
    double part = 0;
    if (has_line(material)) part = material.line->unit == unit ? material.line->width / widest : 1.0;
    outline.weight.of_file.push_back(part);
    even = even && part == 1;
  }
  if (even) outline.weight.of_file.clear();
}

}  // namespace

ObjectScene with_file_line(ObjectScene object, const mesh::Mesh& mesh, double unit_m,
                           const std::filesystem::path& camera) {
  if (!object.outline) return object;
  std::uint64_t metres = 0, heights = 0;
  for (const mesh::Part& part : mesh.parts) {
    const mesh::Material& material = mesh.materials[part.material];
    if (!has_line(material)) continue;
    (material.line->unit == Unit::Metres ? metres : heights) += part.triangle_count;
  }
  if (metres + heights == 0) return object;
  const Unit unit = metres >= heights ? Unit::Metres : Unit::PictureHeights;
  if (!object.outline->own_width) take_width(*object.outline, mesh, unit, unit_m, camera);
  if (!object.outline->own_colour) {
    const glm::vec3 ink = most_common_ink(mesh);
    object.outline->colour = {ink.r, ink.g, ink.b};
  }
  return object;
}

}  // namespace rinkaku::pipeline
