// Files that are written bit by bit.
#include "host/files/growing_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "host/files/file.h"
#include "host/files/partial_file.h"
#include "host/system/files.h"

namespace scree::host {
namespace {

constexpr std::size_t block_bytes = 1u << 20;

[[noreturn]] void refuse_path(const char* what, const std::filesystem::path& path, int error) {
    throw FileError(std::string("cannot ") + what + " " + path.string() + ": " + std::strerror(error));
}

// A descriptor with a buffer before it.
class Buffered {
public:
    Buffered(std::filesystem::path path, int number) : path_(std::move(path)), number_(number) {
        if (number_ < 0) refuse_path("write", path_, errno);
        buffer_.reserve(block_bytes);
    }
    ~Buffered() {
        if (number_ >= 0) close_file(number_);
    }
    Buffered(const Buffered&) = delete;
    Buffered& operator=(const Buffered&) = delete;

    void append(std::string_view bytes) {
        size += bytes.size();
        if (buffer_.size() + bytes.size() > block_bytes) flush();
        if (bytes.size() > block_bytes)
            write(bytes);
        else
            buffer_.append(bytes);
    }
    void flush() {
        write(buffer_);
        buffer_.clear();
    }
    void overwrite(std::uint64_t at, std::span<const std::byte> bytes) {
        flush();
        if (const int error = write_all_at(number_, at, bytes.data(), bytes.size())) refuse_path("write", path_, error);
    }
    void close() {
        flush();
        const int number = std::exchange(number_, -1);
        if (!close_file(number)) refuse_path("write", path_, errno);
    }
    int number() const { return number_; }

    std::uint64_t size = 0;

private:
    void write(std::string_view bytes) const {
        if (const int error = write_all(number_, bytes.data(), bytes.size())) refuse_path("write", path_, error);
    }
    std::filesystem::path path_;
    int number_;
    std::string buffer_;
};

}  // namespace

struct GrowingFile::Impl {
    std::filesystem::path target, part;
    std::optional<Unfinished> unfinished;
    std::optional<Buffered> file;
};

GrowingFile::GrowingFile(const std::filesystem::path& path) : interior_(std::make_unique<Impl>()) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse_path("write", path, EISDIR);
    interior_->target = target_of_links(path);
    const bool in_place = std::filesystem::is_other(path, ignored);  // a device or a pipe
    if (!in_place) {
        interior_->part = partial_name(interior_->target);
        interior_->unfinished.emplace(interior_->part);
    }
    interior_->file.emplace(path, in_place ? open_to_write(path) : create_held(interior_->part));
}

GrowingFile::~GrowingFile() {
    if (interior_->file && !interior_->part.empty()) remove_file(interior_->part);
}

void GrowingFile::append(std::string_view bytes) {
    interior_->file->append(bytes);
}

void GrowingFile::overwrite(std::uint64_t at, std::span<const std::byte> bytes) {
    interior_->file->overwrite(at, bytes);
}

std::uint64_t GrowingFile::size() const {
    return interior_->file->size;
}

void GrowingFile::commit() {
    interior_->file->close();
    if (!interior_->part.empty() && !rename_file(interior_->part, interior_->target))
        refuse_path("write", interior_->target, errno);
    interior_->file.reset();
}

struct ScratchFile::Impl {
    std::filesystem::path beside;
    std::optional<Buffered> file;
    std::string block;
};

ScratchFile::ScratchFile(const std::filesystem::path& beside) : interior_(std::make_unique<Impl>()) {
    const std::filesystem::path folder = beside.has_parent_path() ? beside.parent_path() : ".";
    interior_->beside = beside;
    interior_->file.emplace(beside, create_nameless(folder));
}

ScratchFile::~ScratchFile() = default;

void ScratchFile::append(std::span<const std::byte> bytes) {
    interior_->file->append(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

std::uint64_t ScratchFile::size() const {
    return interior_->file->size;
}

void ScratchFile::rewind() {
    interior_->file->flush();
    interior_->block.resize(block_bytes);
    if (!go_to_begin(interior_->file->number())) refuse_path("read back what was written for", interior_->beside, errno);
}

std::string_view ScratchFile::next() {
    const std::ptrdiff_t count = read_some(interior_->file->number(), interior_->block.data(), interior_->block.size());
    if (count < 0) refuse_path("read back what was written for", interior_->beside, errno);
    return {interior_->block.data(), static_cast<std::size_t>(count)};
}

}  // namespace scree::host
