#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// Where the vertices of what moves are made; Auto: by what OpenGL runs on.
enum class Skinning { Auto, Cpu, Gpu };

/// animation of [[object]]: which clip of its mesh is played, in time with the video.
struct AnimationScene {
  std::string clip_name;        ///< empty: by number
  std::int64_t clip_index = 0;  ///< in the file's order
  bool loop = true;
  double start_s = 0;  ///< the video's time at which the clip begins
  double speed = 1;
  Skinning skinning = Skinning::Auto;
  std::string where;  ///< "file:line:column", for what is found wrong once the mesh is read
};

toml::Schema animation_schema();

/// Empty if there is none, or for `animation = false`; `true` stands for the first clip. Throws Error (Input).
std::optional<AnimationScene> read_animation(const toml::Table& object);

}  // namespace rinkaku::pipeline
