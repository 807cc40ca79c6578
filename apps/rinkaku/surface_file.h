#pragma once

#include <string>

#include "silhouette/surface.h"

namespace rinkaku::app {

/// Imports a mesh file as the surface that mattes are drawn of, and notes on standard error what can't be kept to.
/// Throws what mesh::import() and make_surface() throw.
silhouette::Surface read_surface(const std::string& mesh_file);

}  // namespace rinkaku::app
