#include "pipeline/objects/lone_mesh.h"

#include <utility>
#include <vector>

#include "pipeline/objects/outline_passes.h"
#include "pipeline/passes/toon/band_borders.h"

namespace rinkaku::pipeline {

std::unique_ptr<passes::LayerRenderer> lone_mesh(const mesh::Mesh& mesh, const glm::dmat4& world_from_mesh,
                                                 const passes::ToonOptions& toon,
                                                 const std::optional<OutlineScene>& line,
                                                 const passes::PixelRect& picture, const LoneMotion& motion) {
  passes::StyledObject styled;
  passes::ObjectShape shape(mesh, world_from_mesh, passes::band_borders(mesh, world_from_mesh, toon));
  if (motion.rig != nullptr) shape.animate(mesh, *motion.rig, motion.playback);
  styled.object = std::make_unique<passes::DrawnObject>(std::move(shape));
  styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, mesh, toon));
  if (line) {
    std::vector<float> factors;
    add_outline(
        styled, mesh, *line,
        line_style(mesh, *line, {.world_from_object = world_from_mesh, .moves = motion.rig != nullptr}, factors));
  }
  std::vector<passes::StyledObject> objects;
  objects.push_back(std::move(styled));
  return std::make_unique<passes::LayerRenderer>(std::move(objects), picture);
}

}  // namespace rinkaku::pipeline
