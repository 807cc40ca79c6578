#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/rinkaku/viewer/scene_file.h"
#include "apps/rinkaku/viewer/tunables.h"

namespace rinkaku::app {

/// Values of the scene as sliders, colours and choices. Objects and light change while a slider moves; what takes
/// longer to draw anew (water), or begins the run anew (all else), when it is let go. Needs ImGui's frame.
class ValueFields {
 public:
  using Setter = std::function<void(const toml::Path&, const std::string&)>;

  /// Draws one, as long as the scene has its table; `set` is called with its place and TOML text when the user changed
  /// it. `above` is where the tunable's table lies.
  void draw(const SceneFile& file, const Tunable& tunable, const toml::Path& above, const Setter& set);
  /// After those drawn: sets what was let go.
  void let_go(const Setter& set);

 private:
  struct Held {
    toml::Path path;
    std::string text;
  };
  std::optional<Held> held_;
};

}  // namespace rinkaku::app
