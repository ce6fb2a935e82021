// Files by descriptor, as every system has them. Bytes are not translated. A call that fails returns -1 or false, with errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace scree::host {

// A file that is there; at once: without waiting for the writer of a pipe.
int open_to_read(const std::filesystem::path& path);
int open_at_once(const std::filesystem::path& path);
int open_to_write(const std::filesystem::path& path);
std::FILE* open_stream(const std::filesystem::path& path);  // to read; null with errno
// A new file, or an older one without its bytes.
int open_to_replace(const std::filesystem::path& path);
// A new file, never one that is there or a link, held until the descriptor is closed. It can be renamed and removed while it is
// open.
int create_held(const std::filesystem::path& path);
// An open file of a folder that has no name, and ends with its descriptor. (Where the file system knows no such files it has a
// name for a moment.)
int create_nameless(const std::filesystem::path& folder);
// As create_nameless, where no folder is known.
int create_in_memory();
// Holds a folder until the descriptor is closed; errno is EWOULDBLOCK where another process holds it. A file system without locks
// lets all hold it.
int hold_folder(const std::filesystem::path& folder);

bool close_file(int file);
bool go_to_begin(int file);
// As many bytes as are there; 0 at the end.
std::ptrdiff_t read_some(int file, void* to, std::size_t bytes);
// Block until all bytes are written. Return 0 or an errno value: EPIPE, without a signal, where the reader of a pipe has ended.
int write_all(int file, const void* from, std::size_t bytes);
int write_all_at(int file, std::uint64_t at, const void* from, std::size_t bytes);

enum class FileKind { regular, folder, characters, other };
struct OpenFile {
    FileKind kind = FileKind::other;
    std::uintmax_t bytes = 0;  // of a regular file
};
bool look_at(int file, OpenFile& found);
bool is_terminal(int file);
bool may_write(const std::filesystem::path& path);  // of a file that is there

// In place of an older file.
bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
bool remove_file(const std::filesystem::path& path);
void remove_file_in_signal(const char* path) noexcept;  // async-signal-safe
void remove_unless_held(const std::filesystem::path& path);

// Ends to read and to write, which no child inherits.
bool make_pipe(int (&ends)[2]);

}  // namespace scree::host
