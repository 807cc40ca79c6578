#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "mesh/contour.h"
#include "mesh/intersections.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "pipeline/passes/shape_vertex.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// The feathers of a mesh's intersections with itself: along every segment at which two faces cut through each other,
/// each has a quad in the other's plane that reaches over what is seen of it. Vertices are as those of BorderStrips,
/// but without an outline normal to be pushed along: each frame they are put where the surfaces, drawn smaller as they
/// are, meet in the picture; and as far as that is from where they truly meet, the one's quad is wider and the other's
/// narrower. No GL.
class IntersectionStrips {
 public:
  /// Keeps neither mesh, topology nor cuts. `cuts` are the mesh's intersections().
  IntersectionStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, std::span<const mesh::Cut> cuts,
                     const glm::dmat4& world_from_object);

  /// Lists the quads of which both faces are seen: they face the eye or are two-sided. `contour` is the whole mesh's,
  /// with its faces classified. Allocates nothing once warm. About 0.1 microseconds a cut.
  void collect(const mesh::Contour& contour, const View& view);

  /// Adds the points of the mesh that move() looks at, with their vertices.
  void append_used(std::span<const std::uint32_t> welded, std::vector<std::uint32_t>& points) const;
  /// The mesh has moved: its points, outline normals and vertices. Cuts move with the faces that they are in; one whose
  /// faces no longer meet there by half a pixel isn't drawn. Allocates nothing. About 0.3 microseconds a cut.
  void move(std::span<const glm::vec3> points, std::span<const glm::vec3> outline_normals,
            std::span<const ShapeVertex> vertices);

  bool empty() const { return cuts_.empty(); }
  std::span<const BorderVertex> vertices() const { return vertices_; }
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const Run> runs() const { return runs_; }

 private:
  struct Eye;
  // A corner of faces that are cut, in the world.
  struct Point {
    glm::dvec3 position_m;
    glm::dvec3 outline_normal;
    std::uint32_t number;  // of the mesh
  };
  // The same where it is drawn, in the camera's frame, and the way there.
  struct DrawnPoint {
    glm::dvec3 position_m, way_m;
  };
  // A face at a cut, in the world.
  struct Side {
    std::uint32_t face;
    bool two_sided;
    glm::dvec3 normal;                  // unit
    glm::uvec3 corners;                 // indices of points_
    std::array<glm::dvec3, 2> weights;  // of the corners at the cut's ends
  };
  struct TwoFaces {
    std::array<Side, 2> sides;
    std::array<glm::dvec3, 2> ends_m;
    glm::dvec3 across;   // of the first face's quad: in the second's plane
    double apart_m = 0;  // how far the faces, having moved, are from each other at the ends
  };
  struct Quad {
    std::uint32_t part, cut;
    int of;  // which of the cut's faces has its colour; it lies on the other
    std::array<BorderVertex, 2> ends;
    glm::uvec3 corners;  // vertices of the face
  };
  // Where a cut is drawn, if it is seen.
  struct Placed {
    bool seen;
    std::array<glm::vec3, 2> ends;                     // in the object's coordinates
    std::array<std::array<std::int16_t, 2>, 2> reach;  // of the faces' quads and then of the ends: snorm, pixels
  };
  static glm::dvec3 across(const TwoFaces& two, int of);
  void add_quad(const mesh::Mesh& mesh, const mesh::Cut& cut, int of, std::uint32_t part);
  void place(const TwoFaces& two, const Eye& eye, bool first_from_behind, Placed& placed) const;
  void emit(const Quad& quad, const Placed& placed, bool from_behind);

  glm::dmat4 world_from_object_, object_from_world_;
  std::vector<Point> points_;
  std::vector<DrawnPoint> drawn_points_;
  std::vector<TwoFaces> cuts_;
  std::vector<Quad> quads_;  // in the order of parts
  std::vector<Placed> placed_;
  std::vector<BorderVertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<Run> runs_;
};

}  // namespace rinkaku::passes
