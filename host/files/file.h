// File input and atomic file output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scree::host {

// A file that cannot be read or written. The message names the path and the reason.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Reads all bytes of a file. Throws FileError.
std::string read_text(const std::filesystem::path& path);
// As read_text, of a regular file of at most `most` bytes: neither a device, which may never end, nor a pipe, which may
// never begin.
std::string read_regular(const std::filesystem::path& path, std::uintmax_t most);

// Whether a file lies in a folder or below, both canonical.
bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

// Atomic write: to a temporary file in the same folder, then rename, so that the file has either its old or its new
// content. Paths that are no regular files (/dev/stdout, a pipe) are written in place. Throws FileError and removes
// the temporary file.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Folder of caches: $XDG_CACHE_HOME/scree, else ~/.cache/scree (on Windows %LOCALAPPDATA%\\scree); empty if neither is known.
std::filesystem::path cache_folder();

// "base.png", or "base-2.png", "base-3.png" and so on, whichever does not exist yet.
std::string unused_name(const std::string& base, const std::string& ending);

// Creates a folder and its parents where they are missing. Throws FileError.
void make_folder(const std::filesystem::path& path);

}  // namespace scree::host
