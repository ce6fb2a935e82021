// Text and errors of Windows.
#include <cerrno>
#include <cwchar>
#include <filesystem>

#include "host/system/windows/windows.h"

// The C library's step from bytes to wide characters, by which std::filesystem::path takes its names: from UTF-8, where Windows'
// takes each byte for a character. Of a character beyond 0xFFFF the first three bytes give one half, the last gives the other.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t count, std::mbstate_t* state) {
    static thread_local std::mbstate_t own{};
    std::mbstate_t& second_half = state ? *state : own;
    const auto wrong = [] {
        errno = EILSEQ;
        return static_cast<std::size_t>(-1);
    };
    if (!from) {
        second_half = 0;
        return 0;
    }
    if (count == 0) return static_cast<std::size_t>(-2);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(from[i])); };
    unsigned code = byte(0);
    std::size_t taken = 1;
    if (second_half != 0) {
        if (code >> 6 != 2) return wrong();
        code = static_cast<unsigned>(second_half) | (code & 63);
        second_half = 0;
    } else if (code >= 0x80) {
        taken = code >> 5 == 6 ? 2 : code >> 4 == 14 ? 3 : code >> 3 == 30 ? 4 : 0;
        if (taken == 0) return wrong();
        if (count < taken) return static_cast<std::size_t>(-2);
        code &= 0x7Fu >> taken;
        for (std::size_t i = 1; i < taken; ++i) {
            if (byte(i) >> 6 != 2) return wrong();
            code = code << 6 | (byte(i) & 63);
        }
        if (taken == 4) {
            second_half = static_cast<std::mbstate_t>(0xDC00 | (code & 0x3C0));
            code = 0xD7C0 + (code >> 10);
            taken = 3;
        }
    }
    if (to) *to = static_cast<wchar_t>(code);
    return code == 0 ? 0 : taken;
}

namespace scree::host {

int errno_of(DWORD error) {
    switch (error) {
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_DRIVE:
        case ERROR_BAD_PATHNAME:
        case ERROR_BAD_NETPATH:
        case ERROR_BAD_NET_NAME:
        case ERROR_INVALID_NAME:
            return ENOENT;
        case ERROR_ACCESS_DENIED:
        case ERROR_CANNOT_MAKE:
            return EACCES;
        case ERROR_SHARING_VIOLATION:
        case ERROR_LOCK_VIOLATION:
            return EBUSY;
        case ERROR_FILE_EXISTS:
        case ERROR_ALREADY_EXISTS:
            return EEXIST;
        case ERROR_WRITE_PROTECT:
            return EROFS;
        case ERROR_DISK_FULL:
        case ERROR_HANDLE_DISK_FULL:
            return ENOSPC;
        case ERROR_TOO_MANY_OPEN_FILES:
            return EMFILE;
        case ERROR_NOT_ENOUGH_MEMORY:
        case ERROR_OUTOFMEMORY:
            return ENOMEM;
        case ERROR_BROKEN_PIPE:
        case ERROR_NO_DATA:
            return EPIPE;
        case ERROR_DIRECTORY:
            return ENOTDIR;
        case ERROR_FILENAME_EXCED_RANGE:
            return ENAMETOOLONG;
        default:
            return EIO;
    }
}

void set_errno() {
    errno = errno_of(GetLastError());
}

std::wstring wide(const std::string& utf8) {
    return std::filesystem::path(utf8).native();
}

std::string narrow(const std::wstring& wide) {
    return std::filesystem::path(wide).string();
}

}  // namespace scree::host
