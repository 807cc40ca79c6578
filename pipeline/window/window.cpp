#include "pipeline/window/window.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's declarations.
#include <GLFW/glfw3.h>

#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"

namespace rinkaku::window {
namespace {

constexpr const char* no_display = "start it on a desktop, or under xvfb-run; 'rinkaku render' needs no display";

std::string reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason is given";
}

Key meaning(int key) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return Key::Pause;
    case GLFW_KEY_PERIOD:
    case GLFW_KEY_RIGHT:
      return Key::Step;
    case GLFW_KEY_F:
    case GLFW_KEY_F11:
      return Key::FullScreen;
    case GLFW_KEY_TAB:
      return Key::Panel;
    case GLFW_KEY_Q:
    case GLFW_KEY_ESCAPE:
      return Key::Quit;
    case GLFW_KEY_P:
      return Key::Screenshot;
    case GLFW_KEY_V:
      return Key::Look;
    case GLFW_KEY_A:
      return Key::Arrows;
    case GLFW_KEY_DELETE:
    case GLFW_KEY_BACKSPACE:
      return Key::Delete;
    case GLFW_KEY_HOME:
      return Key::Restart;
    default:
      return Key::Other;
  }
}

}  // namespace

std::unique_ptr<Window> Window::open(const std::string& title, int width_px, int height_px) {
  if (glfwInit() != GLFW_TRUE) throw runtime_failure("window", "can't be opened: " + reason(), no_display);
  std::unique_ptr<Window> self(new Window);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  // The same window system interface as drawing uses.
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    const double fit = std::min({1.0, static_cast<double>(width) / width_px, static_cast<double>(height) / height_px});
    width_px = std::max(1, static_cast<int>(width_px * fit));
    height_px = std::max(1, static_cast<int>(height_px * fit));
  }
  self->window_ = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
  if (!self->window_) {
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_NATIVE_CONTEXT_API);
    self->window_ = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
  }
  if (!self->window_) throw runtime_failure("window", "OpenGL 4.5 can't be had: " + reason(), no_display);
  glfwMakeContextCurrent(self->window_);
  // A frame is shown when it comes; the screen's own beat would add to the latency.
  glfwSwapInterval(0);
  glfwSetWindowUserPointer(self->window_, self.get());
  glfwSetKeyCallback(self->window_, on_key);
  self->software_ = gl::draws_in_software();
  return self;
}

Window::~Window() {
  if (window_) glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::on_key(GLFWwindow* window, int key, int /*scancode*/, int action, int mods) {
  if (action == GLFW_RELEASE) return;
  auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
  if (key == GLFW_KEY_S && mods & GLFW_MOD_CONTROL) {
    self->keys_.push_back(Key::Save);
  } else if (const Key meant = meaning(key); meant != Key::Other) {
    // Held down, only stepping goes on.
    if (action == GLFW_PRESS || meant == Key::Step) self->keys_.push_back(meant);
  }
}

void Window::wait(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

void Window::wake() { glfwPostEmptyEvent(); }

std::vector<Key> Window::take_keys() { return std::exchange(keys_, {}); }

bool Window::closed() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::framebuffer_size(int& width_px, int& height_px) const {
  glfwGetFramebufferSize(window_, &width_px, &height_px);
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(x, 0.5f, 4.0f);
}

void Window::toggle_full_screen() {
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::swap() { glfwSwapBuffers(window_); }

}  // namespace rinkaku::window
