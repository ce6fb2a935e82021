// Checkpoints as files: a line that says what follows, the note's length and text, then the state.
#include "compute/checkpoint.h"

#include <xxhash.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "compute/world.h"
#include "compute/world/states/byte_stream.h"
#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree {

namespace {
constexpr std::string_view first_line = "scree checkpoint file 1\n";
}

void write_checkpoint(const std::filesystem::path& path, const World& world, std::string_view note) {
    ByteWriter front;
    front.put_bytes(std::as_bytes(std::span(first_line)));
    front.put_text(note);
    front.put(std::uint64_t{XXH64(note.data(), note.size(), 0)});
    std::error_code none;
    if (std::filesystem::is_other(path, none)) {  // a pipe takes no piece again
        bool writes = false;
        world.save_in_pieces([&, start = front.bytes().size()](std::uint64_t at, std::span<const std::byte> bytes) {
            writes = true;
            std::vector<std::byte>& all = front.bytes();
            all.resize(std::max(all.size(), static_cast<std::size_t>(start + at + bytes.size())));
            std::copy(bytes.begin(), bytes.end(), all.begin() + static_cast<std::ptrdiff_t>(start + at));
        });
        if (writes) host::write_atomically(path, std::span<const std::byte>(front.bytes()));
        return;
    }
    std::optional<host::GrowingFile> file;  // on the first rank
    world.save_in_pieces([&](std::uint64_t at, std::span<const std::byte> bytes) {
        if (!file) file.emplace(path).append(front.bytes());
        if (const std::uint64_t place = front.bytes().size() + at; place == file->size())
            file->append(bytes);
        else
            file->overwrite(place, bytes);
    });
    if (file) file->commit();
}

CheckpointFile read_checkpoint(const std::filesystem::path& path) {
    const std::string text = host::read_text(path);
    try {
        if (!text.starts_with(first_line)) throw CheckpointError("this is no checkpoint of scree");
        ByteReader in(std::as_bytes(std::span(text)).subspan(first_line.size()));
        CheckpointFile file;
        file.note = in.take_text();
        if (in.take<std::uint64_t>() != XXH64(file.note.data(), file.note.size(), 0))
            throw CheckpointError("the checkpoint is damaged: its note does not have the hash that it names");
        const auto state = in.rest();
        file.state.assign(state.begin(), state.end());
        inspect_checkpoint(file.state);
        return file;
    } catch (const CheckpointError& error) {
        throw CheckpointError(path.string() + ": " + error.what());
    }
}

}  // namespace scree
