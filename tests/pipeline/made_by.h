#pragma once

#include <string>

#include "pipeline/gl/count.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::test {

/// The GL objects that rendering the scene made.
inline gl::Made made_by(const ShotFolder& folder, const std::string& scene) {
  const gl::Made before = gl::made();
  folder.render(scene, {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
  gl::Made made = gl::made();
  made.contexts -= before.contexts;
  made.programs -= before.programs;
  made.buffers -= before.buffers;
  made.textures -= before.textures;
  made.targets -= before.targets;
  return made;
}

}  // namespace rinkaku::test
