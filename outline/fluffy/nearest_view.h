#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/band.h"

namespace rinkaku::fluffy {

/// The paper's own form of view candidates, to compare BandLists with: directions from the centre, spread evenly, each
/// with the triangles whose normal is in the band as seen from infinitely far that way; the one nearest to the eye's
/// direction wins.
///
/// It knows no perspective, and between candidates it misses triangles.
/// Yamachi, Shindo and Matuda, 2, step 2, after Shindo et al. 1995.
class NearestView {
 public:
  /// `surface` is by_faces() as printed.
  NearestView(const BandSurface& surface, double sine, std::uint32_t candidates);

  /// The nearest candidate's triangles, ascending. About 1 ns a candidate.
  std::span<const std::uint32_t> list(const glm::dvec3& eye) const;
  std::size_t bytes() const;

 private:
  glm::dvec3 centre_{0};
  std::vector<glm::vec3> directions_;
  std::vector<std::uint32_t> first_;  // per candidate, and the end
  std::vector<std::uint32_t> triangles_;
};

}  // namespace rinkaku::fluffy
