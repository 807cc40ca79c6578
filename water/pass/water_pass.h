#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "pipeline/gl/buffer.h"
#include "pipeline/gl/handle.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_target.h"
#include "pipeline/passes/scene_pass.h"
#include "water/brushes.h"
#include "water/pass/stroke_quads.h"
#include "water/reference_picture.h"
#include "water/strokes.h"
#include "water/surface.h"

namespace rinkaku::water {

/// What is painted of one surface in a frame: strokes within its border, and strokes over everything.
struct PaintedSurface {
  const Surface* surface = nullptr;
  std::span<const Stroke> strokes;
  const ReferencePicture* ground = nullptr;  ///< what shows between the strokes; null: what lies below
  float ground_opacity = 0;
};

/// Draws painted water into the layer. Strokes go into a picture of their own, one over another; the surface's
/// triangles then lay that picture into the layer, at their depth: objects hide water and water hides what is below it.
/// Strokes over everything (waterlines, spray) are tested against the depth of all the rest.
///
/// The border's edges get a feather a pixel wide. Needs the GL context that was current at construction.
class WaterPass : public passes::ScenePass {
 public:
  /// `lines` are for strokes over everything, and for those on surfaces unless there are brushes of the user's `own`,
  /// at most four, which are blended.
  WaterPass(const BrushSheet& lines, const BrushSheet& drops, const BrushSheet& own = {});

  /// What the next look() shows; the spans must stay valid until it has been drawn. `drops` use the second sheet.
  void show(std::span<const PaintedSurface> surfaces, std::span<const Stroke> over, std::span<const Stroke> drops);

  passes::PixelRect look(const passes::View& view, const passes::PixelRect& picture) override;
  void draw_aside(const passes::View& view, const passes::PixelRect& rect) override;
  void draw(const passes::View& view, const passes::PixelRect& rect) override;
  void draw_over(const passes::View& view, const passes::PixelRect& rect) override;

 private:
  struct Corner {  // of a surface's triangle or feather
    glm::vec2 at{0};
    glm::vec2 outwards{0};  // in the plane; 0 but for a feather's rim
  };

  Brushes lines_, drops_;
  std::optional<Brushes> own_;
  StrokeQuads quads_;
  std::optional<StrokeQuads> own_quads_;
  gl::Program surface_program_;
  gl::VertexArrayHandle surface_array_;
  gl::StreamBuffer surface_buffer_;
  struct Ground {
    gl::TextureHandle texture;
    const ReferencePicture* of = nullptr;  // which picture the texture holds, in which version
    int width_px = 0, height_px = 0, version = -1;
  };
  void upload_ground(const ReferencePicture& picture, Ground& ground);

  std::vector<gl::TextureTarget> targets_;  // of each surface
  std::vector<Ground> grounds_;             // likewise
  std::vector<std::uint8_t> ground_texels_;
  std::vector<PaintedSurface> shown_;
  std::span<const Stroke> over_, drops_shown_;
  std::vector<Corner> corners_;
  GLint clip_from_surface_ = -1, viewport_px_ = -1, ground_opacity_ = -1, ground_place_ = -1;
};

}  // namespace rinkaku::water
