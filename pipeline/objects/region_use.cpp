#include "pipeline/objects/region_use.h"

namespace rinkaku::pipeline {

RegionUse region_use(const ObjectScene& object) {
  if (!object.regions || object.animation) return RegionUse::None;  // regions hold for one shape
  const bool one_colour = object.colour && !object.toon && !object.outline && !object.fluffy;
  return object.holdout || one_colour ? RegionUse::Cover : RegionUse::Faces;
}

}  // namespace rinkaku::pipeline
