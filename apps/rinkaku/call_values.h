#pragma once

#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::app {

/// Values of options, written as text. Each throws Error (Input) naming `option` where the text is none.

/// "X,Y,Z", finite.
glm::dvec3 parse_point(const char* option, const std::string& text);

/// "WxH" in pixels, each from 1 to 16384.
glm::ivec2 parse_size(const char* option, const std::string& text);

}  // namespace rinkaku::app
