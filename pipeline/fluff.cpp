#include "pipeline/fluff.h"

#include <numbers>

#include "mesh/topology.h"
#include "outline/fluffy/fur_textures.h"
#include "outline/fluffy/pass/fluffy_pass.h"
#include "outline/fluffy/selection.h"
#include "pipeline/picture_file.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

fluffy::TransmissionImage transmission_of(const FluffyScene& scene) {
  const mesh::Texture texture =
      scene.made_texture ? fluffy::fur_texture(*scene.made_texture) : read_picture(scene.texture);
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
  fluff.frame =
      fluffy::make_frame(mesh, mesh::topology(mesh), glm::dmat3(world_from_object), options, scene.where.c_str());
  fluff.image = transmission_of(scene);
  return fluff;
}

void thin_line_under_fluff(std::vector<float>& factors, const ObjectScene& object, const mesh::Mesh& mesh) {
  constexpr float unseen = 0.002f;  // of a line's width: fainter than 8 bits tell
  if (object.fluffy->line == FluffyScene::Line::Body) return;
  if (factors.empty()) factors.assign(mesh.point_count, 1.0f);
  const FluffyScene& scene = *object.fluffy;
  const fluffy::Chosen chosen = fluffy::choose(mesh, scene.frame.selection, scene.where.c_str());
  for (const std::uint32_t f : chosen.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[f][k];
      if (chosen.weights[vertex] > 0) factors[mesh.welded[vertex]] = unseen;
    }
  }
}

bool fluff_is_under_line(const ObjectScene& object) {
  return object.outline && object.fluffy->line == FluffyScene::Line::Body;
}

std::unique_ptr<passes::ObjectPass> make_fluffy_pass(passes::DrawnObject& drawn, const Fluff& fluff,
                                                     const ObjectScene& object, const LightScene& light) {
  const FluffyScene& scene = *object.fluffy;
  fluffy::FluffyOptions options;
  options.cut.method = method_of(scene.cut);
  options.cut.sine = fluffy::band_sine(scene.angle_deg * std::numbers::pi / 180);
  options.hang = {0, 0, static_cast<float>(-scene.hang)};
  if (scene.paint == FluffyScene::Paint::Own) options.colour = colour(scene.colour);
  if (scene.paint == FluffyScene::Paint::Texture) options.colour = glm::vec3(1);
  if (object.outline && scene.line == FluffyScene::Line::Rim) {
    options.rim.emplace();
    options.rim->width_px = static_cast<float>(object.outline->width_px);
    options.rim->colour = colour(object.outline->colour);
  }
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  return std::make_unique<fluffy::FluffyPass>(drawn, fluff.frame, fluff.image, options);
}

}  // namespace rinkaku::pipeline
