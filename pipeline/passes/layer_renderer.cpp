#include "pipeline/passes/layer_renderer.h"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

namespace rinkaku::passes {
namespace {

PixelRect grown(const PixelRect& rect, int by_px) {
  return {rect.x_px - by_px, rect.y_px - by_px, rect.width_px + 2 * by_px, rect.height_px + 2 * by_px};
}

}  // namespace

LayerRenderer::LayerRenderer(std::vector<StyledObject> objects, const PixelRect& picture)
    : objects_(std::move(objects)), picture_(picture) {}

DrawCall LayerRenderer::call_for(const View& view, const StyledObject& styled, const PixelRect& rect) const {
  const glm::dmat4& world_from_object = styled.object->shape().world_from_object();
  const glm::dmat4 camera_from_object = to_matrix(view.camera_from_world) * world_from_object;
  return {view, glm::mat4(clip_from_camera(view.camera, rect) * camera_from_object), rect,
          glm::vec2(rect.width_px, rect.height_px),
          static_cast<float>(view.camera.fx_px * styled.object->shape().push_m())};
}

bool LayerRenderer::draw(const View& view, Layer& layer) {
  layer.rect = {};
  visible_.clear();
  for (StyledObject& styled : objects_) {
    const Look& look = styled.object->look(view, picture_);
    if (!look.visible) continue;
    double reach = 0;
    bool leaves_colour = false;
    for (const auto& pass : styled.passes) {
      reach = std::max(reach, pass->reach_px(view));
      leaves_colour = leaves_colour || pass->leaves_colour();
    }
    const PixelRect rect = intersection(grown(look.bounds, static_cast<int>(std::ceil(reach)) + 1), picture_);
    if (rect.empty()) continue;
    if (leaves_colour) layer.rect = united(layer.rect, rect);
    visible_.push_back({&styled, look.distance_m});
  }
  if (layer.rect.empty()) return false;
  std::stable_sort(visible_.begin(), visible_.end(),
                   [](const Visible& a, const Visible& b) { return a.distance_m < b.distance_m; });

  target_.begin(layer.rect.width_px, layer.rect.height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_BLEND);
  for (Visible& v : visible_) {
    v.styled->object->upload();
    const DrawCall call = call_for(view, *v.styled, layer.rect);
    for (auto& pass : v.styled->passes) pass->draw_surface(call);
  }
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (auto v = visible_.rbegin(); v != visible_.rend(); ++v) {
    const DrawCall call = call_for(view, *v->styled, layer.rect);
    // The last pass (a line) lies behind the first (the body).
    for (auto pass = v->styled->passes.rbegin(); pass != v->styled->passes.rend(); ++pass) (*pass)->draw_edges(call);
  }
  layer.rgba.resize(static_cast<std::size_t>(layer.rect.width_px) * layer.rect.height_px * 4);
  target_.read(layer.rect.width_px, layer.rect.height_px, layer.rgba.data());
  return true;
}

}  // namespace rinkaku::passes
