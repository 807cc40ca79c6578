#include "pipeline/passes/shape_vertex.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::passes {

std::array<std::int16_t, 4> snorm(const glm::dvec3& v) {
  auto code = [](double f) { return static_cast<std::int16_t>(std::lround(std::clamp(f, -1.0, 1.0) * 32767.0)); };
  return {code(v.x), code(v.y), code(v.z), 0};
}

std::array<std::uint8_t, 4> unorm(const glm::vec4& v) {
  auto code = [](float f) { return static_cast<std::uint8_t>(std::lround(std::clamp(f, 0.0f, 1.0f) * 255.0f)); };
  return {code(v.x), code(v.y), code(v.z), code(v.w)};
}

void append_quad(std::uint32_t part, std::uint32_t first, std::vector<std::uint32_t>& indices, std::vector<Run>& runs) {
  if (runs.empty() || runs.back().part != part) {
    runs.push_back({part, static_cast<std::uint32_t>(indices.size()), 0, false});
  }
  for (std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
  runs.back().index_count += 6;
}

}  // namespace rinkaku::passes
