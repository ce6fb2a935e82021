// Comparison of whole runs on the CPU and on a Vulkan device.
#include "demos/program/compare_ends.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <memory>

#include "compute/cpu/reference_runner.h"
#include "compute/world.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/progress.h"
#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

// The state hash after so many steps more, or fewer if interrupted. Before the last one of all, bodies are sorted in memory:
// large worlds sort them by the clock, so that two equal ones may keep them, and save them, in two orders.
std::uint64_t advanced(World& world, const Script& before_step, int steps, bool to_the_end) {
    constexpr int at_once = 8;
    for (int done = 0; done < steps && !is_interrupted();) {
        const bool last = to_the_end && done == steps - 1;
        const int count = before_step || last ? 1 : std::min(at_once, steps - (to_the_end ? 1 : 0) - done);
        if (last) world.reorder();
        if (before_step) before_step(world);
        world.step(count);
        done += count;
    }
    return world.state_hash();
}

}  // namespace

ComparedEnds compare_ends(const SceneOptions& scene, const Backend& device, int threads, bool quiet) {
    return at_work([&] {
        const LoadedScene subject = load_subject(scene);
        const Settings settings = subject.settings(scene);
        World here(subject.scene, settings, make_reference_runner(threads)), there(subject.scene, settings, device.make_runner());
        for (World* world : {&here, &there}) limit_memory(*world, device);
        const int steps = scene.step_count(1, settings.rate), second = static_cast<int>(std::lround(settings.rate));
        ComparedEnds ends;
        ends.scene = subject.name;
        ends.device = there.runner().device();
        ends.bodies = subject.scene.bodies.size();
        Progress progress(ends.scene, steps, "steps", quiet);
        for (int done = 0; done < steps && ends.equal() && !is_interrupted();) {
            const int count = std::min(second, steps - done);
            const bool to_the_end = done + count == steps;
            std::future<std::uint64_t> hash =
                std::async(std::launch::async, [&] { return advanced(here, subject.before_step, count, to_the_end); });
            ends.hash_of_device = advanced(there, subject.before_step, count, to_the_end);
            ends.hash = hash.get();
            done += count;
            ends.steps = static_cast<std::uint64_t>(done);
            if (ends.equal()) ends.equal_until = ends.steps;
            progress.done(done);
        }
        // Contacts, impulses, sleep and whatever else lasts: the hash is of poses and velocities.
        if (ends.equal() && !is_interrupted()) ends.rest_differs = here.save() != there.save();
        device.require_valid();
        return ends;
    });
}

std::vector<std::string> all_scenes() {
    std::vector<std::string> names;
    for (const Demo& demo : all_demos()) names.emplace_back(demo.name);
    return names;
}

}  // namespace scree::demos
