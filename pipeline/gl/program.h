#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// A linked vertex and fragment shader, or one of these that works alone: a compute shader, or a vertex shader whose
/// results transform feedback keeps.
class Program {
 public:
  Program() = default;

  /// Compiles and links. `name` is for messages; each of `parts` is GLSL text without a #version line, joined in order
  /// after "#version 450 core" and one #define for each of `defines`.
  /// Throws Error (Runtime) with the compiler's first line.
  Program(std::string_view name, std::span<const std::string_view> defines,
          std::span<const std::string_view> vertex_parts, std::span<const std::string_view> fragment_parts);

  /// The same with a compute shader, alone.
  static Program compute(std::string_view name, std::span<const std::string_view> defines,
                         std::span<const std::string_view> parts);
  /// The same with a vertex shader, alone; it says itself where its results go (xfb_offset).
  static Program vertices(std::string_view name, std::span<const std::string_view> defines,
                          std::span<const std::string_view> parts);

  GLuint name() const { return handle_.name(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }

  /// The uniform's location, -1 if the program does not use it. Look it up once, not every frame.
  GLint uniform(const char* uniform_name) const { return glGetUniformLocation(handle_.name(), uniform_name); }

 private:
  static Program alone(GLenum stage, std::string_view name, std::span<const std::string_view> defines,
                       std::span<const std::string_view> parts);
  void link(std::string_view name, std::span<const ShaderHandle> shaders);

  ProgramHandle handle_;
};

}  // namespace rinkaku::gl
