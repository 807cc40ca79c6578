#include "pipeline/gl/program.h"

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"
#include "pipeline/gl/shader_text.h"

namespace rinkaku::gl {
namespace {

ShaderHandle compile(GLenum stage, std::string_view name, std::span<const std::string_view> defines,
                     std::span<const std::string_view> parts) {
  std::string text = "#version 450 core\n";
  for (std::string_view define : defines) text.append("#define ").append(define).append("\n");
  for (std::string_view part : parts) text.append(shader_text(part)).append("\n");
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
                 std::span<const std::string_view> vertex_parts, std::span<const std::string_view> fragment_parts) {
  const ShaderHandle shaders[] = {compile(GL_VERTEX_SHADER, name, defines, vertex_parts),
                                  compile(GL_FRAGMENT_SHADER, name, defines, fragment_parts)};
  link(name, shaders);
}

Program Program::compute(std::string_view name, std::span<const std::string_view> defines,
                         std::span<const std::string_view> parts) {
  return alone(GL_COMPUTE_SHADER, name, defines, parts);
}

Program Program::vertices(std::string_view name, std::span<const std::string_view> defines,
                          std::span<const std::string_view> parts) {
  return alone(GL_VERTEX_SHADER, name, defines, parts);
}

Program Program::alone(GLenum stage, std::string_view name, std::span<const std::string_view> defines,
                       std::span<const std::string_view> parts) {
  const ShaderHandle shaders[] = {compile(stage, name, defines, parts)};
  Program program;
  program.link(name, shaders);
  return program;
}

void Program::link(std::string_view name, std::span<const ShaderHandle> shaders) {
  handle_ = ProgramHandle(glCreateProgram());
  for (const ShaderHandle& shader : shaders) glAttachShader(handle_.name(), shader.name());
  glLinkProgram(handle_.name());
  for (const ShaderHandle& shader : shaders) glDetachShader(handle_.name(), shader.name());
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
