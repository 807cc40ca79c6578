#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"

namespace rinkaku::mesh {

/// Where two faces cut through each other.
struct Cut {
  std::array<std::uint32_t, 2> faces{};
  std::array<glm::dvec3, 2> ends{};  ///< of the segment that both share, in the mesh's coordinates
  /// Of the faces and then of the ends: weights of the face's corners, in their order; they add up to 1.
  std::array<std::array<glm::dvec3, 2>, 2> weights{};
};

/// The segments along which faces of different components cut through each other; empty for a single component.
///
/// Two faces cut where the line that their planes share lies in both: each cuts the line to an interval (Möller, "A
/// fast triangle-triangle intersection test", 1997). A corner that lies in the other's plane counts as before it, for
/// all the faces around it, so chains of segments have neither gaps nor doubles. Computed in double. Left out are faces
/// without area, pairs whose planes differ by less than 1e-6 radians (those have no line), and points of contact. Cost:
/// about 0.3 microseconds a triangle and 0.2 a pair of faces whose boxes meet.
std::vector<Cut> intersections(const Topology& topology);

}  // namespace rinkaku::mesh
