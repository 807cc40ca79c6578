#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "pipeline/gl/target.h"
#include "pipeline/passes/drawn_object.h"
#include "pipeline/passes/layer.h"
#include "pipeline/passes/pass.h"
#include "pipeline/passes/scene_pass.h"

namespace rinkaku::passes {

/// An object and the passes that draw it, in order.
struct StyledObject {
  std::unique_ptr<DrawnObject> object;
  std::vector<std::unique_ptr<ObjectPass>> passes;
};

/// Draws all CG objects of a frame, and the passes of the whole scene, into one layer, in the rectangle that they cover
/// and nowhere else.
///
/// Needs the GL context that was current at construction to be current.
class LayerRenderer {
 public:
  /// `picture`: the part of the pinhole picture that can be seen.
  LayerRenderer(std::vector<StyledObject> objects, const PixelRect& picture);

  void add(std::unique_ptr<ScenePass> pass) { scene_passes_.push_back(std::move(pass)); }
  /// Takes over the other's scene passes.
  void take_scene_passes(LayerRenderer& from) { std::swap(scene_passes_, from.scene_passes_); }

  /// Draws what `view` sees. Returns false, leaving `layer` empty, if no object is in the picture.
  bool draw(const View& view, Layer& layer);
  /// Draws the objects alone, into another picture: what a mirror shows.
  bool draw_objects(const View& view, const PixelRect& picture, Layer& layer);

 private:
  struct Visible {
    StyledObject* styled;
    double distance_m;
  };
  PixelRect look_at_objects(const View& view, const PixelRect& picture);
  void begin(const PixelRect& rect);
  void draw_surfaces(const View& view, const PixelRect& rect);
  void draw_edges(const View& view, const PixelRect& rect);
  void read(Layer& layer);
  DrawCall call_for(const View& view, const StyledObject& styled, const PixelRect& rect) const;

  std::vector<StyledObject> objects_;
  PixelRect picture_;
  gl::Target target_;
  std::vector<Visible> visible_;
  std::vector<std::unique_ptr<ScenePass>> scene_passes_;
};

}  // namespace rinkaku::passes
