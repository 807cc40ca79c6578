#include "pipeline/gl/program.h"

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"

namespace rinkaku::gl {
namespace {

ShaderHandle compile(GLenum stage, std::string_view name, std::span<const std::string_view> defines,
                     std::span<const std::string_view> parts) {
  std::string text = "#version 450 core\n";
  for (std::string_view define : defines) text.append("#define ").append(define).append("\n");
  for (std::string_view part : parts) text.append(part).append("\n");
  ShaderHandle shader(glCreateShader(stage));
  const char* source = text.c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok != GL_TRUE) {
    char log[2048] = "";
    glGetShaderInfoLog(shader.name(), sizeof log, nullptr, log);
    throw runtime_failure(std::string("shader ") + std::string(name), log,
                          "report this with your OpenGL driver's name");
  }
  return shader;
}

}  // namespace

Program::Program(std::string_view name, std::span<const std::string_view> defines,
                 std::span<const std::string_view> vertex_parts, std::span<const std::string_view> fragment_parts)
    : handle_(glCreateProgram()) {
  const ShaderHandle vertex = compile(GL_VERTEX_SHADER, name, defines, vertex_parts);
  const ShaderHandle fragment = compile(GL_FRAGMENT_SHADER, name, defines, fragment_parts);
  glAttachShader(handle_.name(), vertex.name());
  glAttachShader(handle_.name(), fragment.name());
  glLinkProgram(handle_.name());
  glDetachShader(handle_.name(), vertex.name());
  glDetachShader(handle_.name(), fragment.name());
  GLint ok = GL_FALSE;
  glGetProgramiv(handle_.name(), GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE) {
    char log[2048] = "";
    glGetProgramInfoLog(handle_.name(), sizeof log, nullptr, log);
    throw runtime_failure(std::string("shader ") + std::string(name), log,
                          "report this with your OpenGL driver's name");
  }
  ++counters().programs;
}

}  // namespace rinkaku::gl
