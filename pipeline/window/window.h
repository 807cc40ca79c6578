#pragma once

#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace rinkaku::window {

/// What a user does to a window, apart from its panel.
enum class Key { Pause, Step, FullScreen, Panel, Quit, Screenshot, Restart, Save, Look, Arrows, Delete, Other };

/// A window with an OpenGL 4.5 core context, current on the thread that made it; all its functions are for the main
/// thread, and only one can be open.
class Window {
 public:
  /// `width_px` and `height_px` of the picture; the window is smaller where the screen is.
  /// Throws Error (Runtime) if there is no display or no OpenGL 4.5.
  static std::unique_ptr<Window> open(const std::string& title, int width_px, int height_px);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits up to `seconds` for something to happen, then takes it in. wake() ends the wait.
  void wait(double seconds);
  /// Any thread.
  static void wake();

  /// The keys that were pressed since, in order. Those that the panel wants are its own: it says so by `for_panel`.
  std::vector<Key> take_keys();
  bool closed() const;

  void framebuffer_size(int& width_px, int& height_px) const;
  /// Of text and panel: 2 on screens with small pixels.
  float scale() const;
  void toggle_full_screen();
  void set_title(const std::string& title);
  void swap();
  bool software() const { return software_; }
  GLFWwindow* handle() const { return window_; }

 private:
  Window() = default;
  static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);

  GLFWwindow* window_ = nullptr;
  std::vector<Key> keys_;
  bool software_ = false;
  int windowed_[4] = {};  // place and size before it filled the screen
};

}  // namespace rinkaku::window
