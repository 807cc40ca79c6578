#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "mesh/contour.h"
#include "mesh/mesh.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/handle.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// What look() found for this frame; shared by all passes of an object.
struct Look {
  bool visible = false;
  PixelRect bounds;                ///< of the mesh itself in the pinhole picture, whole pixels; passes reach further
  double distance_m = 0;           ///< from the eye to the object's centre, for the order of drawing
  bool crosses_eye_plane = false;  ///< then bounds is the whole picture and screen positions are meaningless
  const mesh::Contour* contour = nullptr;  ///< of the whole mesh
  const mesh::Contour* surface = nullptr;  ///< of the level of detail that is drawn inside the contour
  /// By how much the level's own contour may miss the whole mesh's, rounded up: what is drawn along the contour must
  /// reach so far inwards. 0 where the whole mesh is drawn.
  float overlap_px = 0;
};

/// An object of the scene on the GPU: its mesh, and each frame which triangles face the eye and where the contour runs.
///
/// The contour is always the whole mesh's. The surface inside it comes from the coarsest level of detail that lies
/// within half a pixel of the whole mesh at the object's nearest point, so its cost follows its size in the picture.
/// Needs a current GL context for everything but look().
class DrawnObject {
 public:
  /// `world_from_object` may scale (also unevenly) and mirror.
  DrawnObject(const mesh::Mesh& mesh, const glm::dmat4& world_from_object);

  /// Finds facing, contour and bounds on the CPU. About 0.3 ms for 23,000 triangles.
  const Look& look(const View& view, const PixelRect& picture);
  const Look& last_look() const { return look_; }

  /// Sends this frame's triangle lists and contour to the GPU.
  void upload();

  /// A run of triangles within the bound index list.
  struct Run {
    std::uint32_t part = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
  };
  /// Binds vertices and the front-facing triangles; draw the runs with glDrawElements(GL_TRIANGLES, ...).
  std::span<const Run> bind_front();
  /// Binds one quad a contour edge: two vertices on the edge (attribute `rim` 0) and the same two again with `rim` 1,
  /// for the vertex shader to push out.
  std::span<const Run> bind_contour();

  const glm::dmat4& world_from_object() const { return world_from_object_; }
  /// Unit normals in the world are normalize(this * normal).
  const glm::mat3& world_from_normal() const { return world_from_normal_; }
  bool two_sided() const { return two_sided_; }
  /// Metres in the world that an outline normal of length 1 in the vertex buffer stands for.
  double push_m() const { return push_m_; }

 private:
  struct Vertex {
    glm::vec3 position;
    std::array<std::int16_t, 4> normal;
    std::array<std::int16_t, 4> outline_normal;  // the fourth tells the rim of an edge's quad from the edge itself
    glm::vec2 uv;
    std::array<std::uint8_t, 4> colour;
  };
  struct EdgeVertices {
    std::uint32_t a0, b0, a1, b1;  // as face0 and face1 have them
    std::uint32_t part0, part1;
    std::uint32_t face0, face1;
    bool always_hidden;
  };
  // A level of detail: the whole mesh's first, then ever coarser.
  struct SurfaceLevel {
    double error = 0;  // in the mesh's units
    mesh::ContourFinder finder;
  };
  void find_bounds(const View& view, const PixelRect& picture);
  SurfaceLevel& surface_for(const View& view);
  void collect_vertices(const mesh::Mesh& mesh, const mesh::Topology& topology);
  void collect_edges(const mesh::Mesh& mesh, const mesh::Topology& topology);
  void collect_contour();
  static gl::VertexArrayHandle make_vertex_array();

  glm::dmat4 world_from_object_;
  glm::dmat4 object_from_world_;
  glm::mat3 world_from_normal_;
  bool mirrored_ = false;
  bool two_sided_ = false;
  glm::dvec3 centre_{0};

  std::vector<Vertex> vertices_;
  std::vector<float> x_, y_, z_;  // of the welded points
  std::vector<EdgeVertices> edges_;
  std::vector<SurfaceLevel> levels_;
  double nearest_m_ = 0;
  double push_m_ = 1;
  double largest_scale_ = 0;  // metres that one of the mesh's units takes at most
  Look look_;

  gl::StaticBuffer vertex_buffer_;
  gl::StreamBuffer front_buffer_;
  gl::StreamBuffer contour_buffer_;
  gl::StreamBuffer quad_buffer_;
  std::size_t quads_ = 0;
  gl::VertexArrayHandle mesh_array_;
  gl::VertexArrayHandle contour_array_;
  std::vector<Run> front_runs_;
  std::vector<Run> contour_runs_;
  std::vector<std::uint32_t> contour_order_;
  std::vector<Vertex> contour_vertices_;
  std::vector<std::uint32_t> quad_indices_;
};

}  // namespace rinkaku::passes
