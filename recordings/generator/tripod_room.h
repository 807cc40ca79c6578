#pragma once

#include "recordings/generator/room.h"

namespace rinkaku::recordings {

/// A living room, its light baked for a camera at `eye`. Floor at z = 0, x right and y away from the camera.
Room make_tripod_room(glm::vec3 eye);

}  // namespace rinkaku::recordings
