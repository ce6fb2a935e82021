// Checkpoints: the whole state of a world as bytes or as a file, from which any world of the same scene goes on with the
// same bits.
//
//     const std::vector<std::byte> mark = world.save();
//     world.step(60);
//     world.restore(mark);  // as if the sixty steps had not been
//
//     write_checkpoint("run.checkpoint", world);                                      // today, on a device
//     World later(scene, settings, std::move(runner)); later.restore(read_checkpoint("run.checkpoint").state);  // elsewhere
//
// A checkpoint holds poses, velocities, kept contacts with their impulses, sleep, joints, vehicles, which bodies have
// broken, pending actions and grips, settings, and all edits of the scene since the world was made. It does not hold the
// scene with which the world was made: it names that by a fingerprint. Backend, device and number of threads may differ.
//
// Equal states have equal bytes if their bodies have one order in memory. Worlds of thousands of bodies sort them by the
// clock (World::reorder): compare state_hash(), or call reorder() on both before a last step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

class World;

// A checkpoint that cannot be restored: no checkpoint, cut short, damaged, of another format, or of another scene.
struct CheckpointError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What the head of a checkpoint says.
struct CheckpointInfo {
    std::uint64_t steps = 0;  // done when it was saved
    std::uint64_t scene = 0;  // fingerprint of the scene with which its world was made
};
// Checks format, length and hash. Throws CheckpointError.
CheckpointInfo inspect_checkpoint(std::span<const std::byte> state);

struct CheckpointFile {
    std::string note;              // of the program that wrote it; may be empty
    std::vector<std::byte> state;  // for World::restore
};
// Writes the world's state and a note: the file has its old or its new content, even if the process ends meanwhile.
// On several ranks (compute/distributed) all call it, and the first one writes (World::save_in_pieces). Throws host::FileError (a
// std::runtime_error) that names the path and the reason.
void write_checkpoint(const std::filesystem::path& path, const World& world, std::string_view note = {});
// Throws host::FileError, and CheckpointError naming the path.
CheckpointFile read_checkpoint(const std::filesystem::path& path);

}  // namespace scree
