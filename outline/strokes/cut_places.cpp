#include "outline/strokes/cut_places.h"

#include <glm/geometric.hpp>

namespace rinkaku::outline {

void MovedCuts::move(std::span<const CutPlace> places, const PositionView& vertices) {
  positions.clear();
  apart.clear();
  for (const CutPlace& place : places) {
    const auto on = [&](const CutPlace::Side& side) {
      return side.weights.x * vertices[side.corners.x] + side.weights.y * vertices[side.corners.y] +
             side.weights.z * vertices[side.corners.z];
    };
    const glm::vec3 first = on(place.sides[0]), second = on(place.sides[1]);
    positions.push_back((first + second) * 0.5f);
    apart.push_back(glm::distance(first, second));
  }
}

}  // namespace rinkaku::outline
