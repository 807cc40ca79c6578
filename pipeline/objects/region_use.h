#pragma once

#include "pipeline/scene/object.h"

namespace rinkaku::pipeline {

/// What a region's lists are used for in drawing an object.
enum class RegionUse {
  None,   ///< drawn whole
  Faces,  ///< which faces turn to the eye and where the contour runs; what is drawn is the same as without
  Cover,  ///< the surface as well comes from the matte's or the depth's list, as nothing of its inside shows
};
RegionUse region_use(const ObjectScene& object);

}  // namespace rinkaku::pipeline
