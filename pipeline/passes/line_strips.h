#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "pipeline/frame/camera_model.h"
#include "pipeline/passes/contour_strips.h"
#include "pipeline/passes/shape_vertex.h"

namespace rinkaku::passes {

/// A vertex of a line along a contour, at the attribute locations 0 and 1.
struct LineVertex {
  glm::vec3 position{0};  ///< on the contour, in the object's coordinates
  /// snorm: which way the screen's pixels the vertex is pushed for a line one pixel wide, times 1 / most_push; the
  /// line's width as a part of largest_factor(); 1 at the rim, 0 at the contour.
  std::array<std::int16_t, 4> line{};

  static constexpr float most_push = 8;
};

/// What varies along a line.
struct LineStyle {
  /// What the width is multiplied by at each welded point, above 0; empty for 1.
  std::span<const float> factors{};
  /// For an object that moves: finds the factors each frame, where they are needed. Empty: they stay.
  struct Moved {
    std::span<const glm::vec3> points, outline_normals;  ///< of the welded points, as they are now
    std::span<const std::uint32_t> wanted;               ///< the points whose factors are needed; some several times
    std::span<float> factors;                            ///< per point, to be written
  };
  using Follow = std::function<void(const Moved&)>;
  Follow follow{};
  float most_factor = 0;  ///< the largest that `follow` may give
  /// The most that factors above 1 add at each welded point, in metres at its depth; empty: no limit.
  std::vector<float> most_added_m{};
  /// The line that it is added to, set by who draws it: width_px + width_m seen at its depth, within these.
  float width_px = 0, width_m = 0, least_px = 0, most_px = 0;
  float taper_px = 0;    ///< where a line ends on a surface, it gets thinner over this length, or less if it soon goes
                         ///< on; 0: not at all
  float longest_px = 0;  ///< longer edges that can be seen are cut into up to 64 pieces, for what is found
                         ///< at each vertex; 0: not at all
};

/// Turns a contour into lines of right width: along each edge a quad, and at corners what closes them. No GL.
///
/// Where a surface is smooth, a vertex is pushed along its outline normal as it is seen. Where it is hard, that normal
/// lies askew to the edges, so the vertex goes to where the edges' own offsets meet (a miter); at corners so sharp that
/// this is farther than kMiterLimit widths, the miter is cut off and a triangle closes the line. All this is done as
/// the lens shows it, and the lens's stretching undone last: widths are those in the plate.
class LineStrips {
 public:
  static constexpr float kMiterLimit = 2.5f;

  /// Keeps neither mesh nor topology.
  LineStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, bool mirrored);
  void style(const LineStyle& style);
  /// Finds the factors of an object that moves along a contour, if the style has `follow`. Points and outline normals
  /// as the topology has them.
  void find_factors(const ContourStrips& contour, std::span<const glm::vec3> points,
                    std::span<const glm::vec3> outline_normals);

  /// `to_pixels` takes a position to (x Z, y Z, Z, Z), x and y in pixels of the pinhole picture; `vertices` are the
  /// mesh's. Allocates nothing once warm. About 0.1 microseconds an edge, and as much again for a lens with distortion.
  void collect(const ContourStrips& contour, std::span<const ShapeVertex> vertices, const glm::mat4& to_pixels,
               const CameraModel& camera);

  std::span<const LineVertex> vertices() const { return line_vertices_; }
  std::span<const std::uint32_t> indices() const { return indices_; }
  float largest_factor() const { return largest_factor_; }
  float largest_push() const { return std::sqrt(largest_push_squared_); }  ///< of this frame's, in widths

 private:
  // A point of this frame's contour.
  struct Place {
    std::uint32_t point = 0;
    glm::vec3 position{0};
    glm::vec3 seen{0};    // x Z, y Z, Z
    glm::vec2 normal{0};  // unit or 0: the outline normal as it is seen
    // How the contour goes on where it is hidden.
    int hidden_ends = 0;
    std::array<std::uint32_t, 2> hidden_next{};
    std::array<float, 2> hidden_length_px{};
    float factor = 1, taper = 1;
    bool soft = true;                 // pushed along its normal
    glm::mat2 plate_from_pinhole{1};  // around the point; directions and lengths below are the plate's
    int ends = 0;                     // of pieces with a direction
    // Of the first two such pieces: outwards, and to its other end, unit; which place that is.
    std::array<glm::vec2, 2> outwards{}, onwards{};
    std::array<std::uint32_t, 2> next{};
    std::array<float, 2> length_px{};
    float shortest_px = 0;
    float along_normal = 0;  // sum over all pieces of outwards . normal
    // What is found for the two pieces' rims, and whether they differ.
    std::array<glm::vec2, 2> push{};
    bool cut = false;
  };
  struct Line {
    std::uint32_t from, to;         // of places_
    std::uint8_t from_end, to_end;  // which of the place's ends it is
  };
  float limited(const Place& place, float focal_px) const;
  std::uint32_t place_at(std::uint32_t vertex, std::span<const ShapeVertex> vertices, const glm::mat4& to_pixels,
                         const CameraModel* lens);
  static std::uint8_t meet(Place& place, std::uint32_t next, const glm::vec2& way, float side, float length_px);
  bool bends_evenly(const Place& place) const;
  void find_push(Place& place) const;
  void note_hidden(std::span<const ContourStrips::Piece> pieces, std::span<const ShapeVertex> vertices,
                   const glm::mat4& to_pixels, const CameraModel* lens);
  void bridge_hidden(std::span<const ContourStrips::Piece> pieces);
  float hidden_px(std::uint32_t from) const;
  void taper_ends();
  int pieces_of(const Place& from, const Place& to) const;
  void emit(const Line& line);
  std::uint32_t add_between(const Place& from, const Place& to, float t, const glm::vec2& push, bool rim);
  std::uint32_t add(const Place& place, const glm::vec2& push, bool rim);

  bool mirrored_;
  std::vector<std::uint32_t> welded_;
  std::vector<float> hard_;          // per point: 0 smooth to 1
  std::vector<float> factors_;       // per point
  std::vector<float> most_added_m_;  // per point, or empty
  float width_px_ = 0, width_m_ = 0, least_px_ = 0, most_px_ = 0;
  std::vector<std::uint32_t> place_of_;  // per point, of this frame's; valid where places_ agrees
  float taper_px_ = 0, longest_px_ = 0;
  float largest_factor_ = 1;
  LineStyle::Follow follow_;
  std::vector<std::uint32_t> wanted_;
  float largest_push_squared_ = 1;
  glm::vec2 plate_px_{0};  // this frame's
  // This frame's, kept for their memory.
  std::vector<Place> places_;
  std::vector<Line> lines_;
  std::vector<LineVertex> line_vertices_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace rinkaku::passes
