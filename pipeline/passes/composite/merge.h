#pragma once

#include <span>
#include <vector>

#include "pipeline/frame/matte.h"
#include "pipeline/passes/layer.h"

namespace rinkaku::passes {

/// Puts CG layers and filmed things in their order of depth and leaves one layer to be laid over the plate.
///
/// From far to near: each layer covers what lies behind it, each filmed thing covers it by its matte. Where a matte is
/// opaque the result is empty, so that the plate's own samples stay; along its soft edge the thing's own colour is laid
/// atop the CG (Porter and Duff, "Compositing digital images", 1984): out = (1 - alpha) CG + alpha_CG alpha own.
/// So no colour of the filmed background shows between the thing and the CG behind it. A matte's line lies between the
/// thing and all that is behind it.
struct MergeInput {
  /// Nearest first. layers[i] lies before mattes[i], the last one behind all: one more than mattes. Empty ones are
  /// allowed.
  std::span<const Layer> layers;
  std::span<const Matte> mattes;  ///< nearest first, of one size
  /// False leaves out the things' own colours: CG on nothing, cut by the mattes.
  bool own_colours = true;
};

/// `out.rect` becomes the union of the layers' and lines' rectangles; its memory is reused. Layers must lie inside the
/// picture. Cost: a few passes over that rectangle, about 1 ns a pixel and layer.
void merge(const MergeInput& input, Layer& out);

/// Puts the opaque `world`, which covers all of `layer`, behind it.
void put_behind(const Layer& world, Layer& layer, Layer& scratch);

/// Multiplies a layer by an opacity of 0 to 1.
void fade(Layer& layer, double opacity);

}  // namespace rinkaku::passes
