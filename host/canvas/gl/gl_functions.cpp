// EGL and OpenGL ES function pointers, loaded at run time.
#include "host/canvas/gl/gl_functions.h"

#include <dlfcn.h>

namespace scree::host {
namespace {

// Never unloaded: drivers leave threads and exit handlers in the library.
void* library(const char* name) {
#ifdef __EMSCRIPTEN__  // whose dlopen() ends the program
    return static_cast<void>(name), nullptr;
#else
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
#endif
}
void* egl_library() {
    static void* const found = library("libEGL.so.1");
    return found;
}
void* gles_library() {
    static void* const found = library("libGLESv2.so.2");
    return found;
}

}  // namespace

bool EglFunctions::load() {
    if (!egl_library()) return false;
    bool complete = true;
    eglGetProcAddress = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(dlsym(egl_library(), "eglGetProcAddress"));
    if (!eglGetProcAddress) return false;
#define SCREE_LOAD(name, type)                                                \
    name = reinterpret_cast<PFNEGL##type##PROC>(dlsym(egl_library(), #name)); \
    complete = complete && name;
    SCREE_EGL_FUNCTIONS(SCREE_LOAD)
#undef SCREE_LOAD
    if (!complete) return false;
    eglGetPlatformDisplayEXT = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    eglQueryDevicesEXT = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    eglQueryDeviceStringEXT = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    return true;
}

const char* GlFunctions::load(const EglFunctions& egl) {
    const char* missing = nullptr;
    // Prefer dlsym: before EGL 1.5 eglGetProcAddress returns extension functions only.
    const auto find = [&](const char* name) {
        void* const function = gles_library() ? dlsym(gles_library(), name) : nullptr;
        return function ? reinterpret_cast<void (*)()>(function) : reinterpret_cast<void (*)()>(egl.eglGetProcAddress(name));
    };
#define SCREE_LOAD(name, type)                               \
    name = reinterpret_cast<PFNGL##type##PROC>(find(#name)); \
    if (!name) missing = #name;
    SCREE_GL_FUNCTIONS(SCREE_LOAD)
#undef SCREE_LOAD
    glClipControlEXT = reinterpret_cast<PFNGLCLIPCONTROLEXTPROC>(egl.eglGetProcAddress("glClipControlEXT"));
    return missing;
}

}  // namespace scree::host
