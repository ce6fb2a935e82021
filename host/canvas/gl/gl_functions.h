// EGL and OpenGL ES function pointers, loaded at run time so that the program starts without either.
#pragma once

#ifndef EGL_NO_X11
#define EGL_NO_X11
#endif
#ifndef EGL_EGL_PROTOTYPES
#define EGL_EGL_PROTOTYPES 0
#endif
#ifndef GL_GLES_PROTOTYPES
#define GL_GLES_PROTOTYPES 0
#endif
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
// Uses types of gl32.h, so must follow it.
#include <GLES2/gl2ext.h>

namespace scree::host {

// clang-format off
#define SCREE_EGL_FUNCTIONS(X) \
    X(eglGetDisplay, GETDISPLAY) X(eglInitialize, INITIALIZE) X(eglBindAPI, BINDAPI) X(eglChooseConfig, CHOOSECONFIG) \
    X(eglCreateContext, CREATECONTEXT) X(eglDestroyContext, DESTROYCONTEXT) X(eglMakeCurrent, MAKECURRENT) \
    X(eglGetCurrentContext, GETCURRENTCONTEXT) X(eglGetCurrentDisplay, GETCURRENTDISPLAY) \
    X(eglGetCurrentSurface, GETCURRENTSURFACE) \
    X(eglCreatePbufferSurface, CREATEPBUFFERSURFACE) X(eglDestroySurface, DESTROYSURFACE) \
    X(eglQueryString, QUERYSTRING) X(eglGetError, GETERROR)

#define SCREE_GL_FUNCTIONS(X) \
    X(glActiveTexture, ACTIVETEXTURE) X(glAttachShader, ATTACHSHADER) X(glBindBuffer, BINDBUFFER) \
    X(glBindBufferBase, BINDBUFFERBASE) X(glBindFramebuffer, BINDFRAMEBUFFER) X(glBindRenderbuffer, BINDRENDERBUFFER) \
    X(glBindTexture, BINDTEXTURE) X(glBindVertexArray, BINDVERTEXARRAY) X(glBlendFuncSeparate, BLENDFUNCSEPARATE) \
    X(glBlitFramebuffer, BLITFRAMEBUFFER) X(glBufferData, BUFFERDATA) X(glBufferSubData, BUFFERSUBDATA) \
    X(glCheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS) X(glColorMask, COLORMASK) X(glClear, CLEAR) X(glClearBufferuiv, CLEARBUFFERUIV) X(glClearColor, CLEARCOLOR) \
    X(glClearDepthf, CLEARDEPTHF) X(glCompileShader, COMPILESHADER) X(glCreateProgram, CREATEPROGRAM) \
    X(glCreateShader, CREATESHADER) X(glCullFace, CULLFACE) X(glDeleteShader, DELETESHADER) X(glDeleteFramebuffers, DELETEFRAMEBUFFERS) \
    X(glDeleteRenderbuffers, DELETERENDERBUFFERS) X(glDepthFunc, DEPTHFUNC) \
    X(glDepthMask, DEPTHMASK) X(glDisable, DISABLE) X(glDispatchCompute, DISPATCHCOMPUTE) X(glDrawArraysInstanced, DRAWARRAYSINSTANCED) \
    X(glDrawElementsIndirect, DRAWELEMENTSINDIRECT) X(glMemoryBarrier, MEMORYBARRIER) \
    X(glDrawElementsInstanced, DRAWELEMENTSINSTANCED) X(glEnable, ENABLE) X(glFramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER) \
    X(glFramebufferTexture2D, FRAMEBUFFERTEXTURE2D) X(glFrontFace, FRONTFACE) X(glGenBuffers, GENBUFFERS) \
    X(glGenFramebuffers, GENFRAMEBUFFERS) X(glGenRenderbuffers, GENRENDERBUFFERS) X(glGenTextures, GENTEXTURES) \
    X(glGenVertexArrays, GENVERTEXARRAYS) X(glGetError, GETERROR) X(glGetIntegerv, GETINTEGERV) \
    X(glGetInteger64v, GETINTEGER64V) X(glGetProgramInfoLog, GETPROGRAMINFOLOG) X(glGetProgramiv, GETPROGRAMIV) \
    X(glGetShaderInfoLog, GETSHADERINFOLOG) X(glGetShaderiv, GETSHADERIV) X(glGetString, GETSTRING) \
    X(glGetStringi, GETSTRINGI) X(glGetUniformLocation, GETUNIFORMLOCATION) X(glLinkProgram, LINKPROGRAM) \
    X(glMapBufferRange, MAPBUFFERRANGE) X(glUnmapBuffer, UNMAPBUFFER) X(glPixelStorei, PIXELSTOREI) X(glReadPixels, READPIXELS) \
    X(glRenderbufferStorageMultisample, RENDERBUFFERSTORAGEMULTISAMPLE) X(glShaderSource, SHADERSOURCE) \
    X(glTexParameterfv, TEXPARAMETERFV) X(glTexParameteri, TEXPARAMETERI) X(glTexStorage2D, TEXSTORAGE2D) \
    X(glTexSubImage2D, TEXSUBIMAGE2D) X(glUniform1i, UNIFORM1I) X(glUniform1ui, UNIFORM1UI) X(glUseProgram, USEPROGRAM) \
    X(glViewport, VIEWPORT)
// clang-format on

struct EglFunctions {
    PFNEGLGETPROCADDRESSPROC eglGetProcAddress = nullptr;
#define SCREE_EGL_POINTER(name, type) PFNEGL##type##PROC name = nullptr;
    SCREE_EGL_FUNCTIONS(SCREE_EGL_POINTER)
#undef SCREE_EGL_POINTER
    // Extension functions; null where not supported.
    PFNEGLGETPLATFORMDISPLAYEXTPROC eglGetPlatformDisplayEXT = nullptr;
    PFNEGLQUERYDEVICESEXTPROC eglQueryDevicesEXT = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC eglQueryDeviceStringEXT = nullptr;

    // Opens libEGL.so.1 (once per process). False if not found.
    bool load();
};

// Call these with a context current; the pointers are valid for all contexts.
struct GlFunctions {
#define SCREE_GL_POINTER(name, type) PFNGL##type##PROC name = nullptr;
    SCREE_GL_FUNCTIONS(SCREE_GL_POINTER)
#undef SCREE_GL_POINTER
    PFNGLCLIPCONTROLEXTPROC glClipControlEXT = nullptr;  // EXT_clip_control; may be null

    // Returns the name of a missing function, or null.
    const char* load(const EglFunctions& egl);
};

}  // namespace scree::host
