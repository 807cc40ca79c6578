#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "mesh/contour.h"
#include "mesh/levels.h"
#include "mesh/mesh.h"
#include "mesh/rig.h"
#include "mesh/topology.h"
#include "pipeline/passes/border_strips.h"
#include "pipeline/passes/contour_strips.h"
#include "pipeline/passes/intersection_strips.h"
#include "pipeline/passes/line_strips.h"
#include "pipeline/passes/look.h"
#include "pipeline/passes/moving_shape.h"
#include "pipeline/passes/shape_vertex.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// An object of the scene as it stands in the world, and each frame which triangles face the eye and where the contour
/// runs. No GL.
///
/// The contour is always the whole mesh's. The surface inside it comes from the coarsest level of detail that lies
/// within a pixel (under lines half of one) of the whole mesh at the object's nearest point, so its cost follows its
/// size in the picture. Only what moves is always drawn whole: a level of its rest pose may be wrong in others, and
/// light moves over it.
class ObjectShape {
 public:
  /// `world_from_object` may scale (also unevenly) and mirror. `uneven` says per triangle whether its colour changes
  /// over it (1), so that levels of detail must keep it; if empty, all may be simplified. About 0.5 microseconds a
  /// triangle.
  ObjectShape(const mesh::Mesh& mesh, const glm::dmat4& world_from_object, std::span<const std::uint8_t> uneven = {});

  /// The object plays an animation of its mesh from now on, by the clock of the views it is looked at through.
  /// Precondition: `rig` is the mesh's, and has that animation; passes have not asked for anything yet.
  void animate(const mesh::Mesh& mesh, mesh::Rig rig, const mesh::Playback& playback);

  /// About 0.3 ms for 23,000 triangles, and 15 ms when a level of detail is needed for the first time. Allocates
  /// nothing once warm.
  const Look& look(const View& view, const PixelRect& picture);
  const Look& last_look() const { return look_; }

  /// From now on looks find lines along the contour.
  void ask_for_lines(const LineStyle& style);
  /// From now on looks ask this first.
  void use_regions(RegionKnowledge known) { known_ = std::move(known); }
  float largest_line_factor() const { return lines_->largest_factor(); }

  /// Of an object that moves, looks bring along those that lie on the contour and on lines; see ask_for_vertices().
  std::span<const ShapeVertex> vertices() const { return vertices_; }
  /// From now on looks bring all vertices and outline normals to where the object has moved. About 30 ns a vertex.
  void ask_for_vertices() { asked_for_vertices_ = true; }
  /// What there is of it only if it moves; null if it stands still.
  const MovingShape* moving() const { return moving_ ? &*moving_ : nullptr; }
  bool moves() const { return moving_.has_value(); }
  /// How often it has moved so far: what was made of its vertices is of that count.
  std::uint64_t moves_made() const { return moving_ ? moving_->moves_made() : 0; }
  /// Where its welded points are now, in the object's coordinates. Precondition: it moves.
  std::span<const glm::vec3> moved_points() const { return moving_->points(); }
  /// And their outline normals, unit, likewise; of the same ones as vertices().
  std::span<const glm::vec3> moved_outline_normals() const { return moving_->skin().outline_normals(); }
  /// Of the borders between materials; empty if there are none.
  std::span<const BorderVertex> border_vertices() const { return borders_->vertices(); }
  bool intersects_itself() const { return !intersections_->empty(); }
  const glm::dmat4& world_from_object() const { return world_from_object_; }
  /// Unit normals in the world are normalize(this * normal).
  const glm::mat3& world_from_normal() const { return world_from_normal_; }
  bool mirrored() const { return mirrored_; }
  bool two_sided() const { return two_sided_; }
  bool has_levels() const { return levels_->count() > 0; }
  /// Metres in the world that an outline normal of length 1 in the vertices stands for.
  double push_m() const { return push_m_; }

 private:
  void follow();
  void settle(const mesh::Contour& contour);
  void find_bounds(const glm::mat4& pixels_from_object, const PixelRect& picture);
  mesh::ContourFinder* finder_for(const View& view);
  mesh::ContourFinder* level_finder(std::size_t level);
  void list_front(const mesh::Contour& found, bool split);
  void take_cover(const View& view, const glm::dvec3& eye);
  void collect_vertices(const mesh::Mesh& mesh, const mesh::Topology& topology);

  glm::dmat4 world_from_object_;
  glm::dmat4 object_from_world_;
  glm::mat3 world_from_normal_;
  bool mirrored_ = false;
  bool two_sided_ = false;
  glm::dvec3 centre_{0};
  double push_m_ = 1;
  double largest_scale_ = 0;  // metres that one of the mesh's units takes at most
  std::vector<ShapeVertex> vertices_;
  std::vector<float> x_, y_, z_;  // of the welded points
  std::optional<mesh::ContourFinder> whole_;
  mesh::Mesh outlook_;  // what a level's finder needs of the mesh, its triangles and parts to be filled in
  std::optional<mesh::Levels> levels_;
  struct MadeLevel {
    bool made = false;
    std::optional<mesh::ContourFinder> finder;  // none: the level is not worth it
  };
  std::vector<MadeLevel> made_levels_;   // when first needed
  std::size_t triangles_ = 0;            // of the whole mesh
  std::optional<ContourStrips> strips_;  // made once it is known whether the object is two-sided
  std::optional<LineStrips> lines_;
  bool asked_for_lines_ = false;
  std::optional<BorderStrips> borders_;
  std::optional<IntersectionStrips> intersections_;

  std::optional<MovingShape> moving_;
  std::vector<std::uint32_t> used_points_, used_positions_;  // of borders and intersections: points, vertices
  bool asked_for_vertices_ = false;

  RegionKnowledge known_;
  std::vector<Run> front_runs_;
  Look look_;
};

}  // namespace rinkaku::passes
