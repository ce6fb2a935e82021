// Files of POSIX.
#include "host/system/files.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <ctime>
#include <string>

namespace scree::host {

namespace {

// Blocks SIGPIPE in this thread for its lifetime, so that writing to a closed pipe returns EPIPE.
class PipeSignalHeld {
public:
    PipeSignalHeld() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~PipeSignalHeld() {
        const timespec now{};
        if (!was_pending_) sigtimedwait(&pipe_, nullptr, &now);
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    PipeSignalHeld(const PipeSignalHeld&) = delete;
    PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

private:
    sigset_t pipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

template <class Write>
int all_written(const void* data, std::size_t bytes, const Write& write) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = write(from, bytes);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        from += written;
        bytes -= static_cast<std::size_t>(written);
    }
    return 0;
}

}  // namespace

int open_to_read(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}
int open_at_once(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}
std::FILE* open_stream(const std::filesystem::path& path) {
    return std::fopen(path.c_str(), "rb");
}
int open_to_write(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
}
int open_to_replace(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

int create_held(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file >= 0) ::flock(file, LOCK_EX | LOCK_NB);  // some file systems have no locks
    return file;
}

int create_nameless(const std::filesystem::path& folder) {
    const int made = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (made >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return made;
    std::string name = (folder / ".scree-XXXXXX").string();
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

int create_in_memory() {
    return ::memfd_create("scree", MFD_CLOEXEC);
}

int hold_folder(const std::filesystem::path& folder) {
    const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0 || ::flock(opened, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return opened;
    ::close(opened);
    errno = EWOULDBLOCK;
    return -1;
}

bool close_file(int file) {
    return ::close(file) == 0;
}

bool go_to_begin(int file) {
    return ::lseek(file, 0, SEEK_SET) == 0;
}

std::ptrdiff_t read_some(int file, void* to, std::size_t bytes) {
    for (;;) {
        const ssize_t count = ::read(file, to, bytes);
        if (count >= 0 || errno != EINTR) return count;
    }
}

int write_all(int file, const void* from, std::size_t bytes) {
    const PipeSignalHeld held;
    return all_written(from, bytes, [&](const char* part, std::size_t count) { return ::write(file, part, count); });
}

int write_all_at(int file, std::uint64_t at, const void* from, std::size_t bytes) {
    return all_written(from, bytes, [&](const char* part, std::size_t count) {
        return ::pwrite(file, part, count, static_cast<off_t>(at) + (part - static_cast<const char*>(from)));
    });
}

bool look_at(int file, OpenFile& found) {
    struct stat status {};
    if (::fstat(file, &status) != 0) return false;
    found.kind = S_ISREG(status.st_mode)   ? FileKind::regular
                 : S_ISDIR(status.st_mode) ? FileKind::folder
                 : S_ISCHR(status.st_mode) ? FileKind::characters
                                           : FileKind::other;
    found.bytes = found.kind == FileKind::regular ? static_cast<std::uintmax_t>(status.st_size) : 0;
    return true;
}

bool is_terminal(int file) {
    return ::isatty(file) == 1;
}

bool may_write(const std::filesystem::path& path) {
    return ::access(path.c_str(), W_OK) == 0;
}

bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    return std::rename(from.c_str(), to.c_str()) == 0;
}

bool remove_file(const std::filesystem::path& path) {
    return ::unlink(path.c_str()) == 0;
}

void remove_file_in_signal(const char* path) noexcept {
    ::unlink(path);
}

void remove_unless_held(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    ::close(file);
}

bool make_pipe(int (&ends)[2]) {
    return ::pipe2(ends, O_CLOEXEC) == 0;
}

}  // namespace scree::host
