#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "gpu/gl/status_of.h"
#include "lkao/gl/context.h"

namespace lkao::gl {
namespace {

// Displays are never terminated: EGL counts no users of a display, and eglTerminate would take away the other contexts
// on the same device.

// The GPUs first, then the software devices, then whatever Mesa finds by itself.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> hardware;
  std::vector<EGLDisplay> software;
  // Epoxy aborts on functions that are not there, so every extension is asked for first.
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) return {};
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint device_count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &device_count) != EGL_TRUE) {
      device_count = 0;
    }
    for (EGLint i = 0; i < device_count; ++i) {
      EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
      const bool is_software =
          extensions != nullptr && std::string(extensions).find("EGL_MESA_device_software") != std::string::npos;
      EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      if (display != EGL_NO_DISPLAY) (is_software ? software : hardware).push_back(display);
    }
  }
  std::vector<EGLDisplay> displays = hardware;
  displays.insert(displays.end(), software.begin(), software.end());
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY) displays.push_back(display);
  }
  return displays;
}

// EGL_NO_CONTEXT where the display cannot do it.
EGLContext create_context(EGLDisplay display) {
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return EGL_NO_CONTEXT;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") || eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
    return EGL_NO_CONTEXT;
  }
  // No surface is ever made, so any kind of surface will do; the default would ask for windows.
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint config_count = 0;
  if (eglChooseConfig(display, config_attributes, &config, 1, &config_count) != EGL_TRUE || config_count == 0) {
    return EGL_NO_CONTEXT;
  }
  const EGLint context_attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
}

// Puts the calling thread's current context back at the end of a scope.
class CurrentContextKeeper {
 public:
  CurrentContextKeeper()
      : display_(eglGetCurrentDisplay()),
        context_(eglGetCurrentContext()),
        draw_(eglGetCurrentSurface(EGL_DRAW)),
        read_(eglGetCurrentSurface(EGL_READ)) {}
  ~CurrentContextKeeper() {
    if (display_ != EGL_NO_DISPLAY) {
      eglMakeCurrent(display_, draw_, read_, context_);
    } else if (eglGetCurrentDisplay() != EGL_NO_DISPLAY) {
      eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
  }
  CurrentContextKeeper(const CurrentContextKeeper&) = delete;
  CurrentContextKeeper& operator=(const CurrentContextKeeper&) = delete;

 private:
  EGLDisplay display_;
  EGLContext context_;
  EGLSurface draw_;
  EGLSurface read_;
};

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

// Mesa's rasterisers on the CPU, under whatever layer ("zink Vulkan 1.3 (llvmpipe ...)").
bool names_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR "}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

const char* name_of(Device device) {
  switch (device) {
    case Device::hardware:
      return "hardware ";
    case Device::software:
      return "software ";
    case Device::automatic:
      break;
  }
  return "";
}

}  // namespace

HeadlessContext::HeadlessContext(Device device) {
  const CurrentContextKeeper keeper;
  std::string seen;
  for (EGLDisplay display : candidate_displays()) {
    EGLContext context = create_context(display);
    if (context == EGL_NO_CONTEXT) continue;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
      eglDestroyContext(display, context);
      continue;
    }
    renderer_ = gl_string(GL_RENDERER);
    version_ = gl_string(GL_VERSION);
    is_software_ = names_software(renderer_);
    if (device == Device::automatic || is_software_ == (device == Device::software)) {
      display_ = display;
      context_ = context;
      return;
    }
    seen = renderer_;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
  throw std::runtime_error(std::string("cannot create an OpenGL 4.5 context: EGL offers no ") + name_of(device) +
                           "device that can do it" + (seen.empty() ? "" : " (only " + seen + ")"));
}

HeadlessContext::~HeadlessContext() {
  release();
  eglDestroyContext(display_, context_);
}

void HeadlessContext::make_current() {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    throw std::runtime_error("cannot make the OpenGL context of " + renderer_ +
                             " current: is it current in another thread?");
  }
}

std::unique_ptr<HeadlessContext> HeadlessContext::try_make(Device device, Status& status) noexcept {
  std::unique_ptr<HeadlessContext> context;
  status = status_of([&] { context = std::make_unique<HeadlessContext>(device); });
  return context;
}

Status HeadlessContext::try_make_current() noexcept {
  return status_of([&] { make_current(); });
}

void HeadlessContext::release() {
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}

}  // namespace lkao::gl
