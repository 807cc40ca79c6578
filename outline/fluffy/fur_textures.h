#pragma once

#include "mesh/mesh.h"
#include "outline/fluffy/fur_kind.h"

namespace rinkaku::fluffy {

/// How many tufts, curls or hairs lie along a side of the texture.
int tufts_across(FurKind kind);

/// How wide they look best, in lengths of the fluff.
double tuft_width(FurKind kind);

/// Draws one: 512 x 512 texels, grey, opaque, repeating without a seam, the same on every call. Luminance is height,
/// spread evenly from 0 to 1, so that a threshold t keeps 1 - t of it. Cost: about 50 ms.
mesh::Texture fur_texture(FurKind kind);

}  // namespace rinkaku::fluffy
