// An offscreen OpenGL ES context.
#pragma once

#include <string>

#include "host/canvas/gl/gl_functions.h"
#include "host/device_error.h"

namespace scree::host {

class GlContext {
public:
    // Opens OpenGL ES 3.1 or later, on a GPU if EGL lists one, else in software. Throws DeviceError naming the
    // package to install.
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    // Makes the context current on the calling thread for the object's lifetime, then restores the previous one.
    class Current {
    public:
        explicit Current(const GlContext& context);
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        const EglFunctions& egl_;
        EGLDisplay own_display_, display_;
        EGLSurface draw_, read_;
        EGLContext context_;
    };

    const GlFunctions& gl() const { return gl_; }
    const std::string& renderer() const { return renderer_; }  // "llvmpipe (LLVM 15.0.6, 256 bits)"
    const std::string& version() const { return version_; }    // "OpenGL ES 3.2 Mesa 22.3.6"
    bool is_processor() const;                                 // a software renderer
    bool has(const std::string& extension) const;              // requires the context to be current

private:
    bool open(EGLDisplay display);
    bool open_any();
    bool open_devices();

    EglFunctions egl_;
    GlFunctions gl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;  // 1 x 1 pbuffer, where surfaceless contexts are not supported
    std::string renderer_, version_;
};

}  // namespace scree::host
