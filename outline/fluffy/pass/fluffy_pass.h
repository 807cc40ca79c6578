#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/cutter.h"
#include "outline/fluffy/draw_order.h"
#include "outline/fluffy/frame.h"
#include "outline/fluffy/moving_frame.h"
#include "outline/fluffy/pass/gpu_cut.h"
#include "outline/fluffy/transmission.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_array.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::fluffy {

/// A line around the fluff.
struct RimLine {
  float width_px = 3;                     ///< not read if width_m is given
  float width_m = 0;                      ///< above 0: as wide as something of this size at the object's middle
  float least_px = 0, most_px = 40;       ///< between which width_m stays
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
};

struct FluffyOptions {
  CutOptions cut;
  bool cut_on_gpu = false;          ///< by GpuCut instead, with the sine of `cut`
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

  /// From now on fluff goes with an object that moves, anew each time it has. Preconditions: `frame` is the pass's, the
  /// object moves, and the cut is Exact, None, or on the GPU.
  void follow(MovingFrame frame);

  const char* name() const override { return "fluffy"; }
  bool draws_lines() const override { return rim_.has_value(); }  // around the tufts
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  // FluffVertex of fluffy.vert.
  struct GpuVertex {
    glm::vec3 position;
    float u;
    glm::vec3 growth;
    float v;
    glm::vec3 normal;
    std::array<std::uint8_t, 4> colour;
  };
  static std::vector<GpuVertex> vertices_of(const Frame& frame);
  // What follows an object that moves.
  struct Movement {
    MovingFrame frame;
    std::uint64_t moves_seen = 0;  // of the object's, by the frame,
    std::uint64_t moves_sent = 0;  // and by all that is made of the frame
    std::vector<GpuVertex> values;
    gl::StreamBuffer vertices;
  };
  // Of the frame as it is now.
  double longest_m() const;
  void send_movement();
  GLuint vertices() const { return movement_ ? movement_->vertices.name() : vertices_.name(); }
  struct Density {
    std::uint32_t step;  // every which layer is drawn
    float fresh;         // how far every other one of those has faded in
  };
  Density density(const passes::View& view) const;
  // A shader and what is set in it each frame.
  struct Painter {
    explicit Painter(std::span<const std::string_view> defines);
    gl::Program program;
    GLint clip_from_frame, eye, viewport_px, step_between, fresh, rim_px;
  };
  void set_up(const Painter& painter) const;
  float rim_px(const passes::View& view) const;  // 0 without one

  // Finds and sorts what is to be drawn for this eye; returns how many indices, if the CPU knows.
  GLsizei find(const glm::dvec3& eye, std::uint32_t step);

  passes::DrawnObject& object_;
  FluffyOptions options_;
  std::uint32_t layers_;
  double longest_at_rest_m_;
  std::optional<GpuCut> gpu_cut_;  // or:
  std::optional<Cutter> cutter_;
  std::optional<DrawOrder> order_;
  gl::StaticBuffer vertices_;
  mutable std::optional<Movement> movement_;  // its frame is brought up to date by whoever asks first
  gl::StreamBuffer indices_;
  gl::VertexArrayHandle array_;
  gl::TextureArray image_;
  Painter fluff_;
  std::optional<Painter> rim_;
};

}  // namespace rinkaku::fluffy
