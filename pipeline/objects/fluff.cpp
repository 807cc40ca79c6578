#include "pipeline/objects/fluff.h"

#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "mesh/topology.h"
#include "outline/fluffy/fur_textures.h"
#include "outline/fluffy/pass/fluffy_pass.h"
#include "outline/fluffy/selection.h"
#include "pipeline/objects/texture_file.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

fluffy::TransmissionImage transmission_of(const FluffyScene& scene) {
  const mesh::Texture texture =
      scene.made_texture ? fluffy::fur_texture(*scene.made_texture) : read_texture(scene.texture);
  fluffy::TransmissionOptions options;
  options.threshold = scene.threshold;
  options.keep = scene.keep == FluffyScene::Keep::Above ? fluffy::TransmissionOptions::Keep::Above
                                                        : fluffy::TransmissionOptions::Keep::Below;
  options.layers = scene.layers;
  options.paint = scene.paint == FluffyScene::Paint::Texture ? fluffy::TransmissionOptions::Paint::Texture
                                                             : fluffy::TransmissionOptions::Paint::Tone;
  return fluffy::make_transmission(texture, options, scene.where.c_str());
}

fluffy::CutMethod method_of(FluffyScene::Cut cut) {
  switch (cut) {
    case FluffyScene::Cut::Exact:
    case FluffyScene::Cut::Gpu:
      return fluffy::CutMethod::Exact;
    case FluffyScene::Cut::Regions:
      return fluffy::CutMethod::Regions;
    case FluffyScene::Cut::Nearest:
      return fluffy::CutMethod::Nearest;
    case FluffyScene::Cut::None:
      return fluffy::CutMethod::None;
  }
  return fluffy::CutMethod::None;
}

}  // namespace

Fluff prepare_fluff(const ObjectScene& object, const mesh::Mesh& mesh, const glm::dmat4& world_from_object) {
  const FluffyScene& scene = *object.fluffy;
  fluffy::FrameOptions options = scene.frame;
  if (scene.mesh_coordinates_if_any && !mesh.uvs.empty()) options.coordinates = fluffy::Coordinates::Mesh;
  if (scene.made_texture) {
    options.tile_lengths = fluffy::tuft_width(*scene.made_texture) * fluffy::tufts_across(*scene.made_texture);
  }
  options.coarseness = 0.2;
  Fluff fluff;
  const mesh::Topology topology = mesh::topology(mesh);
  const glm::dmat3 linear(world_from_object);
  fluff.frame = fluffy::make_frame(mesh, topology, linear, options, scene.where.c_str());
  if (object.animation) fluff.moving.emplace(fluff.frame, topology, linear);
  fluff.image = transmission_of(scene);
  return fluff;
}

void thin_line_under_fluff(passes::LineStyle& style, std::vector<float>& factors, const ObjectScene& object,
                           const mesh::Mesh& mesh) {
  constexpr float unseen = 0.002f;  // of a line's width: fainter than 8 bits tell
  const FluffyScene& scene = *object.fluffy;
  if (scene.line == FluffyScene::Line::Body) return;
  const fluffy::Chosen chosen = fluffy::choose(mesh, scene.frame.selection, scene.where.c_str());
  std::vector<std::uint8_t> fluffy(mesh.point_count);
  for (const std::uint32_t f : chosen.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[f][k];
      if (chosen.weights[vertex] > 0) fluffy[mesh.welded[vertex]] = 1;
    }
  }
  if (style.follow) {
    style.follow = [found = std::move(style.follow), fluffy](const passes::LineStyle::Moved& now) {
      found(now);
      for (const std::uint32_t point : now.wanted) {
        if (fluffy[point] != 0) now.factors[point] = unseen;
      }
    };
    return;
  }
  if (factors.empty()) factors.assign(mesh.point_count, 1.0f);
  for (std::size_t p = 0; p < factors.size(); ++p) {
    if (fluffy[p] != 0) factors[p] = unseen;
  }
}

mesh::Box with_fluff(const mesh::Box& body, const Fluff& fluff, const glm::dmat4& world_from_object) {
  // The shortest way a unit of the object's takes in the world is no longer than this, whatever the direction.
  const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(world_from_object));
  double units_per_m = 0;
  for (int axis = 0; axis < 3; ++axis) units_per_m += glm::length(object_from_world[axis]);
  // The tips hang down by up to two lengths.
  const auto reach = static_cast<float>(3 * fluff.frame.longest_m * units_per_m);
  return {body.min - reach, body.max + reach};
}

void add_fluff(passes::StyledObject& styled, const Fluff& fluff, const ObjectScene& object, const LightScene& light) {
  const FluffyScene& scene = *object.fluffy;
  fluffy::FluffyOptions options;
  options.cut.method = method_of(scene.cut);
  options.cut_on_gpu = scene.cut == FluffyScene::Cut::Gpu;
  options.cut.sine = fluffy::band_sine(scene.angle_deg * std::numbers::pi / 180);
  options.hang = {0, 0, static_cast<float>(-scene.hang)};
  if (scene.paint == FluffyScene::Paint::Own) options.colour = colour(scene.colour);
  if (scene.paint == FluffyScene::Paint::Texture) options.colour = glm::vec3(1);
  if (object.outline && scene.line == FluffyScene::Line::Rim) {
    options.rim.emplace();
    options.rim->width_px = static_cast<float>(object.outline->width_px);
    options.rim->width_m = static_cast<float>(object.outline->width_m.value_or(0));
    options.rim->least_px = static_cast<float>(object.outline->min_px);
    options.rim->most_px = static_cast<float>(object.outline->max_px);
    options.rim->colour = colour(object.outline->colour);
  }
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  auto pass = std::make_unique<fluffy::FluffyPass>(*styled.object, fluff.frame, fluff.image, options);
  if (fluff.moving) pass->follow(*fluff.moving);
  // Edges are drawn from the list's end on.
  const bool under_line = object.outline && scene.line == FluffyScene::Line::Body;
  styled.passes.insert(under_line ? styled.passes.end() : styled.passes.begin(), std::move(pass));
}

}  // namespace rinkaku::pipeline
