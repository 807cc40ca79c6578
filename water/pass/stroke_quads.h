#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pipeline/frame/pixel_rect.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/handle.h"
#include "pipeline/gl/program.h"
#include "water/brush_atlas.h"
#include "water/strokes.h"

namespace rinkaku::water {

/// A sheet's brushes on the GL side.
class Brushes {
 public:
  /// Throws Error (Failure) where there is no memory for them.
  explicit Brushes(const BrushSheet& sheet);
  const BrushAtlas& atlas() const { return atlas_; }
  GLuint texture() const { return texture_.name(); }

 private:
  BrushAtlas atlas_;
  gl::TextureHandle texture_;
};

/// Draws strokes, one after another, as quads with a brush's picture. The corners are found on the CPU, which takes a
/// fiftieth of what GL in software needs to draw them.
class StrokeQuads {
 public:
  /// `own_brushes`: so many of the first brushes (1 to 4) are blended in each stroke by its shares; 0: each stroke has
  /// one.
  explicit StrokeQuads(int own_brushes);
  /// Into the bound target, whose first pixel is that of `rect`; depth is near_m / Z. No allocation once warm.
  void draw(std::span<const Stroke> strokes, const Brushes& brushes, const PixelRect& rect, double near_m);

 private:
  struct Corner {
    glm::vec3 place{0};  // pixel, depth in metres
    glm::vec2 brush{0};  // in the atlas
    std::array<std::uint8_t, 4> colour{}, blend{};
    float next_brush = 0;  // how far it is to the next one
  };
  void add_corners(const Stroke& stroke, const BrushAtlas& atlas);
  void number_corners(std::size_t strokes);

  gl::Program program_;
  GLint rect_px_ = -1, size_px_ = -1, near_m_ = -1;
  gl::VertexArrayHandle array_;
  gl::StreamBuffer buffer_;
  gl::StaticBuffer numbers_;
  std::size_t numbered_ = 0;
  std::vector<Corner> corners_;
};

}  // namespace rinkaku::water
