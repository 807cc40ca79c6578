#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "outline/fluffy/cutter.h"
#include "outline/fluffy/draw_order.h"
#include "outline/fluffy/frame.h"
#include "outline/fluffy/transmission.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_array.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::fluffy {

/// A line around the fluff.
struct RimLine {
  float width_px = 3;
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
};

struct FluffyOptions {
  CutOptions cut;
  float fade_from = 0.45f;          ///< 0 to 1: the part of the band in which fluff doesn't fade yet
  glm::vec3 hang{0, 0, -0.25f};     ///< in the world: where the tips hang, in lengths of the fluff
  float foot_shade = 0.88f;         ///< what fluff's colour is multiplied by at the skin
  std::optional<glm::vec3> colour;  ///< sRGB-encoded, instead of the body's
  std::optional<RimLine> rim;
  int bands = 3;                                ///< of light and shade, as the body has them; 0: unlit
  glm::vec3 shade_colour{0.62f, 0.60f, 0.78f};  ///< what the darkest band multiplies the colour by
  glm::vec3 light{-0.4f, 0.5f, 0.8f};           ///< towards the light, in the world; any length
};

/// Draws fluff about an object's contour: the layers of its fluffy frame, covered with a transmission image, near the
/// contour only.
///
/// Layers are blended from back to front (DrawOrder), premultiplied, and hidden by what lies before them; they hide
/// nothing themselves. Opacity falls to nothing where the band ends, so that no triangle shows when it is added or
/// left out: what is drawn does not depend on how the triangles were found.
/// Yamachi, Shindo and Matuda, "Display Method for Fluffy Objects with Extention of Texture Mapping".
class FluffyPass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass. The image is one of opaque texels if `image.layers` is that of the frame to draw.
  FluffyPass(passes::DrawnObject& object, const Frame& frame, const TransmissionImage& image,
             const FluffyOptions& options);

  const char* name() const override { return "fluffy"; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  struct Density {
    std::uint32_t step;  // every which layer is drawn
    float fresh;         // how far every other one of those has faded in
  };
  Density density(const passes::View& view) const;
  // A shader and what is set in it each frame.
  struct Painter {
    explicit Painter(std::span<const std::string_view> defines);
    gl::Program program;
    GLint clip_from_frame, eye, viewport_px, step_between, fresh;
  };
  void set_up(const Painter& painter) const;

  passes::DrawnObject& object_;
  FluffyOptions options_;
  std::uint32_t layers_;
  double longest_m_;
  Cutter cutter_;
  DrawOrder order_;
  gl::StaticBuffer vertices_;
  gl::StreamBuffer indices_;
  gl::VertexArrayHandle array_;
  gl::TextureArray image_;
  Painter fluff_;
  std::optional<Painter> rim_;
};

}  // namespace rinkaku::fluffy
