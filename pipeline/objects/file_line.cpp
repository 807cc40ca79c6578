#include "pipeline/objects/file_line.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/track/camera_file.h"

namespace rinkaku::pipeline {
namespace {

using mesh::MaterialLine;
using Unit = MaterialLine::Unit;

bool has_line(const mesh::Material& material) {
  return material.line && material.line->unit != Unit::None && material.line->width > 0;
}

// The line of the material that covers most triangles, of those that have one.
MaterialLine most_common(const mesh::Mesh& mesh) {
  std::vector<std::uint64_t> triangles(mesh.materials.size(), 0);
  for (const mesh::Part& part : mesh.parts) triangles[part.material] += part.triangle_count;
  MaterialLine found;
  std::uint64_t most = 0;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    if (!has_line(mesh.materials[m]) || triangles[m] <= most) continue;
    most = triangles[m];
    found = *mesh.materials[m].line;
  }
  return found;
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
  if (!can_weigh(outline.method)) return;
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
    const glm::vec3 ink = most_common(mesh).colour;
    object.outline->colour = {ink.r, ink.g, ink.b};
  }
  return object;
}

}  // namespace rinkaku::pipeline
