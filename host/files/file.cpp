// File input and atomic file output.
#include "host/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <system_error>

#include "host/files/partial_file.h"
#include "host/files/pipe.h"

namespace scree::host {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int error) {
    throw FileError(std::string("cannot ") + what + " " + path.string() + ": " + std::strerror(error));
}

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    bool close() {
        const int number = number_;
        number_ = -1;
        return number < 0 || ::close(number) == 0;
    }

private:
    int number_;
};

// Of what tells no size beforehand, such as a pipe.
constexpr std::size_t most_of_a_pipe = std::size_t{2} << 30;

std::string read_all(const Descriptor& file, const std::filesystem::path& path) {
    std::string text;
    char block[65536];
    for (;;) {
        if (text.size() > most_of_a_pipe && !std::filesystem::is_regular_file(path))
            throw FileError("cannot read " + path.string() + ": it does not end after " + std::to_string(text.size()) + " bytes");
        const ssize_t count = ::read(file.number(), block, sizeof block);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail("read", path, errno);
        if (count == 0) return text;
        text.append(block, static_cast<std::size_t>(count));
    }
}

void write_in_place(const std::filesystem::path& path, std::string_view bytes) {
    const Waiting for_reader;
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.number() < 0) fail("write", path, errno);
    if (const int error = write_all(file.number(), bytes.data(), bytes.size())) fail("write", path, error);
}

}  // namespace

std::filesystem::path cache_folder() {
    const char* base = std::getenv("XDG_CACHE_HOME");
    if (base && *base == '/') return std::filesystem::path(base) / "scree";
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? std::filesystem::path(home) / ".cache" / "scree" : std::filesystem::path();
}

std::string read_text(const std::filesystem::path& path) {
    std::error_code ignored;
    std::optional<Waiting> for_writer;
    if (std::filesystem::is_other(path, ignored)) for_writer.emplace();
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number() < 0) fail("read", path, errno);
    struct stat status {};
    if (::fstat(file.number(), &status) == 0 && S_ISCHR(status.st_mode) && ::isatty(file.number()) == 0)
        throw FileError("cannot read " + path.string() + ": it is a device, which may never end");
    return read_all(file, path);
}

std::string read_regular(const std::filesystem::path& path, std::uintmax_t most) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.number() < 0) fail("read", path, errno);
    struct stat status {};
    if (::fstat(file.number(), &status) != 0) fail("read", path, errno);
    if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
    if (!S_ISREG(status.st_mode)) throw FileError("cannot read " + path.string() + ": it is no regular file");
    if (static_cast<std::uintmax_t>(status.st_size) > most)
        throw FileError("cannot read " + path.string() + ": it has " + std::to_string(status.st_size) + " bytes, at most " +
                        std::to_string(most) + " are read");
    return read_all(file, path);
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status)) fail("write", path, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return write_in_place(path, bytes);
    const std::filesystem::path target = target_of_links(path), part = partial_name(target);
    const Unfinished unfinished(part);
    Descriptor file(create_partial(part));
    if (file.number() < 0) fail("write", path, errno);
    int error = write_all(file.number(), bytes.data(), bytes.size());
    if (!file.close() && error == 0) error = errno;
    if (error == 0 && ::rename(part.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(part.c_str());
        fail("write", path, error);
    }
}

void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    write_atomically(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void make_folder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) fail("make the folder", path, error.value());
    if (!std::filesystem::is_directory(path, error)) fail("make the folder", path, ENOTDIR);
}

std::string unused_name(const std::string& base, const std::string& ending) {
    std::string name = base + ending;
    std::error_code none;
    for (int i = 2; std::filesystem::exists(name, none); ++i) name = base + "-" + std::to_string(i) + ending;
    return name;
}

}  // namespace scree::host
