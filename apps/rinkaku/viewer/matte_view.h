#pragma once

#include "pipeline/line.h"

namespace rinkaku::app {

/// What covers what, as a grey picture of the plate's size and with the frame's times: the mattes of filmed things, the
/// largest of each pixel; in a scene without any, how far CG covers the plate.
Frame matte_view(const pipeline::Work& work, FramePool& pool);

}  // namespace rinkaku::app
