#include "pipeline/gl/version.h"

#include <epoxy/gl.h>

namespace rinkaku::gl {

std::string version() { return reinterpret_cast<const char*>(glGetString(GL_VERSION)); }

}  // namespace rinkaku::gl
