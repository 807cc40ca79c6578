#pragma once

namespace rinkaku::fluffy {

/// Textures of fluff that need no photograph.
enum class FurKind {
  Fur,   ///< pointed tufts of several hairs
  Wool,  ///< round curls
  Down,  ///< fine single hairs
};

}  // namespace rinkaku::fluffy
