#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// An eye (x, y, z, w) as seen from some origin, within reach of float, and how near a face's plane it may be for the
/// face to count as seen from the front, w times the distance.
struct Eye {
  float x = 0, y = 0, z = 0, w = 0, margin = 0;
};

/// Which faces an eye sees from the front, straight from the points: for meshes that move, where no plane is used
/// twice. Writes 1 or 0 per face: `front` if the eye is strictly on its outer side, `seen_front` if it is so within the
/// margin, or the face is two-sided. Faces without area to go by (about which both are meaningless) are listed in
/// `flat`, growing; no memory is taken if it has room for all. About 4 ns a face.
void classify_moved(std::span<const glm::uvec3> faces, std::span<const glm::vec3> points, const glm::vec3& origin,
                    const Eye& eye, std::span<const std::uint8_t> two_sided, std::span<std::uint8_t> front,
                    std::span<std::uint8_t> seen_front, std::vector<std::uint32_t>& flat);

}  // namespace rinkaku::mesh
