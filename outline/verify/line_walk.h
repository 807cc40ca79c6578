#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "pipeline/passes/layer.h"
#include "pipeline/passes/view.h"

namespace rinkaku::outline {

/// What was found along the contour of one picture.
struct WalkedLine {
  std::uint64_t border = 0;       ///< pixels of the body beside one that it doesn't cover
  std::uint64_t border_gaps = 0;  ///< of them, those beside a pixel that nothing covers
  std::uint64_t places = 0;       ///< points of the contour, at most a pixel apart, that can be seen
  std::uint64_t place_gaps = 0;   ///< of them, those without a line
  std::uint64_t place_thin = 0;   ///< of them, those whose line ends before `across_px`, gaps among them
  std::vector<glm::ivec2> where;  ///< pixels of gaps, the first few

  std::uint64_t gaps() const { return border_gaps + place_gaps; }
};

/// Walks the contour of a closed mesh in a picture of it and looks for gaps in its line.
///
/// Knows of the line only what the picture shows. Where the contour must be it finds by itself: the mesh is rasterised
/// into a depth buffer, and in double precision each edge between a face that faces the eye and one that doesn't is
/// gone along in steps of a pixel. A place counts if nothing as near as the contour lies around the pixel that is
/// `across_px` outside it; across the line as far as there, at least half of some pixel must be ink. So lines over the
/// mesh itself are walked as well as those around it. Within 2.5 pixels of where a contour, this or another that ends
/// there in the picture, runs behind its own surface or turns back at a cusp, it may be bare.
///
/// Preconditions: a closed, consistently wound mesh, all of it before the eye; the picture shows it white (1, 1, 1) and
/// its line red (1, 0, 0), wider than `across_px` + 0.5, not tapered and without a lens. Cost: some 10 ms for 100,000
/// triangles in a picture 512 pixels wide.
class LineWalker {
 public:
  /// `topology`, the mesh's, must outlive the walker.
  explicit LineWalker(const mesh::Topology& topology, double across_px = 1.5)
      : topology_(topology), across_px_(across_px) {}

  WalkedLine walk(const passes::View& view, const glm::dmat4& world_from_mesh, const passes::Layer& layer);

 private:
  void place_points(const passes::View& view, const glm::dmat4& world_from_mesh);
  void fill_depths();
  void walk_border(const passes::Layer& layer, WalkedLine& walked) const;
  void walk_edges(const passes::Layer& layer, WalkedLine& walked);
  bool is_open(const glm::ivec2& pixel, double depth) const;
  bool is_end(const glm::dvec2& pixel) const;
  double depth_at(int x, int y) const { return depths_[static_cast<std::size_t>(y) * width_px_ + x]; }

  const mesh::Topology& topology_;
  double across_px_;
  int width_px_ = 0, height_px_ = 0;
  std::vector<glm::dvec3> points_;  // the topology's, in the camera's frame
  std::vector<glm::dvec2> pixels_;
  std::vector<double> depths_;        // of what is nearest at each pixel's middle; huge where nothing is
  std::vector<std::uint8_t> facing_;  // per face: 1 if it faces the eye
  struct Piece {
    const mesh::Edge* edge;
    std::uint32_t front;  // its face that faces the eye
    glm::dvec2 outwards;
  };
  glm::dvec2 outwards_of(const mesh::Edge& edge, std::uint32_t front) const;
  bool folds_behind(std::uint32_t point) const;
  void walk_edge(const Piece& piece, const passes::Layer& layer, WalkedLine& walked) const;
  std::vector<Piece> contour_;                           // without what lies in hollows
  std::vector<std::uint32_t> lines_at_;                  // per point: pieces that end there
  std::vector<std::array<std::uint32_t, 2>> pieces_at_;  // per point: the first two of them
  std::vector<glm::dvec2> ends_px_;                      // points at which the contour runs behind its own surface
};

}  // namespace rinkaku::outline
