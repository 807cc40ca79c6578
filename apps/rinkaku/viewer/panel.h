#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/rinkaku/viewer/arrow_editor.h"
#include "apps/rinkaku/viewer/scene_file.h"
#include "apps/rinkaku/viewer/value_fields.h"
#include "apps/rinkaku/viewer/viewer.h"
#include "pipeline/window/window.h"

namespace rinkaku::app {

/// What the panel shows beside the scene's values.
struct PanelFacts {
  Viewer::Status status;
  const Viewer::Shown* shown = nullptr;  ///< null before the first frame
  double fps = 0;                        ///< shown a second, lately
  double latency_ms = 0;                 ///< from the camera's stamp to the screen, lately; 0 for recordings
  bool paused = false, ended = false;
  Viewer::Look look = Viewer::Look::Picture;
  std::string trouble;            ///< an error that the user should see; empty if there is none
  std::string notice;             ///< the last thing done, e.g. the screenshot's name
  ArrowEditor* arrows = nullptr;  ///< while flow arrows are edited
};

/// What the user asked for in it.
struct PanelWish {
  struct Value {
    toml::Path path;
    std::string text;  ///< TOML
  };
  std::vector<Value> values;
  std::optional<Viewer::Look> look;
  std::optional<std::string> text;  ///< the scene's, with other flow arrows
  bool arrows = false;              ///< edits flow arrows from now on, or no longer
  bool delete_arrow = false, key_arrows = false;
  bool pause = false, step = false, restart = false, screenshot = false, save = false, full_screen = false;
};

/// The panel in a window (Dear ImGui): values of the scene as sliders, times, drops, latency. Needs the window's
/// context.
class Panel {
 public:
  explicit Panel(window::Window& window);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  void toggle() { open_ = !open_; }
  bool open() const { return open_; }
  /// Whether keys go to one of its fields.
  bool wants_keys() const;

  /// Draws it over what is in the window. Trouble is shown even while the panel is closed.
  PanelWish draw(const SceneFile& file, const PanelFacts& facts);

 private:
  void draw_window(const SceneFile& file, const PanelFacts& facts, PanelWish& wish);
  void draw_transport(const SceneFile& file, const PanelFacts& facts, PanelWish& wish);
  void draw_values(const SceneFile& file, PanelWish& wish);
  void draw_water(const SceneFile& file, const PanelFacts& facts, PanelWish& wish);
  void draw_times(const PanelFacts& facts);

  float scale_ = 1;
  bool open_ = true;
  ValueFields fields_;
  std::array<float, pipeline::Work::most_stages> smooth_ms_{};
};

}  // namespace rinkaku::app
