#pragma once

#include "mesh/mesh.h"

namespace rinkaku::outline {

/// The trace of a brush's bristles, for where no stroke image is given: ink in alpha, along the stroke from left to
/// right, without a seam from its end to its beginning. 512 x 64.
mesh::Texture bristles();

}  // namespace rinkaku::outline
