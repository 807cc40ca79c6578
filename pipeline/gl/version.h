#pragma once

#include <string>

namespace rinkaku::gl {

/// OpenGL's and the driver's version, e.g. "4.5 (Core Profile) Mesa 22.3.6". Needs a current GL context.
std::string version();

}  // namespace rinkaku::gl
