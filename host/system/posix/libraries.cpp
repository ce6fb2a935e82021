// Shared libraries of POSIX.
#include "host/system/libraries.h"

#include <dlfcn.h>

namespace scree::host {

// The last is that of the portable archive (demos/packaging/bundle.cmake).
const char* const vulkan_library[] = {"libvulkan.so.1", "libvulkan.so", "$ORIGIN/fallback/libvulkan.so.1", nullptr};
const char* const egl_library[] = {"libEGL.so.1", nullptr};
const char* const gles_library[] = {"libGLESv2.so.2", nullptr};

const char* const vulkan_cure = "apt-get install libvulkan1 mesa-vulkan-drivers (with lavapipe, which runs on the CPU)";
const char* const egl_cure = "apt-get install libegl1 libgles2 libgl1-mesa-dri";
const char* const ffmpeg_cure = "apt-get install ffmpeg";

const bool has_modules = true;

void* load_library(const char* const* names) {
#ifdef __EMSCRIPTEN__  // whose dlopen() ends the program
    return nullptr;
#endif
    for (; *names; ++names)
        if (void* const found = ::dlopen(*names, RTLD_NOW | RTLD_LOCAL)) return found;
    return nullptr;
}

void* function_of(void* library, const char* name) {
    return ::dlsym(library, name);
}

void* load_module(const std::filesystem::path& file, std::string& reason) {
    void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!module) reason = ::dlerror();
    return module;
}

}  // namespace scree::host
