// File input and atomic file output.
#include "host/files/file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <system_error>

#include "host/files/partial_file.h"
#include "host/system/files.h"
#include "host/system/machine.h"

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
        return number < 0 || close_file(number);
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
        const std::ptrdiff_t count = read_some(file.number(), block, sizeof block);
        if (count < 0) fail("read", path, errno);
        if (count == 0) return text;
        text.append(block, static_cast<std::size_t>(count));
    }
}

void write_in_place(const std::filesystem::path& path, std::string_view bytes) {
    const Waiting for_reader;
    Descriptor file(open_to_write(path));
    if (file.number() < 0) fail("write", path, errno);
    if (const int error = write_all(file.number(), bytes.data(), bytes.size())) fail("write", path, error);
}

}  // namespace

std::filesystem::path cache_folder() {
    const std::filesystem::path base = cache_home();
    return base.empty() ? base : base / "scree";
}

bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && rest != file.end();
}

std::string read_text(const std::filesystem::path& path) {
    std::error_code ignored;
    std::optional<Waiting> for_writer;
    if (std::filesystem::is_other(path, ignored)) for_writer.emplace();
    Descriptor file(open_to_read(path));
    if (file.number() < 0) fail("read", path, errno);
    OpenFile opened;
    if (look_at(file.number(), opened) && opened.kind == FileKind::characters && !is_terminal(file.number()))
        throw FileError("cannot read " + path.string() + ": it is a device, which may never end");
    return read_all(file, path);
}

std::string read_regular(const std::filesystem::path& path, std::uintmax_t most) {
    Descriptor file(open_at_once(path));
    if (file.number() < 0) fail("read", path, errno);
    OpenFile opened;
    if (!look_at(file.number(), opened)) fail("read", path, errno);
    if (opened.kind == FileKind::folder) fail("read", path, EISDIR);
    if (opened.kind != FileKind::regular) throw FileError("cannot read " + path.string() + ": it is no regular file");
    if (opened.bytes > most)
        throw FileError("cannot read " + path.string() + ": it has " + std::to_string(opened.bytes) + " bytes, at most " +
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
    Descriptor file(create_held(part));
    if (file.number() < 0) fail("write", path, errno);
    int error = write_all(file.number(), bytes.data(), bytes.size());
    if (!file.close() && error == 0) error = errno;
    if (error == 0 && !rename_file(part, target)) error = errno;
    if (error != 0) {
        remove_file(part);
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
