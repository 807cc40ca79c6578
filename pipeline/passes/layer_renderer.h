#pragma once

#include <memory>
#include <vector>

#include "pipeline/gl/target.h"
#include "pipeline/passes/drawn_object.h"
#include "pipeline/passes/layer.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::passes {

/// An object and the passes that draw it, in order.
struct StyledObject {
  std::unique_ptr<DrawnObject> object;
  std::vector<std::unique_ptr<ObjectPass>> passes;
};

/// Draws all CG objects of a frame into one layer, in the rectangle that they cover and nowhere else.
///
/// Needs the GL context that was current at construction to be current.
class LayerRenderer {
 public:
  /// `picture`: the part of the pinhole picture that can be seen.
  LayerRenderer(std::vector<StyledObject> objects, const PixelRect& picture);

  /// Draws what `view` sees. Returns false, leaving `layer` empty, if no object is in the picture.
  bool draw(const View& view, Layer& layer);

 private:
  struct Visible {
    StyledObject* styled;
    double distance_m;
  };
  DrawCall call_for(const View& view, const StyledObject& styled, const PixelRect& rect) const;

  std::vector<StyledObject> objects_;
  PixelRect picture_;
  gl::Target target_;
  std::vector<Visible> visible_;
};

}  // namespace rinkaku::passes
