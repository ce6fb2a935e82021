// Files of Windows, by descriptors of its C library.
#include "host/system/files.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>

#include "host/system/windows/windows.h"

namespace scree::host {

namespace {

// With all rights of others, as on other systems: an open file can be renamed and removed.
constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

int descriptor_of(HANDLE handle, int flags) {
    if (handle == INVALID_HANDLE_VALUE) {
        set_errno();
        return -1;
    }
    const int file = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), flags | _O_BINARY | _O_NOINHERIT);
    if (file < 0) CloseHandle(handle);
    return file;
}

HANDLE handle_of(int file) {
    return reinterpret_cast<HANDLE>(::_get_osfhandle(file));
}

int open_as(const std::filesystem::path& path, DWORD access, DWORD how, DWORD attributes, int flags, DWORD share = shared) {
    if (how != CREATE_NEW && std::filesystem::is_directory(path)) {
        errno = EISDIR;
        return -1;
    }
    return descriptor_of(CreateFileW(path.c_str(), access, share, nullptr, how, attributes, nullptr), flags);
}

int create_scratch(const std::filesystem::path& folder) {
    static std::atomic<unsigned> serial{0};
    const std::filesystem::path name =
        folder / (".scree-" + std::to_string(GetCurrentProcessId()) + "-" + std::to_string(serial++));
    return open_as(name, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE,
                   _O_RDWR);  // it has its name, and its folder stays, until it is closed
}

}  // namespace

int open_to_read(const std::filesystem::path& path) {
    return open_as(path, GENERIC_READ, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, _O_RDONLY);
}
int open_at_once(const std::filesystem::path& path) {
    return open_to_read(path);
}
std::FILE* open_stream(const std::filesystem::path& path) {
    return ::_wfopen(path.c_str(), L"rb");
}
int open_to_write(const std::filesystem::path& path) {
    return open_as(path, GENERIC_WRITE, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, _O_WRONLY);
}
int open_to_replace(const std::filesystem::path& path) {
    return open_as(path, GENERIC_WRITE, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, _O_WRONLY);
}

// Held as far as an open file cannot be opened with all its rights refused to others: remove_unless_held.
int create_held(const std::filesystem::path& path) {
    return open_as(path, GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, _O_WRONLY);
}

int create_nameless(const std::filesystem::path& folder) {
    return create_scratch(folder);
}

int create_in_memory() {
    std::error_code wrong;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(wrong);
    return wrong ? -1 : create_scratch(folder);
}

// Writing into the folder itself is refused to others, which nobody but this function asks for.
int hold_folder(const std::filesystem::path& folder) {
    const HANDLE handle = CreateFileW(folder.c_str(), FILE_ADD_FILE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING,
                                      FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE && GetLastError() == ERROR_SHARING_VIOLATION) {
        errno = EWOULDBLOCK;
        return -1;
    }
    return descriptor_of(handle, _O_RDONLY);
}

bool close_file(int file) {
    return ::_close(file) == 0;
}

bool go_to_begin(int file) {
    return ::_lseeki64(file, 0, SEEK_SET) == 0;
}

std::ptrdiff_t read_some(int file, void* to, std::size_t bytes) {
    constexpr std::size_t most = 1u << 20;
    return ::_read(file, to, static_cast<unsigned>(std::min(bytes, most)));
}

// Not by the C library, which tells neither of a full disk nor of a pipe without a reader.
int write_all(int file, const void* data, std::size_t bytes) {
    constexpr std::size_t most = 1u << 20;
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        DWORD written = 0;
        if (!WriteFile(handle_of(file), from, static_cast<DWORD>(std::min(bytes, most)), &written, nullptr))
            return errno_of(GetLastError());
        if (written == 0) return ENOSPC;
        from += written;
        bytes -= written;
    }
    return 0;
}

int write_all_at(int file, std::uint64_t at, const void* from, std::size_t bytes) {
    const std::int64_t before = ::_telli64(file);
    if (before < 0 || ::_lseeki64(file, static_cast<std::int64_t>(at), SEEK_SET) < 0) return errno;
    const int error = write_all(file, from, bytes);
    if (::_lseeki64(file, before, SEEK_SET) < 0 && error == 0) return errno;
    return error;
}

bool look_at(int file, OpenFile& found) {
    const HANDLE handle = handle_of(file);
    if (handle == INVALID_HANDLE_VALUE) return false;
    const DWORD type = GetFileType(handle);
    found.kind = type == FILE_TYPE_DISK ? FileKind::regular : type == FILE_TYPE_CHAR ? FileKind::characters : FileKind::other;
    found.bytes = 0;
    if (found.kind != FileKind::regular) return true;
    LARGE_INTEGER size{};
    if (!GetFileSizeEx(handle, &size)) {
        set_errno();
        return false;
    }
    found.bytes = static_cast<std::uintmax_t>(size.QuadPart);
    return true;
}

// The C library takes NUL for a terminal, too.
bool is_terminal(int file) {
    DWORD mode = 0;
    return GetConsoleMode(handle_of(file), &mode) != 0;
}

bool may_write(const std::filesystem::path& path) {
    return ::_waccess(path.c_str(), 2) == 0;
}

bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING)) return true;
    set_errno();
    return false;
}

bool remove_file(const std::filesystem::path& path) {
    if (DeleteFileW(path.c_str())) return true;
    set_errno();
    return false;
}

void remove_file_in_signal(const char* path) noexcept {
    wchar_t name[4096];
    if (MultiByteToWideChar(CP_UTF8, 0, path, -1, name, 4096) > 0) DeleteFileW(name);
}

void remove_unless_held(const std::filesystem::path& path) {
    const HANDLE handle = CreateFileW(path.c_str(), GENERIC_READ | DELETE, 0, nullptr, OPEN_EXISTING,
                                      FILE_FLAG_DELETE_ON_CLOSE | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    if (handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
}

bool make_pipe(int (&ends)[2]) {
    return ::_pipe(ends, 1u << 16, _O_BINARY | _O_NOINHERIT) == 0;
}

}  // namespace scree::host
