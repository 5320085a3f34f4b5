#include "gpu/gl/error.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace lkao::gl {
namespace {

std::string name_of(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return fmt::format("{:#x}", error);
  }
}

// A context made by GLX, as windows of X11 have it. Asked without linking GLX: where it is not loaded, nobody uses it.
bool has_glx_context() {
  for (const char* library : {"libGLX.so.0", "libGL.so.1"}) {
    void* handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) continue;
    const auto current = reinterpret_cast<void* (*)()>(dlsym(handle, "glXGetCurrentContext"));
    const bool has_one = current != nullptr && current() != nullptr;
    dlclose(handle);
    if (has_one) return true;
  }
  return false;
}

void drop_errors() {
  // Without a context glGetError never comes to an end.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
}

}  // namespace

void check_errors(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  drop_errors();
  throw std::runtime_error(fmt::format("OpenGL error {} while {}", name_of(error), doing));
}

bool has_context() { return eglGetCurrentContext() != EGL_NO_CONTEXT || has_glx_context(); }

void require_context() {
  if (!has_context()) throw std::runtime_error("no OpenGL context is current in this thread");
  const int version = epoxy_gl_version();
  if (!epoxy_is_desktop_gl() || version < 45) {
    throw std::runtime_error(fmt::format("OpenGL 4.5 is needed; this context has {}{}.{}",
                                         epoxy_is_desktop_gl() ? "" : "OpenGL ES ", version / 10, version % 10));
  }
}

void require_clean_context(HostErrors host_errors) {
  require_context();
  if (host_errors == HostErrors::dropped) return drop_errors();
  check_errors("something before lkao was called");
}

}  // namespace lkao::gl
