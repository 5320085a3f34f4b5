// An OpenGL context without a window.
#pragma once

#include <memory>
#include <string>

#include "lkao/export.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

enum class Device {
  automatic,  // hardware where there is any, else software
  hardware,   // a GPU
  software,   // a rasteriser on the CPU, such as Mesa's llvmpipe
};

// An OpenGL 4.5 core context that draws into framebuffer objects only, made through EGL without any window system.
// Contexts share nothing with each other. For programs without a window (tests, batch rendering); a renderer that has
// a context of its own needs none of this.
//
// Threads: a context is current in one thread at a time, as OpenGL wants it. Different contexts may be used in
// different threads at the same time.
class LKAO_API HeadlessContext {
 public:
  // Leaves the calling thread's current context as it was: call make_current() before the first OpenGL call.
  // Throws std::runtime_error with one line where EGL offers no such device or it cannot do OpenGL 4.5.
  explicit HeadlessContext(Device device = Device::automatic);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  // Makes this context the calling thread's current one. Throws std::runtime_error where it cannot be, for example
  // because it is current in another thread.
  void make_current();
  // Both for programs without exceptions; `try_make` gives none where it fails.
  static std::unique_ptr<HeadlessContext> try_make(Device device, Status& status) noexcept;
  Status try_make_current() noexcept;
  // Leaves the calling thread without a current context. Does nothing where this one is not current there.
  void release();

  // What the driver calls itself: GL_RENDERER and GL_VERSION.
  const std::string& renderer() const { return renderer_; }
  const std::string& version() const { return version_; }
  // True where the CPU rasterises.
  bool is_software() const { return is_software_; }

 private:
  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
  std::string renderer_;
  std::string version_;
  bool is_software_ = false;
};

}  // namespace lkao::gl
