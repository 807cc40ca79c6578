#include "pipeline/passes/layer_renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/matrix.hpp>

namespace rinkaku::passes {
namespace {

PixelRect grown(const PixelRect& rect, int by_px) {
  return {rect.x_px - by_px, rect.y_px - by_px, rect.width_px + 2 * by_px, rect.height_px + 2 * by_px};
}

// Clamped, what lies before the near plane isn't cut off but hides everything.
void clamp_depth(bool on) { (on ? glEnable : glDisable)(GL_DEPTH_CLAMP); }

// Surfaces that pass through a cut are drawn from a little before it, so that the nearer slice's part hides the seam:
// along an edge that both leave, pixels that a lens covers in part would let shine through what lies behind. With a
// lens it is 1.5 pixels of a floor that lies a quarter of the focal length under the horizon; without, what GL rounds.
double before_cut_m(double cut_m, const CameraModel& camera) {
  constexpr double lens_px = 6, rounding_px = 0.1, most = 0.1;
  return cut_m * (1 - std::min((camera.has_distortion() ? lens_px : rounding_px) / camera.fx_px, most));
}

// Premultiplied, over what is there; without colour of its own it only covers that.
void blend_over(bool coloured) { glBlendFunc(coloured ? GL_ONE : GL_ZERO, GL_ONE_MINUS_SRC_ALPHA); }

}  // namespace

LayerRenderer::LayerRenderer(std::vector<StyledObject> objects, const PixelRect& picture)
    : objects_(std::move(objects)), picture_(picture) {}

DrawCall LayerRenderer::call_for(const View& view, const StyledObject& styled, const PixelRect& rect, Ink ink) const {
  const glm::dmat4& world_from_object = styled.object->shape().world_from_object();
  const glm::dmat4 camera_from_object = to_matrix(view.camera_from_world) * world_from_object;
  return {view,
          glm::mat4(clip_from_view(view, rect) * camera_from_object),
          rect,
          glm::vec2(rect.width_px, rect.height_px),
          static_cast<float>(view.camera.fx_px * styled.object->shape().push_m()),
          static_cast<float>(view.nearest_m),
          ink == Ink::Lines};
}

// Finds what is in the picture, nearest first.
void LayerRenderer::look_at_objects(const View& view, const PixelRect& picture) {
  visible_.clear();
  for (StyledObject& styled : objects_) {
    const Look& look = styled.object->look(view, picture);
    if (!look.visible) continue;
    double reach = 0;
    bool leaves_colour = false;
    for (const auto& pass : styled.passes) {
      reach = std::max(reach, pass->reach_px(view));
      leaves_colour = leaves_colour || pass->leaves_colour();
    }
    const PixelRect rect = intersection(grown(look.bounds, static_cast<int>(std::ceil(reach)) + 1), picture);
    if (!rect.empty()) visible_.push_back({&styled, &look, rect, leaves_colour, false});
  }
  std::stable_sort(visible_.begin(), visible_.end(),
                   [](const Visible& a, const Visible& b) { return a.look->distance_m < b.look->distance_m; });
}

PixelRect LayerRenderer::covered(const Slice& slice) const {
  PixelRect rect;
  for (const Visible& v : visible_) {
    if (v.leaves_colour && slice.holds(v)) rect = united(rect, v.rect);
  }
  return rect;
}

void LayerRenderer::begin(const PixelRect& rect, const Slice& slice) {
  // Depth is near / Z, and greater depth wins: cleared to the far cut's, it keeps out what lies behind.
  target_.begin(rect.width_px, rect.height_px, empty_depth(slice));
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_BLEND);
}

void LayerRenderer::draw_surfaces(const View& view, const PixelRect& rect, const Slice& slice, Ink ink) {
  for (Visible& v : visible_) {
    if (!slice.holds(v)) continue;
    if (!v.uploaded) v.styled->object->upload();
    v.uploaded = true;
    const DrawCall call = call_for(view, *v.styled, rect, ink);
    clamp_depth(!v.leaves_colour);
    for (auto& pass : v.styled->passes) {
      const bool hides = ink == Ink::Lines && !pass->draws_lines();
      if (hides) glEnable(GL_BLEND), glBlendFunc(GL_ZERO, GL_ZERO);
      pass->draw_surface(call);
      if (hides) glDisable(GL_BLEND);
    }
  }
  clamp_depth(false);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  blend_over(ink == Ink::All);
}

void LayerRenderer::look_behind(const View& view, const PixelRect& rect, const Slice& slice) {
  for (const Visible& v : visible_) {
    if (!slice.holds(v)) continue;
    DrawCall call = call_for(view, *v.styled, rect, Ink::All);
    call.depths = target_.depth_texture();
    call.empty_depth = static_cast<float>(empty_depth(slice));
    for (auto& pass : v.styled->passes) pass->look_behind(call);
  }
}

void LayerRenderer::draw_edges(const View& whole_view, const PixelRect& rect, const Slice& slice, Ink ink) {
  glDepthMask(GL_FALSE);
  // What isn't opaque begins at the cut itself, as it would be seen twice; the depths are those of the surfaces.
  View beyond = whole_view;
  beyond.nearest_m = slice.cut_m;
  for (auto v = visible_.rbegin(); v != visible_.rend(); ++v) {
    if (!slice.holds(*v)) continue;
    const DrawCall call = call_for(v->leaves_colour ? beyond : whole_view, *v->styled, rect, ink);
    glDepthRange(0, v->leaves_colour ? slice.near_m / slice.cut_m : 1);
    clamp_depth(!v->leaves_colour);
    // The last pass (a line) lies behind the first (the body).
    for (auto pass = v->styled->passes.rbegin(); pass != v->styled->passes.rend(); ++pass) {
      blend_over(ink == Ink::All || (*pass)->draws_lines());
      (*pass)->draw_edges(call);
    }
  }
  clamp_depth(false);
  glDepthRange(0, 1);
  blend_over(ink == Ink::All);
}

void LayerRenderer::read(Layer& layer) {
  layer.rgba.resize(static_cast<std::size_t>(layer.rect.width_px) * layer.rect.height_px * 4);
  target_.read(layer.rect.width_px, layer.rect.height_px, layer.rgba.data());
}

void LayerRenderer::read_depth(const Slice& slice, const PixelRect& rect, DepthLayer& depth) {
  depth.rect = rect;
  depth.depth_m.resize(static_cast<std::size_t>(rect.width_px) * rect.height_px);
  target_.read_depth(rect.width_px, rect.height_px, depth.depth_m.data());
  const auto near = static_cast<float>(slice.near_m), cleared = static_cast<float>(empty_depth(slice));
  for (float& value : depth.depth_m) value = value > cleared ? near / value : 0;
}

bool LayerRenderer::draw(const View& view, std::span<const double> cuts_m, std::span<Layer> layers,
                         std::span<LayerParts> parts) {
  assert(layers.size() == cuts_m.size() + 1);
  assert(parts.empty() || parts.size() == layers.size());
  PixelRect scene_rect;
  for (auto& pass : scene_passes_) scene_rect = united(scene_rect, pass->look(view, picture_));
  look_at_objects(view, picture_);
  bool drawn = false;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double cut_m = i == 0 ? near_m : std::max(near_m, cuts_m[i - 1]);
    const Slice slice{cut_m, i == 0 ? near_m : std::max(near_m, before_cut_m(cut_m, view.camera)),
                      i < cuts_m.size() ? cuts_m[i] : std::numeric_limits<double>::infinity()};
    drawn = draw_slice(view, slice, scene_rect, layers[i], parts.empty() ? nullptr : &parts[i]) || drawn;
  }
  return drawn;
}

bool LayerRenderer::draw_slice(const View& whole_view, const Slice& slice, const PixelRect& scene_rect, Layer& layer,
                               LayerParts* parts) {
  layer.rect = united(scene_rect, covered(slice));
  if (parts != nullptr) parts->lines.rect = parts->depth.rect = layer.rect;
  if (layer.rect.empty()) return false;
  View view = whole_view;
  view.nearest_m = slice.near_m;
  for (auto& pass : scene_passes_) pass->draw_aside(view, layer.rect);
  draw_all(view, slice, Ink::All, layer);
  if (parts == nullptr) return true;
  read_depth(slice, layer.rect, parts->depth);
  draw_all(view, slice, Ink::Lines, parts->lines);
  return true;
}

void LayerRenderer::draw_all(const View& view, const Slice& slice, Ink ink, Layer& layer) {
  begin(layer.rect, slice);
  draw_surfaces(view, layer.rect, slice, ink);
  for (auto& pass : scene_passes_) pass->draw(view, layer.rect);
  look_behind(view, layer.rect, slice);
  draw_edges(view, layer.rect, slice, ink);
  for (auto& pass : scene_passes_) pass->draw_over(view, layer.rect);
  read(layer);
}

bool LayerRenderer::draw_objects(const View& view, const PixelRect& picture, Layer& layer) {
  constexpr Slice all{near_m, near_m, std::numeric_limits<double>::infinity()};
  look_at_objects(view, picture);
  layer.rect = covered(all);
  if (layer.rect.empty()) return false;
  begin(layer.rect, all);
  draw_surfaces(view, layer.rect, all, Ink::All);
  look_behind(view, layer.rect, all);
  draw_edges(view, layer.rect, all, Ink::All);
  read(layer);
  return true;
}

}  // namespace rinkaku::passes
