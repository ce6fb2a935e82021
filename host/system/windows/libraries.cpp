// Shared libraries of Windows.
#include "host/system/libraries.h"

#include "host/system/windows/windows.h"

namespace scree::host {

const char* const vulkan_library[] = {"vulkan-1.dll", nullptr};
const char* const egl_library[] = {"libEGL.dll", nullptr};
const char* const gles_library[] = {"libGLESv2.dll", nullptr};

const char* const vulkan_cure = "install the driver of its graphics card";
const char* const egl_cure = "pictures are drawn with Vulkan on Windows; install the driver of its graphics card";
const char* const ffmpeg_cure = "winget install ffmpeg";

const bool has_modules = false;

void* load_library(const char* const* names) {
    for (; *names; ++names)
        if (const HMODULE found = LoadLibraryW(wide(*names).c_str())) return found;
    return nullptr;
}

void* function_of(void* library, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

void* load_module(const std::filesystem::path& file, std::string& reason) {
    reason = file.string() + ": modules are loaded on Linux alone";
    return nullptr;
}

}  // namespace scree::host
