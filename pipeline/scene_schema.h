#pragma once

#include "pipeline/toml/schema.h"

namespace rinkaku::pipeline {

/// Every key a scene file takes; docs/scene.md describes them.
inline toml::Schema scene_schema() {
  return {
      {.path = "", .keys = {"plate", "track", "light", "object", "output"}},
      {.path = "plate",
       .keys = {"video", "images", "fps", "camera"},
       .refused = {{"device", "this version takes recordings only: give 'video' or 'images'"}}},
      {.path = "track", .keys = {"marker", "board", "poses", "locked", "smoothing", "hold_s", "fade_s"}},
      {.path = "track.marker", .keys = {"dictionary", "id", "size_m"}},
      {.path = "track.locked", .keys = {"position_m", "look_at_m", "up"}},
      {.path = "track.smoothing", .keys = {"min_cutoff_hz", "beta"}},
      {.path = "light", .keys = {"direction"}},
      {.path = "object",
       .keys = {"mesh", "name", "position_m", "rotation_deg", "height_m", "scale", "up", "anchor", "crease_deg",
                "colour", "toon", "outline", "holdout"},
       .repeated = true},
      {.path = "object.toon", .keys = {"bands", "shade_colour"}},
      {.path = "object.outline",
       .keys = {"width_px", "width_m", "min_px", "max_px", "taper_px", "colour", "method", "curvature", "sign",
                "exaggeration", "saturation", "curve", "min_factor", "smoothing"}},
      {.path = "output", .keys = {"video", "images", "codec", "bit_rate", "content"}},
  };
}

}  // namespace rinkaku::pipeline
