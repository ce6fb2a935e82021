// Shared libraries of Windows.
#include "host/system/libraries.h"

#include <system_error>

#include "host/system/windows/windows.h"

namespace scree::host {

const char* const vulkan_library[] = {"vulkan-1.dll", nullptr};
const char* const egl_library[] = {"libEGL.dll", nullptr};
const char* const gles_library[] = {"libGLESv2.dll", nullptr};

void* load_library(const char* const* names) {
    for (; *names; ++names)
        if (const HMODULE found = LoadLibraryW(wide(*names).c_str())) return found;
    return nullptr;
}

void* function_of(void* library, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

void* load_module(const std::filesystem::path& file, std::string& reason) {
    const HMODULE module = LoadLibraryW(file.c_str());
    if (!module) reason = file.string() + ": " + std::system_category().message(static_cast<int>(GetLastError()));
    return module;
}

}  // namespace scree::host
