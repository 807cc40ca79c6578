#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "outline/strokes/chains.h"
#include "outline/strokes/stroke_path.h"

namespace rinkaku::outline {

/// Parts chains where they are hidden for long. No GL. Allocates nothing once warm.
///
/// Over small triangles a contour zigzags and is hidden for an edge or two every now and then; a line drawn by hand
/// goes on there.
class SeenRuns {
 public:
  struct Run {
    std::uint32_t first = 0, count = 0;  ///< of vertices()
    bool closed = false;
  };
  /// `first_hidden` is the number of the first hidden segment; those before it are seen. Hidden stretches of up to
  /// `longest_px` go with what is seen. `to_pixels` as for StrokePath.
  void part(const Chains& chains, std::uint32_t first_hidden, const PositionView& positions, const glm::mat4& to_pixels,
            float longest_px);

  std::span<const Run> runs() const { return runs_; }
  std::span<const std::uint32_t> vertices() const { return vertices_; }

 private:
  void part(std::span<const std::uint32_t> vertices, bool closed);

  std::vector<float> lengths_px_;     // per step of one chain
  std::vector<std::uint8_t> hidden_;  // likewise
  std::vector<Run> runs_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace rinkaku::outline
