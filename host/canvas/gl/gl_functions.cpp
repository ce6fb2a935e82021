// EGL and OpenGL ES function pointers, loaded at run time.
#include "host/canvas/gl/gl_functions.h"

#include "host/system/libraries.h"

namespace scree::host {
namespace {

void* egl() {
    static void* const found = load_library(egl_library);
    return found;
}
void* gles() {
    static void* const found = load_library(gles_library);
    return found;
}

}  // namespace

bool EglFunctions::load() {
    if (!egl()) return false;
    bool complete = true;
    eglGetProcAddress = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(function_of(egl(), "eglGetProcAddress"));
    if (!eglGetProcAddress) return false;
#define SCREE_LOAD(name, type)                                              \
    name = reinterpret_cast<PFNEGL##type##PROC>(function_of(egl(), #name)); \
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
    // Prefer the library: before EGL 1.5 eglGetProcAddress returns extension functions only.
    const auto find = [&](const char* name) {
        void* const function = gles() ? function_of(gles(), name) : nullptr;
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
