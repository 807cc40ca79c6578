#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace rinkaku::gl {

/// A GL object's name, owned: move-only, freed with `Free`. Needs the context that made it to be current.
template <void (*Free)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_ != 0) Free(name_);
  }
  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

inline void free_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void free_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void free_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
inline void free_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void free_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void free_program(GLuint name) { glDeleteProgram(name); }
inline void free_shader(GLuint name) { glDeleteShader(name); }

using BufferHandle = Handle<free_buffer>;
using TextureHandle = Handle<free_texture>;
using RenderbufferHandle = Handle<free_renderbuffer>;
using FramebufferHandle = Handle<free_framebuffer>;
using VertexArrayHandle = Handle<free_vertex_array>;
using ProgramHandle = Handle<free_program>;
using ShaderHandle = Handle<free_shader>;

inline VertexArrayHandle make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArrayHandle(name);
}
inline FramebufferHandle make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return FramebufferHandle(name);
}

}  // namespace rinkaku::gl
