// Checkpoints as files: a line that says what follows, the note's length and text, then the state.
#include "compute/checkpoint.h"

#include <xxhash.h>

#include "compute/world.h"
#include "compute/world/byte_stream.h"
#include "host/files/file.h"

namespace scree {

namespace {
constexpr std::string_view first_line = "scree checkpoint file 1\n";
}

void write_checkpoint(const std::filesystem::path& path, const World& world, std::string_view note) {
    const std::vector<std::byte> state = world.save();
    ByteWriter out;
    out.reserve(first_line.size() + 8 + note.size() + state.size());
    out.put_bytes(std::as_bytes(std::span(first_line)));
    out.put_text(note);
    out.put(std::uint64_t{XXH64(note.data(), note.size(), 0)});
    out.put_bytes(state);
    host::write_atomically(path, std::span<const std::byte>(out.bytes()));
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
