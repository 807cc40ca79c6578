#include "water/section.h"

#include <array>

namespace rinkaku::water {

std::vector<Segment> section(const Solid& solid, const Surface& surface) {
  std::vector<double> height_m;
  height_m.reserve(solid.positions_m.size());
  for (const glm::vec3& p : solid.positions_m) height_m.push_back(surface.height_m(p));
  std::vector<Segment> segments;
  for (const glm::uvec3& t : solid.triangles) {
    std::array<glm::dvec2, 3> cuts;
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const unsigned a = t[i], b = t[(i + 1) % 3];
      // A corner on the water counts as above it, so that each line through one is found once.
      if ((height_m[a] >= 0) == (height_m[b] >= 0)) continue;
      const double s = height_m[a] / (height_m[a] - height_m[b]);
      cuts[count++] =
          surface.from_world(glm::dvec3(solid.positions_m[a]) * (1 - s) + glm::dvec3(solid.positions_m[b]) * s);
    }
    if (count == 2 && surface.contains((cuts[0] + cuts[1]) / 2.0)) segments.push_back({cuts[0], cuts[1]});
  }
  return segments;
}

}  // namespace rinkaku::water
