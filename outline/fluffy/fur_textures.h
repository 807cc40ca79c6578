#pragma once

#include <optional>
#include <string_view>

#include "mesh/mesh.h"

namespace rinkaku::fluffy {

/// Textures of fluff that need no photograph.
enum class FurKind {
  Fur,   ///< pointed tufts of several hairs
  Wool,  ///< round curls
  Down,  ///< fine single hairs
};

/// The kind of this name ("fur", "wool", "down"), or nothing.
std::optional<FurKind> fur_kind(std::string_view name);

/// How many tufts, curls or hairs lie along a side of the texture.
int tufts_across(FurKind kind);

/// Draws one: 512 x 512 texels, grey, opaque, repeating without a seam, the same on every call. Luminance is height,
/// spread evenly from 0 to 1, so that a threshold t keeps 1 - t of it. Cost: about 100 ms.
mesh::Texture fur_texture(FurKind kind);

}  // namespace rinkaku::fluffy
