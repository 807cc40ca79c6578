#pragma once

#include <memory>
#include <string>

namespace rinkaku::gl {

/// How many GL objects this process has made so far. The plan's tests read it: what a scene does not need is never
/// made.
struct Made {
  int contexts = 0;
  int programs = 0;
  int buffers = 0;
  int textures = 0;
  int targets = 0;
  bool operator==(const Made&) const = default;
};
Made made();

/// Whether the current context draws on the CPU (Mesa's llvmpipe or softpipe).
bool draws_in_software();

/// An OpenGL 4.5 core context without a window (EGL, surfaceless), current on the thread that made it until destroyed.
/// Destroy it on the same thread, after everything made in it.
class Context {
 public:
  /// Throws Error (Runtime) if the machine has no OpenGL 4.5.
  static std::unique_ptr<Context> headless();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const std::string& renderer() const { return renderer_; }
  /// OpenGL's and the driver's version, e.g. "4.5 (Core Profile) Mesa 22.3.6".
  const std::string& version() const { return version_; }
  /// See draws_in_software().
  bool software() const { return software_; }

 private:
  Context() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_, version_;
  bool software_ = false;
};

}  // namespace rinkaku::gl
