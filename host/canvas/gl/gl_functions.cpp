// The functions of EGL and OpenGL ES that are used, as pointers: looked up at run time.
#include "host/canvas/gl/gl_functions.h"

#include <dlfcn.h>

namespace scree::host {
namespace {

// Never closed: drivers leave threads and exit handlers behind in them.
void* library(const char* name) {
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
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
    // From the library where it has them: an older EGL hands out extensions only.
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
