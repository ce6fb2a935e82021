// Shared libraries that are loaded at run time.
#pragma once

#include <filesystem>
#include <string>

namespace scree::host {

// The names of such libraries here, in the order in which they are tried; nullptr ends them.
extern const char* const vulkan_library[];
extern const char* const egl_library[];
extern const char* const gles_library[];

// How to get them and what goes with them here, for messages.
extern const char* const vulkan_cure;
extern const char* const egl_cure;
extern const char* const ffmpeg_cure;

// The first of the names that can be loaded, or null. It is never unloaded: drivers leave threads and exit handlers in it.
void* load_library(const char* const* names);
void* function_of(void* library, const char* name);

// A module of this program, whose functions the libraries that it loads see, or null with a reason. Windows has none.
extern const bool has_modules;
void* load_module(const std::filesystem::path& file, std::string& reason);

}  // namespace scree::host
