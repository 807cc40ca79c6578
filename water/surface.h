#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::water {

/// One straight piece of a surface's border, in the surface's own metres; the water lies to the left of a -> b.
struct BorderEdge {
  glm::dvec2 a{0};
  glm::dvec2 b{0};
  bool open = false;  ///< water flows through; a shore otherwise
};

/// What a scene says of a water surface: world coordinates, metres.
struct SurfaceOutline {
  std::vector<glm::dvec3> corners;                 ///< of the outline, in either sense; within 1 % of one plane
  std::vector<int> open_edges;                     ///< edge i runs from corner i to the next one
  std::vector<std::vector<glm::dvec3>> obstacles;  ///< things that stand in the water, each an outline
};

/// A plane piece of water: where it lies, and its border. Own coordinates: metres along two axes of the plane, seen
/// from the side that the normal points to; the normal points up, and for upright surfaces to `seen_from`.
class Surface {
 public:
  /// Throws Error (Input), naming `where`: fewer than three corners, corners that are not finite, that lie on a line or
  /// not in a plane, an outline that crosses itself, an open edge that isn't there, an obstacle with too few corners.
  Surface(std::string_view where, const SurfaceOutline& outline, const glm::dvec3& seen_from);

  glm::dvec3 to_world(glm::dvec2 p) const { return origin_ + axis_x_ * p.x + axis_y_ * p.y; }
  glm::dvec2 from_world(const glm::dvec3& point) const;
  /// Of a direction in the world: its part in the plane.
  glm::dvec2 direction_from_world(const glm::dvec3& direction) const;
  /// How far a point is above the surface, metres.
  double height_m(const glm::dvec3& point) const;
  const glm::dvec3& normal() const { return normal_; }

  std::span<const BorderEdge> edges() const { return edges_; }
  /// The corners of the outline without obstacles, counter-clockwise.
  std::span<const glm::dvec2> outline() const { return outline_; }
  /// Three corners each: the outline less the obstacles, cut into triangles.
  std::span<const glm::dvec2> triangles() const { return triangles_; }
  glm::dvec2 least() const { return least_; }
  glm::dvec2 most() const { return most_; }
  double area_m2() const { return area_m2_; }

  /// Within the outline and in no obstacle. Cost: one look at each edge.
  bool contains(glm::dvec2 p) const;
  /// The nearest point of the border and its distance in metres; of shores only if asked.
  struct Nearest {
    glm::dvec2 point{0};
    double distance_m = 0;
    std::size_t edge = 0;
    bool found = false;
  };
  Nearest nearest_border(glm::dvec2 p, bool shores_only) const;
  /// The first shore that the way from a to b crosses; `found` is false if there is none.
  Nearest crossed_shore(glm::dvec2 a, glm::dvec2 b) const;

 private:
  void set_plane(std::string_view where, const SurfaceOutline& outline, const glm::dvec3& seen_from);
  void add_ring(std::string_view where, std::span<const glm::dvec3> corners, std::span<const int> open, bool hole);

  glm::dvec3 origin_{0}, axis_x_{1, 0, 0}, axis_y_{0, 1, 0}, normal_{0, 0, 1};
  std::vector<glm::dvec2> outline_;
  std::vector<std::vector<glm::dvec2>> holes_;
  std::vector<BorderEdge> edges_;
  std::vector<glm::dvec2> triangles_;
  glm::dvec2 least_{0}, most_{0};
  double area_m2_ = 0;
};

}  // namespace rinkaku::water
