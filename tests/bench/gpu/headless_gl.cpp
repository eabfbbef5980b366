// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "headless_gl.h"

#include "sample.h"

#include <array>
#include <cstdlib>
#include <string>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

namespace anicodec::bench {
namespace {

void* library = nullptr;

template <class Function>
Function egl(const char* name) {
  return reinterpret_cast<Function>(dlsym(library, name));
}

void* find_function(const char* name) {
  return reinterpret_cast<void*>(egl<decltype(&eglGetProcAddress)>("eglGetProcAddress")(name));
}

/// Makes a context of OpenGL 3.3 on a display current.
bool use_display(EGLDisplay display) {
  static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
  if (display == EGL_NO_DISPLAY ||
      !egl<decltype(&eglInitialize)>("eglInitialize")(display, nullptr, nullptr) ||
      !egl<decltype(&eglBindAPI)>("eglBindAPI")(EGL_OPENGL_API))
    return false;
  EGLContext context = egl<decltype(&eglCreateContext)>("eglCreateContext")(
      display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  return context != EGL_NO_CONTEXT && egl<decltype(&eglMakeCurrent)>("eglMakeCurrent")(
                                          display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

/// Devices in their order, in which the software is last, then the platform without a surface.
bool use_any_display() {
  auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(find_function("eglGetPlatformDisplayEXT"));
  auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(find_function("eglQueryDevicesEXT"));
  if (get_display == nullptr)
    return false;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query != nullptr)
    query(static_cast<EGLint>(devices.size()), devices.data(), &count);
  for (EGLint i = 0; i < count; ++i) {
    if (use_display(get_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<size_t>(i)], nullptr)))
      return true;
  }
  return use_display(get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
}

std::string text(GLenum name) {
  const auto* value = reinterpret_cast<const char*>(gl.GetString(name));
  return value == nullptr ? "" : value;
}

bool has(const std::string& in, const char* part) {
  return in.find(part) != std::string::npos;
}

/// The picture, in place of that of a window.
template <class... Size>
bool draw_into_picture(Size... size) {
  const auto gen_buffers =
      reinterpret_cast<PFNGLGENRENDERBUFFERSPROC>(find_function("glGenRenderbuffers"));
  const auto bind_buffer =
      reinterpret_cast<PFNGLBINDRENDERBUFFERPROC>(find_function("glBindRenderbuffer"));
  const auto store =
      reinterpret_cast<PFNGLRENDERBUFFERSTORAGEPROC>(find_function("glRenderbufferStorage"));
  const auto attach = reinterpret_cast<PFNGLFRAMEBUFFERRENDERBUFFERPROC>(
      find_function("glFramebufferRenderbuffer"));
  const auto gen_frame =
      reinterpret_cast<PFNGLGENFRAMEBUFFERSPROC>(find_function("glGenFramebuffers"));
  const auto bind_frame =
      reinterpret_cast<PFNGLBINDFRAMEBUFFERPROC>(find_function("glBindFramebuffer"));
  const auto check_frame =
      reinterpret_cast<PFNGLCHECKFRAMEBUFFERSTATUSPROC>(find_function("glCheckFramebufferStatus"));
  GLuint frame = 0;
  std::array<GLuint, 2> buffers{};
  gen_frame(1, &frame);
  bind_frame(GL_FRAMEBUFFER, frame);
  gen_buffers(2, buffers.data());
  bind_buffer(GL_RENDERBUFFER, buffers[0]);
  store(GL_RENDERBUFFER, GL_RGBA8, size...);
  attach(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  bind_buffer(GL_RENDERBUFFER, buffers[1]);
  store(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size...);
  attach(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  return check_frame(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

}  // namespace

std::string start_headless_gl(bool vulkan, int width, int height) {
  library = dlopen("libEGL.so.1", RTLD_NOW);
  if (library == nullptr)
    return "there is no libEGL.so.1";
  if (vulkan)
    setenv("MESA_LOADER_DRIVER_OVERRIDE", "zink", 1);
  bool started = use_any_display();
  if (vulkan && !started) {  // the software, whose driver of OpenGL has a name of its own
    unsetenv("MESA_LOADER_DRIVER_OVERRIDE");
    setenv("GALLIUM_DRIVER", "zink", 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    started = use_any_display();
  }
  if (!started)
    return vulkan ? "Mesa's zink, which draws by Vulkan, does not start"
                  : "EGL makes no OpenGL 3.3";
  start_gl(find_function, width, height);
  if (vulkan && !has(text(GL_RENDERER), "zink"))
    return "Mesa's zink, which draws by Vulkan, is not used by " + text(GL_RENDERER);
  return draw_into_picture(width, height) ? "" : "no picture of this size can be drawn into";
}

std::string describe_gl() {
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool is_software_gl() {
  const std::string renderer = text(GL_RENDERER);
  return has(renderer, "llvmpipe") || has(renderer, "softpipe") || has(renderer, "SwiftShader");
}

}  // namespace anicodec::bench
