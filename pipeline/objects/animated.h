#pragma once

#include <filesystem>

#include "mesh/pose.h"
#include "mesh/rig.h"
#include "pipeline/scene/animation.h"

namespace rinkaku::pipeline {

/// How the scene wants a mesh's animation played. Throws Error (Input) if the mesh has no such clip, naming those that
/// it has.
mesh::Playback playback(const AnimationScene& animation, const mesh::Rig& rig, const std::filesystem::path& mesh);

}  // namespace rinkaku::pipeline
