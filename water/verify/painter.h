#pragma once

#include <vector>

#include "pipeline/passes/layer.h"
#include "pipeline/passes/layer_renderer.h"
#include "water/painting.h"
#include "water/pass/water_pass.h"
#include "water/verify/scenes.h"

namespace rinkaku::water {

/// Paints and draws one water by itself, frame by frame. Needs a GL context, and that what it is given outlives it.
class Painter {
 public:
  Painter(const River& river, const ReferencePicture& reference, const PaintingOptions& options);
  const Strokes& strokes(std::int64_t frame);
  /// Nothing else is in the layer, and no first coat.
  const passes::Layer& draw(const Strokes& strokes);
  const Particles& particles() const { return painting_.particles(); }

 private:
  const River& river_;
  const ReferencePicture& reference_;
  Painting painting_;
  passes::LayerRenderer renderer_;
  WaterPass* pass_;
  passes::Layer layer_;
};

/// A layer over grey, of a camera's whole picture.
void over_grey(const passes::Layer& layer, const CameraModel& camera, std::vector<glm::vec3>& picture);

}  // namespace rinkaku::water
