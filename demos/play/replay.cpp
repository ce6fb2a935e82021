// Doing again what a user did, and holding a run to its recording.
#include "demos/play/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "demos/program/exit_status.h"
#include "demos/program/report.h"
#include "host/files/file.h"

namespace scree::demos {

Input load_input(const std::string& path) {
    try {
        return input_from_json(host::read_text(path));
    } catch (const SceneError& error) {
        throw UsageError(path + ": " + error.what());
    }
}

Input begun(const SceneOptions& options, std::uint64_t start_hash) {
    Input input;
    input.scene = options.name;
    input.bodies = options.bodies;
    input.seed = options.seed;
    input.rate = options.rate;
    input.substeps = options.substeps;
    input.sleeping = options.sleeping;
    input.start_hash = start_hash;
    return input;
}

Script replay(Input input, std::string path, Script first) {
    const auto kept = std::make_shared<const Input>(std::move(input));
    return [kept, path = std::move(path), first = std::move(first)](World& world) {
        if (world.steps() == 0 && kept->start_hash && *kept->start_hash != world.state_hash()) {
            throw UsageError(
                fmt::format("{}: /start_hash: {} began in state {}, here in {}: it is not the scene that was recorded", path,
                            kept->scene, hash_text(*kept->start_hash), hash_text(world.state_hash())));
        }
        if (first) first(world);
        const auto earlier = [](const TimedAct& act, std::uint64_t step) { return act.step < step; };
        auto act = std::lower_bound(kept->acts.begin(), kept->acts.end(), world.steps(), earlier);
        for (; act != kept->acts.end() && act->step == world.steps(); ++act) {
            try {
                perform(act->act, world);
            } catch (const std::logic_error& error) {  // std::invalid_argument, std::out_of_range, std::length_error
                throw UsageError(fmt::format("{}: /acts/{}: {}", path, act - kept->acts.begin(), error.what()));
            } catch (const SceneError& error) {
                throw UsageError(fmt::format("{}: /acts/{}: {}", path, act - kept->acts.begin(), error.what()));
            }
        }
    };
}

}  // namespace scree::demos
