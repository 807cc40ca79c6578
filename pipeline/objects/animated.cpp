#include "pipeline/objects/animated.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "pipeline/frame/error.h"

namespace rinkaku::pipeline {
namespace {

std::string known_clips(const mesh::Rig& rig) {
  constexpr std::size_t most = 8;
  std::string known = "it has ";
  for (std::size_t i = 0; i < std::min(most, rig.animations.size()); ++i) {
    known += (i == 0 ? "\"" : ", \"") + rig.animations[i].name + "\"";
  }
  return known + (rig.animations.size() > most ? ", ..." : "");
}

}  // namespace

mesh::Playback playback(const AnimationScene& scene, const mesh::Rig& rig, const std::filesystem::path& mesh) {
  const std::string file = mesh.filename().string();
  if (rig.animations.empty()) {
    throw input_error(scene.where, file + " has no animation",
                      "leave 'animation' out, or export the mesh with its clips");
  }
  mesh::Playback playback{0, scene.loop, scene.start_s, scene.speed};
  auto found = rig.animations.begin();
  if (!scene.clip_name.empty()) {
    found = std::find_if(rig.animations.begin(), rig.animations.end(),
                         [&](const mesh::Animation& each) { return each.name == scene.clip_name; });
    if (found == rig.animations.end()) {
      throw input_error(scene.where, file + " has no clip \"" + scene.clip_name + "\"", known_clips(rig));
    }
  } else if (static_cast<std::size_t>(scene.clip_index) >= rig.animations.size()) {
    throw input_error(scene.where, file + " has no clip " + std::to_string(scene.clip_index),
                      "its clips are 0 to " + std::to_string(rig.animations.size() - 1));
  } else {
    found += scene.clip_index;
  }
  playback.animation = static_cast<std::uint32_t>(found - rig.animations.begin());
  return playback;
}

}  // namespace rinkaku::pipeline
