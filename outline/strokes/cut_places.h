#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/strokes/stroke_path.h"

namespace rinkaku::outline {

/// A place where two faces of a mesh cut through each other, as part of each.
struct CutPlace {
  struct Side {
    glm::uvec3 corners{0};    ///< the mesh's vertices
    glm::vec3 weights{0.0f};  ///< of them; they add up to 1
  };
  std::array<Side, 2> sides{};
};

/// Where such places are on a mesh that has moved: half-way between the two faces' ideas of it. No GL.
struct MovedCuts {
  /// Allocates nothing once warm; some 10 ns a place.
  void move(std::span<const CutPlace> places, const PositionView& vertices);

  std::vector<glm::vec3> positions;
  std::vector<float> apart;  ///< how far the faces have come from each other there, in the mesh's coordinates
};

}  // namespace rinkaku::outline
