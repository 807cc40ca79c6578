#pragma once

#include <functional>
#include <string>

#include "apps/rinkaku/viewer/scene_file.h"
#include "apps/rinkaku/viewer/tunables.h"

namespace rinkaku::app {

/// Draws one value of the scene as a slider, colour or choice, as long as the scene has its table; `set` is called with
/// its place and TOML text when the user changed it. `above` is where the tunable's table lies. Needs ImGui's frame.
void draw_field(const SceneFile& file, const Tunable& tunable, const toml::Path& above,
                const std::function<void(const toml::Path&, const std::string&)>& set);

}  // namespace rinkaku::app
