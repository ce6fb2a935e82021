// Raw video frames.
#include "host/pictures/raw_frames.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>

#include "host/files/partial_file.h"
#include "host/system/files.h"

namespace scree::host {

struct RawFrames::Impl {
    std::string name;  // for messages
    std::filesystem::path target, partial;
    std::optional<Unfinished> unfinished;
    int descriptor = -1;
    bool owned = false;

    [[noreturn]] void fail(int error) const {
        throw ImageError(name + ": no frame can be written: " +
                         (error == EPIPE ? "the program that reads them has ended" : std::strerror(error)));
    }
    void own(int opened) {
        descriptor = opened;
        if (descriptor < 0) fail(errno);
        owned = true;
    }
    int close() {
        const int number = descriptor;
        descriptor = -1;
        return owned && number >= 0 && !close_file(number) ? errno : 0;
    }
};

RawFrames::RawFrames(const std::filesystem::path& path) : interior_(std::make_unique<Impl>()) {
    Impl& in = *interior_;
    in.name = path == "-" ? "the standard output" : path.string();
    if (path == "-") {
        in.descriptor = 1;
        if (is_terminal(in.descriptor)) {
            throw ImageError("the standard output is a terminal, which cannot show raw frames; send them into a file or a pipe");
        }
        return;
    }
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status)) throw ImageError(in.name + ": is a folder; name a file, a pipe, or -");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        in.own(open_to_write(path));
        return;
    }
    require_writable_folder(path.parent_path());
    in.target = target_of_links(path);
    in.partial = partial_name(in.target);
    in.unfinished.emplace(in.partial);
    in.own(create_held(in.partial));
}

RawFrames::~RawFrames() {
    interior_->close();
    if (interior_->partial.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(interior_->partial, ignored);
}

void RawFrames::add(const Image& image) {
    if (interior_->descriptor < 0) throw ImageError(interior_->name + ": no more frames can be added");
    const std::vector<std::uint8_t> bytes = rgb_bytes(image);
    if (const int error = write_all(interior_->descriptor, bytes.data(), bytes.size())) interior_->fail(error);
}

void RawFrames::finish() {
    if (interior_->descriptor < 0) return;
    if (const int error = interior_->close()) interior_->fail(error);
    if (interior_->partial.empty()) return;
    std::error_code error;
    std::filesystem::rename(interior_->partial, interior_->target, error);
    if (error) throw ImageError(interior_->name + ": cannot be written: " + error.message());
    interior_->partial.clear();
    interior_->unfinished.reset();
}

}  // namespace scree::host
