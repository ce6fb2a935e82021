// Files: read whole, written whole or not at all.
#pragma once

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

// The bytes of a file. Throws FileError.
std::string read_text(const std::filesystem::path& path);

// The file has either its old content or all of the new: written beside its place first, then renamed. What is not a regular file
// (/dev/stdout, a pipe) is written in place. Throws FileError and leaves nothing behind.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Where to keep what can be made anew: $XDG_CACHE_HOME/scree, else ~/.cache/scree; empty if neither is known.
std::filesystem::path cache_folder();

// Makes a folder and those above it, unless it is there. Throws FileError.
void make_folder(const std::filesystem::path& path);

}  // namespace scree::host
