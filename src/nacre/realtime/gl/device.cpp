#include "nacre/realtime/gl/device.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <vector>

#include "nacre/math/error.h"

namespace nacre {
namespace {

std::string text_of(GLenum what) {
    const auto* text = reinterpret_cast<const char*>(glGetString(what));
    return text ? text : "";
}

EGLContext make_context(EGLDisplay display) {
    if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
                                 EGL_NONE};
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, wanted, &config, 1, &count);
    return eglCreateContext(display, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT,
                            attributes);
}

/// Displays without a screen, the hardware's first: a device that calls itself software comes
/// after all that do not.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> hardware, software;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        EGLDeviceEXT devices[32];
        EGLint count = 0;
        if (!eglQueryDevicesEXT(32, devices, &count)) count = 0;
        for (EGLint i = 0; i < count; ++i) {
            const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
            const bool is_software =
                extensions && std::string_view(extensions).find("EGL_MESA_device_software") !=
                                  std::string_view::npos;
            (is_software ? software : hardware)
                .push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
        }
    }
    hardware.insert(hardware.end(), software.begin(), software.end());
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        hardware.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return hardware;
}

}  // namespace

std::string GpuDevice::text() const { return software ? name + " [software]" : name; }

GpuDevice current_device() {
    if (const int version = epoxy_gl_version(); version < 45)
        throw RunError(fmt::format(
            "OpenGL {}.{} of {} is too old: frames in real time need 4.5; update the driver, or "
            "render with an offline technique",
            version / 10, version % 10, text_of(GL_RENDERER)));
    GpuDevice device{.name = text_of(GL_RENDERER), .version = text_of(GL_VERSION)};
    for (const std::string_view software : {"llvmpipe", "softpipe", "swrast", "SwiftShader"})
        device.software |= device.name.find(software) != std::string::npos;
    return device;
}

HeadlessContext::HeadlessContext() {
    int tried = 0;
    for (EGLDisplay display : displays()) {
        ++tried;
        EGLint major = 0, minor = 0;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) continue;
        // Not all drivers can be current without a surface.
        EGLContext context = make_context(display);
        if (context == EGL_NO_CONTEXT) continue;
        display_ = display;
        context_ = context;
        EGLDisplay before = eglGetCurrentDisplay();
        EGLContext before_context = eglGetCurrentContext();
        EGLSurface draw = eglGetCurrentSurface(EGL_DRAW), read = eglGetCurrentSurface(EGL_READ);
        const bool works = eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
        if (before != EGL_NO_DISPLAY)
            eglMakeCurrent(before, draw, read, before_context);
        else if (works)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (works) return;
        eglDestroyContext(display, context);
        display_ = context_ = nullptr;
    }
    throw RunError(
        fmt::format("no OpenGL 4.5 without a window: {} EGL {} tried; install a driver (Debian: "
                    "libgl1-mesa-dri renders in software), or render with an offline technique",
                    tried, tried == 1 ? "display was" : "displays were"));
}

HeadlessContext::~HeadlessContext() {
    // The display is shared by all who ask for it in this process: it stays.
    eglDestroyContext(display_, context_);
}

HeadlessContext::Use::Use(const HeadlessContext& context)
    : display_(eglGetCurrentDisplay()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      context_(eglGetCurrentContext()),
      own_display_(context.display_) {
    if (!eglMakeCurrent(context.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_))
        throw RunError(fmt::format("the OpenGL context was lost (EGL error {:#x})", eglGetError()));
}

HeadlessContext::Use::~Use() {
    if (context_)
        eglMakeCurrent(display_, draw_, read_, context_);
    else
        eglMakeCurrent(own_display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace nacre
