// An offscreen OpenGL ES context.
#include "host/canvas/gl/gl_context.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <sstream>
#include <string_view>

#include "host/system/libraries.h"

namespace scree::host {
namespace {

bool listed(const char* list, std::string_view word) {
    std::istringstream words(list ? list : "");
    for (std::string each; words >> each;) {
        if (each == word) return true;
    }
    return false;
}

std::string text_of(const GLubyte* text) {
    return text ? reinterpret_cast<const char*>(text) : "";
}

}  // namespace

GlContext::GlContext() {
    if (!egl_.load()) {
        throw DeviceError(std::string("no EGL (") + egl_library[0] + ") on this machine: " + egl_cure);
    }
    if (!open_any()) {
        throw DeviceError(
            "no driver for OpenGL ES 3.1 without a window on this machine: apt-get install libegl-mesa0 libgl1-mesa-dri (they "
            "draw on processors, too)");
    }
    const Current current(*this);
    if (const char* const missing = gl_.load(egl_)) {
        const std::string name = missing;
        egl_.eglDestroyContext(display_, context_);
        throw DeviceError("the OpenGL ES driver lacks " + name + ": apt-get install libgles2, or upgrade the driver");
    }
    renderer_ = text_of(gl_.glGetString(GL_RENDERER));
    version_ = text_of(gl_.glGetString(GL_VERSION));
}

// Displays are never terminated: they are shared by the process, and drivers leave exit handlers in them.
GlContext::~GlContext() {
    if (surface_ != EGL_NO_SURFACE) egl_.eglDestroySurface(display_, surface_);
    egl_.eglDestroyContext(display_, context_);
}

// Tries GPUs first, then software: Mesa's surfaceless platform, then the default display.
bool GlContext::open_any() {
    if (open_devices()) return true;
    const char* const extensions = egl_.eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (egl_.eglGetPlatformDisplayEXT != nullptr && listed(extensions, "EGL_MESA_platform_surfaceless") &&
        open(egl_.eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr))) {
        return true;
    }
    return open(egl_.eglGetDisplay(EGL_DEFAULT_DISPLAY));
}

bool GlContext::open_devices() {
    if (!egl_.eglQueryDevicesEXT || !egl_.eglQueryDeviceStringEXT || !egl_.eglGetPlatformDisplayEXT) return false;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (!egl_.eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return false;
    for (const EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(std::max(count, 0)))) {
        if (listed(egl_.eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
        if (open(egl_.eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr))) return true;
    }
    return false;
}

bool GlContext::open(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !egl_.eglInitialize(display, nullptr, nullptr)) return false;
    const bool surfaceless = listed(egl_.eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
    const std::array<EGLint, 5> wishes{EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_ES3_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!egl_.eglBindAPI(EGL_OPENGL_ES_API) || !egl_.eglChooseConfig(display, wishes.data(), &config, 1, &configs) ||
        configs == 0)
        return false;
    EGLContext context = EGL_NO_CONTEXT;
    for (const EGLint minor : {2, 1}) {
        const std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, minor, EGL_NONE};
        if (context == EGL_NO_CONTEXT) context = egl_.eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    }
    if (context == EGL_NO_CONTEXT) return false;
    EGLSurface surface = EGL_NO_SURFACE;
    if (!surfaceless) {
        const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface = egl_.eglCreatePbufferSurface(display, config, size.data());
        if (surface == EGL_NO_SURFACE) {
            egl_.eglDestroyContext(display, context);
            return false;
        }
    }
    display_ = display;
    context_ = context;
    surface_ = surface;
    return true;
}

bool GlContext::is_processor() const {
    std::string low = renderer_;
    std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* const name : {"llvmpipe", "softpipe", "swrast", "software", "swiftshader"}) {
        if (low.find(name) != low.npos) return true;
    }
    return false;
}

bool GlContext::has(const std::string& extension) const {
    return listed(reinterpret_cast<const char*>(gl_.glGetString(GL_EXTENSIONS)), extension);
}

GlContext::Current::Current(const GlContext& context)
    : egl_(context.egl_),
      own_display_(context.display_),
      display_(egl_.eglGetCurrentDisplay()),
      draw_(egl_.eglGetCurrentSurface(EGL_DRAW)),
      read_(egl_.eglGetCurrentSurface(EGL_READ)),
      context_(egl_.eglGetCurrentContext()) {
    if (!egl_.eglMakeCurrent(own_display_, context.surface_, context.surface_, context.context_)) {
        std::ostringstream message;
        message << "OpenGL ES: the context cannot be used by this thread (EGL error 0x" << std::hex << egl_.eglGetError() << ")";
        throw DeviceError(message.str());
    }
}

GlContext::Current::~Current() {
    if (context_ == EGL_NO_CONTEXT) {
        egl_.eglMakeCurrent(own_display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    } else {
        egl_.eglMakeCurrent(display_, draw_, read_, context_);
    }
}

}  // namespace scree::host
