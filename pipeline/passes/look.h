#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "mesh/contour.h"
#include "pipeline/passes/contour_strips.h"
#include "pipeline/passes/line_strips.h"
#include "pipeline/passes/shape_vertex.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// What is known of an object for all eyes of a part of space (see silhouette/): asked each frame, for the eye in the
/// object's coordinates. Either may be missing, and both may know nothing of an eye.
struct RegionKnowledge {
  /// Which faces it sees from the front; null: unknown.
  std::function<const mesh::KnownFaces*(const glm::dvec3& eye)> faces;
  /// Vertex indices of triangles that cover the same pixels as the whole mesh, to be drawn with back faces culled;
  /// empty: unknown. Only for objects whose inside doesn't show: of one flat colour, or holdouts.
  std::function<std::span<const std::uint32_t>(const glm::dvec3& eye)> cover;
  double least_px_per_unit = 0;  ///< `cover` holds where one of the mesh's units takes so many pixels
};

/// What one frame's eye sees of an object. The spans live until the next look.
struct Look {
  bool visible = false;
  PixelRect bounds;                ///< of the mesh itself in the pinhole picture, whole pixels; passes reach further
  double nearest_m = 0;            ///< the mesh's least depth, along the camera's axis
  double farthest_m = 0;           ///< the mesh's greatest
  double distance_m = 0;           ///< from the eye to the object's centre, for the order of drawing
  bool crosses_eye_plane = false;  ///< then bounds is the whole picture and screen positions are meaningless
  /// By how much the contour of what is drawn may miss the whole mesh's: what is drawn along the contour must reach so
  /// far inwards. 0 where the whole mesh is drawn.
  float overlap_px = 0;
  std::span<const std::uint32_t> front;  ///< vertex indices of the triangles to draw: those that face the eye
  std::span<const Run> front_runs;
  bool cull_back_faces = false;                 ///< some of `front` may turn their back on the eye
  std::span<const ShapeVertex> strip_vertices;  ///< the contour's quads, see ContourStrips
  std::span<const std::uint32_t> strip_indices;
  std::span<const Run> strip_runs;
  std::span<const LineVertex> line_vertices;  ///< see LineStrips; none if no pass asked for lines
  std::span<const std::uint32_t> line_indices;
  std::span<const ContourStrips::Piece> contour_pieces;         ///< the contour's edges, as vertices of the mesh
  std::span<const ContourStrips::Piece> hidden_contour_pieces;  ///< where it is never seen, see ContourStrips
  std::span<const std::uint8_t> front_faces;                    ///< per triangle of the mesh: 1 if it faces the eye
  glm::mat4 to_pixels{1};  ///< takes a position to (x Z, y Z, Z, Z), x and y in pixels of the pinhole picture
  float line_push = 1;     ///< the farthest that a line reaches, in widths
  std::span<const std::uint32_t> border_indices;  ///< of border_vertices(), see BorderStrips
  std::span<const Run> border_runs;
  std::span<const BorderVertex> intersection_vertices;  ///< see IntersectionStrips
  std::span<const std::uint32_t> intersection_indices;
  std::span<const Run> intersection_runs;
};

}  // namespace rinkaku::passes
