#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/depth_order.h"
#include "outline/fluffy/frame.h"

namespace rinkaku::fluffy {

/// The order in which layers of fluff are blended: triangles from far to near by their middle, and within a triangle
/// that faces the eye its layers from the skin outwards, within one that doesn't inwards. A ray that passes the contour
/// so meets layers from back to front.
///
/// Not thread-safe; sorted() allocates nothing. Cost: about 10 ns a triangle and 2 ns a triangle's layer.
class DrawOrder {
 public:
  /// `layers` from 1 on.
  DrawOrder(const Frame& frame, std::uint32_t layers);

  /// Indices of the triangles' layers, three a triangle: vertex * layers + layer, layer 0 nearest to the skin. Of the
  /// layers, every `step`-th is drawn, counted from the outermost, which always is.
  /// `eye` in the frame's coordinates. The span lives until the next call.
  std::span<const std::uint32_t> sorted(std::span<const std::uint32_t> triangles, const glm::dvec3& eye,
                                        std::uint32_t step = 1);

  /// Other points and normals of the frame, as an animated mesh has them each frame.
  void move(const Frame& frame);

 private:
  std::uint32_t layers_;
  std::vector<glm::uvec3> triangles_;
  std::vector<glm::vec3> middles_, normals_;
  std::vector<float> distances_;
  mesh::DepthOrder order_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace rinkaku::fluffy
