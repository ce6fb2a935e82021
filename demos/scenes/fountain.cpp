// A fountain: bodies are born at its nozzle, fall into the basin, and are taken away when their time is over.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float life = 6;           // s
constexpr int bursts_a_second = 6;  // bodies come and go in bursts: each is one upload
constexpr float reach = 0.16f;      // m, of a body
constexpr float half_basin = 3.2f;  // m

// The script keeps no state: a body's name says in which burst it was born.
std::string name_of_burst(int burst) {
    return "burst " + std::to_string(burst);
}
int burst_of(const Body& body) {
    constexpr std::string_view word = "burst ";
    int burst = -1;
    if (body.name.starts_with(word)) std::from_chars(body.name.data() + word.size(), body.name.data() + body.name.size(), burst);
    return burst;
}

// Bodies of a burst leave side by side, none in another.
std::vector<Body> burst_at_nozzle(int burst, std::size_t count, std::uint64_t seed) {
    Random random(seed * 1000003 + static_cast<std::uint64_t>(burst));
    std::vector<Body> born;
    const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count)))));
    for (std::size_t i = 0; i < count; ++i) {
        Body body = random_assorted(reach, random);
        const float x = static_cast<float>(static_cast<int>(i) % side) - 0.5f * static_cast<float>(side - 1);
        const float z = static_cast<float>(static_cast<int>(i) / side) - 0.5f * static_cast<float>(side - 1);
        body.position = vec3(x, 0, z) * (2.1f * reach) + vec3(0, 1, 0);
        const float spread = 1.6f / std::max(1.0f, 0.5f * static_cast<float>(side));
        body.velocity = {spread * x + random.between(-0.3f, 0.3f), random.between(7.5f, 8.5f),
                         spread * z + random.between(-0.3f, 0.3f)};
        body.restitution = 0.3f;
        body.name = name_of_burst(burst);
        born.push_back(std::move(body));
    }
    return born;
}

void add_basin(Scene& scene) {
    constexpr float thick = 0.15f, high = 0.6f;
    for (int k = 0; k < 8; ++k) {
        const float angle = static_cast<float>(k) * 45 * degrees;
        const vec3 outward(portable::sin(angle), 0, portable::cos(angle));
        scene.bodies.push_back(fixed_box(outward * half_basin + vec3(0, high, 0), {0.45f * half_basin, high, thick}, 0.4f,
                                         turned({0, 1, 0}, angle)));
    }
}

}  // namespace

DemoScene fountain(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    add_basin(scene);
    const auto bursts = static_cast<std::size_t>(life * bursts_a_second);
    const std::size_t of_burst = std::max<std::size_t>(1, options.bodies / bursts), most = of_burst * (bursts + 1);
    const std::size_t fixed = scene.bodies.size();
    const vec3 low(-half_basin, 0, -half_basin), high(half_basin, 4.2f, half_basin);
    Promise promise(
        between("bodies at the end", static_cast<double>(of_burst * (bursts - 1)), static_cast<double>(most), "",
                "dynamic bodies that are there",
                [fixed](const Trace& trace) {
                    const auto there =
                        std::count_if(trace.end.begin(), trace.end.end(), [](const BodyState& b) { return b.exists; });
                    return static_cast<double>(there) - static_cast<double>(fixed);
                }),
        at_most("indices in use", static_cast<double>(fixed + most + 2 * of_burst), "", "of all bodies that there ever were",
                [](const Trace& trace) { return static_cast<double>(trace.end.size()); }),
        penetration_below(0.05));
    const std::uint64_t seed = options.seed;
    Script script = [of_burst, seed](World& world) {
        const auto steps_between = static_cast<std::uint64_t>(std::lround(world.settings().rate / bursts_a_second));
        if (world.steps() % steps_between != 0) return;
        const int burst = static_cast<int>(world.steps() / steps_between),
                  oldest = burst - static_cast<int>(life * bursts_a_second);
        std::vector<BodyHandle> old;
        const std::vector<Body>& bodies = world.scene().bodies;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (const int born = burst_of(bodies[i]); born >= 0 && born < oldest) old.push_back(world.handle_of(i));
        world.remove_bodies(old);
        world.add_bodies(burst_at_nozzle(burst, of_burst, seed));
    };
    return {std::move(scene), view_of(low, high, 30, 24), low, high, 3 * life, std::move(promise), true, std::move(script)};
}

}  // namespace scree::demos
