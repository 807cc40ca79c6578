#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "outline/pass/line_look.h"
#include "outline/strokes/chains.h"
#include "outline/strokes/drawn_lines.h"
#include "outline/strokes/features.h"
#include "outline/strokes/radial_curvature.h"
#include "outline/strokes/seen_runs.h"
#include "outline/strokes/stroke_memory.h"
#include "outline/strokes/stroke_mesh.h"
#include "outline/strokes/stroke_path.h"
#include "outline/styles/surface_buffer.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/texture.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct StrokeOptions {
  LineLook look{};
  enum class Lines { Contour, Inner, All, Drawn } lines = Lines::Contour;
  std::vector<DrawnLine> drawn{};  ///< for Drawn: the lines
  FeatureOptions features{};       ///< which inner lines
  bool outside = false;            ///< lines lie outside the contour, behind the body; else half over it
  bool hand = true;                ///< corners are rounded as a hand would; else lines are as exact as the mesh
  float opacity = 1;
  float taper_px = 0;  ///< at lines' ends

  float wobble = 0;       ///< the part of its width that a line is thicker, thinner and displaced by, at random
  float wave_m = 0.02f;   ///< size of wobbles
  int redraw_frames = 0;  ///< after so many frames lines wobble anew; 0: never

  float isophote = 0;     ///< above 0: width is the distance to where |N . V| is this, times width_px / 3 px
  float most_factor = 3;  ///< isophote: the most that gives, in widths; and a fifth of a width the least

  float stroke_px = 0;                   ///< above 0: lines are broken into strokes of this length
  float gap = 0;                         ///< the part of it that stays empty, below 1
  float pressure = 0;                    ///< 0 to 1: how much strokes follow the pen's pressure
  float dryness = 0;                     ///< 0 to 1: how much of the paper stays bare
  const mesh::Texture* brush = nullptr;  ///< ink in alpha, along the stroke from left to right; read at construction
  float brush_px = 160;                  ///< the length that one brush image takes

  bool only_hidden = false;  ///< what the object itself hides is drawn instead of what is seen, dashed
};

/// Lines as strokes: along the chained edges of the contour (Northrup and Markosian, "Artistic silhouettes: a hybrid
/// approach", 2000) and along lines within the shape.
///
/// Each frame edges are linked into chains, smoothed a little on the screen and cut into samples some pixels apart; a
/// strip of triangles runs along them. What the object hides is found at the samples, in a picture of its depth, so
/// that lines may lie half over the body; other objects hide lines by depth as usual. Strokes stay where they are along
/// the line from frame to frame (StrokeMemory). Widths are those in the pinhole picture. The pass comes before the
/// body in an object's passes, or after it if lines lie outside. Cost: the object's depth once more, and about a
/// microsecond a sample of a line.
class StrokePass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass; `mesh` and `topology` are the object's and are not kept.
  StrokePass(passes::DrawnObject& object, const mesh::Mesh& mesh, const mesh::Topology& topology,
             const StrokeOptions& options);

  const char* name() const override { return "strokes"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  void collect(const passes::DrawCall& call);
  void place_more();
  LinePoints line_points() const;
  void add_contour(const passes::DrawCall& call);
  void add_inner(const passes::DrawCall& call);
  void add_drawn(const passes::DrawCall& call);
  void move_bends();
  bool holds_together(const passes::DrawCall& call, const Feature& feature) const;
  void add_line(const passes::DrawCall& call, std::span<const std::uint32_t> vertices, bool closed, bool contour);
  void draw_depth(const passes::DrawCall& call, const passes::PixelRect& rect);

  passes::DrawnObject& object_;
  StrokeOptions options_;
  double radius_m_ = 0;
  std::size_t own_positions_ = 0;
  Features features_;
  std::vector<std::uint32_t> welded_;
  std::vector<glm::uvec3> drawn_triangles_;  // of options_.drawn's places, line after line: the mesh's vertices
  std::vector<glm::vec3> more_positions_;    // after the object's own: the features', or this frame's drawn places
  std::vector<glm::vec3> rest_positions_;    // of the object's own, if it moves and lines wobble
  MovedCuts moved_cuts_;                     // if it moves
  Chains contour_chains_, inner_chains_;
  std::optional<RadialCurvature> bends_;
  // This frame's.
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> drawn_vertices_, contour_points_;
  std::vector<float> widths_px_;
  SeenRuns runs_;
  StrokePath path_;
  StrokeMemory memory_;
  StrokeMesh strips_;
  std::uint32_t frame_ = 0;

  SurfaceBuffer depth_;
  gl::Program program_;
  gl::Texture brush_;
  gl::StreamBuffer vertex_buffer_, index_buffer_;
  gl::VertexArrayHandle array_;
  GLint clip_from_object_ = -1, viewport_px_ = -1, origin_ = -1, last_pixel_ = -1, opaque_ = -1, thickness_m_ = -1;
  GLint near_m_ = -1;
};

}  // namespace rinkaku::outline
