#include "pipeline/gl/context.h"

#include <string_view>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"

namespace rinkaku::gl {
namespace {

constexpr const char* remedy =
    "install Mesa's drivers (Debian: libgl1-mesa-dri libegl1) or a GPU driver with OpenGL 4.5";

EGLDisplay open_display() {
  EGLDisplay display = EGL_NO_DISPLAY;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  }
  display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  throw runtime_failure("EGL", "no display could be opened", remedy);
}

}  // namespace

Counters& counters() {
  static Counters all;
  return all;
}

Made made() {
  const Counters& c = counters();
  return {c.contexts, c.programs, c.buffers, c.textures, c.targets};
}

std::unique_ptr<Context> Context::headless() {
  std::unique_ptr<Context> self(new Context);
  EGLDisplay display = open_display();
  self->display_ = display;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) throw runtime_failure("EGL", "desktop OpenGL is not supported", remedy);
  const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint found = 0;
  eglChooseConfig(display, config_wish, &config, 1, &found);
  const EGLint context_wish[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = eglCreateContext(display, found > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, context_wish);
  if (context == EGL_NO_CONTEXT) throw runtime_failure("EGL", "no OpenGL 4.5 core context could be made", remedy);
  self->context_ = context;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    throw runtime_failure("EGL", "the context can't be used without a surface", remedy);
  }
  ++counters().contexts;
  self->renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  self->version_ = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  self->software_ = draws_in_software();
  return self;
}

bool draws_in_software() {
  const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos;
}

Context::~Context() {
  if (context_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  // The display is shared by the whole process and stays open.
}

}  // namespace rinkaku::gl
