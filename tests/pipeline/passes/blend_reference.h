#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/passes/layer.h"

// A second way of blending to compare with: every component of every pixel by itself, in double, from the formulas of
// ITU-T H.273 and nothing else.
namespace rinkaku::test {

/// A picture format by FFmpeg's name for its samples.
PictureFormat picture_format(const std::string& name, int width_px, int height_px, int matrix, ColourTags::Range range);

/// Bytes that one sample takes.
int sample_bytes(const Component& component);

/// The code value at (x, y) of a component's own grid.
int sample(const Frame& frame, int component, int x, int y);
void set_sample(Frame& frame, int component, int x, int y, int value);

/// All bytes of a frame's planes, the gaps between rows included.
std::vector<std::uint8_t> all_bytes(const Frame& frame);

/// A frame whose every byte is random, also those that hold no sample.
Frame random_frame(FramePool& pool, const PictureFormat& format, std::mt19937& random);

/// A premultiplied layer: a third of its pixels nothing, a third opaque, the rest anything; some rows quite empty.
passes::Layer random_layer(const passes::PixelRect& rect, std::mt19937& random);

passes::Layer even_layer(const passes::PixelRect& rect, int r, int g, int b, int a);

struct Mean {
  double r = 0, g = 0, b = 0, a = 0;  // premultiplied, 0 to 1
};

/// The layer's mean over the pixels of the picture that share sample (x, y) of a component.
Mean layer_mean(const PictureFormat& format, const passes::Layer& layer, int component, int x, int y);

/// What a component of a premultiplied colour is in code values; `matrix` and `full` already decided.
double code_value(const PictureFormat& format, int component, const Mean& m, int matrix, bool full);

}  // namespace rinkaku::test
