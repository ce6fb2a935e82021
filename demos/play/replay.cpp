// Recorded user input as files and scripts.
#include "demos/play/replay.h"

#include <memory>

#include "demos/program/exit_status.h"
#include "host/files/file.h"

namespace scree::demos {

Input load_input(const std::string& path) {
    try {
        return input_from_json(host::read_text(path));
    } catch (const SceneError& error) {
        throw UsageError(path + ": " + error.what());
    }
}

Input begun(const SceneOptions& options, const World& world) {
    Input input;
    input.scene = options.name;
    input.bodies = options.bodies;
    input.seed = options.seed;
    input.rate = world.settings().rate;
    input.substeps = world.settings().substeps;
    input.sleeping = world.settings().sleeping;
    input.start_hash = world.state_hash();
    return input;
}

Script script_of(Input input, std::string path, Script first) {
    const auto kept = std::make_shared<const Input>(std::move(input));
    return [kept, path = std::move(path), first = std::move(first)](World& world) {
        const auto named = [&](const auto& act) {
            try {
                act();
            } catch (const SceneError& error) {
                throw UsageError(path + ": " + error.what());
            }
        };
        named([&] { require_start(*kept, world); });
        if (first) first(world);
        named([&] { perform_due(*kept, world); });
    };
}

}  // namespace scree::demos
