#include "apps/rinkaku/call_values.h"

#include <charconv>
#include <cmath>

#include "pipeline/frame/error.h"

namespace rinkaku::app {

glm::dvec3 parse_point(const char* option, const std::string& text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  glm::dvec3 point(0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [next, error] = std::from_chars(at, end, point[axis]);
    const bool separated = axis < 2 ? next != end && *next == ',' : next == end;
    if (error != std::errc() || !separated || !std::isfinite(point[axis])) {
      throw input_error(option, "'" + text + "' is no point", "write X,Y,Z, e.g. 0,0.5,-4");
    }
    at = next + 1;
  }
  return point;
}

glm::ivec2 parse_size(const char* option, const std::string& text) {
  const char* const end = text.data() + text.size();
  glm::ivec2 size(0);
  const auto [cross, first] = std::from_chars(text.data(), end, size.x);
  if (first == std::errc() && cross != end && *cross == 'x') {
    const auto [last, second] = std::from_chars(cross + 1, end, size.y);
    constexpr int most = 16384;
    const bool sound = size.x >= 1 && size.y >= 1 && size.x <= most && size.y <= most;
    if (second == std::errc() && last == end && sound) return size;
  }
  throw input_error(option, "'" + text + "' is no size of a picture", "write WxH, e.g. 1280x720, at most 16384x16384");
}

}  // namespace rinkaku::app
