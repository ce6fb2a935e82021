// Narrowphase benchmark by pair type.
#include "demos/bench/bench_pair_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/progress.h"
#include "demos/scenes/random.h"

namespace scree::demos {

namespace {

constexpr int at_a_time =
    20;  // steps per pair type before the next one's turn: spreads disturbances over all, and pairs do not drift apart
constexpr int halvings = 10;      // bisections of the distance at which a pair touches: to 1 mm
constexpr float spacing = 4;      // m, between pairs
constexpr float overlap = 0.01f;  // m, depth to which each pair is then overlapped
constexpr float spin = 0.06f;     // rad/s, just above the limit of persistent manifolds (shaders/physics/contact/persistence.h)

struct Kind {
    const char* name;
    Shape shape;
};

// Fibonacci lattice on a sphere (Swinbank and Purser, Fibonacci grids, 2006).
Hull round_hull(int vertices, float radius) {
    Hull hull;
    const float golden = std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
    for (int i = 0; i < vertices; ++i) {
        const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(vertices);
        const float ring = std::sqrt(1 - y * y), angle = golden * static_cast<float>(i);
        hull.points.push_back(radius * vec3(ring * portable::cos(angle), y, ring * portable::sin(angle)));
    }
    return hull;
}

std::vector<Kind> kinds() {
    return {{"box", Box{vec3(0.5f, 0.4f, 0.45f)}}, {"hull", round_hull(32, 0.5f)},     {"sphere", Sphere{0.5f}},
            {"capsule", Capsule{0.3f, 0.3f}},      {"cylinder", Cylinder{0.4f, 0.5f}}, {"cone", Cone{0.4f, 0.9f}}};
}

bool is_named(const std::vector<std::string>& names, const Kind& a, const Kind& b) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name == fmt::format("{}-{}", a.name, b.name) || name == fmt::format("{}-{}", b.name, a.name);
    });
}

// Bodies 2i and 2i + 1 are a pair, `distances[i]` (m) apart in a direction that varies with i.
Scene pairs_of(const Kind& a, const Kind& b, const std::vector<float>& distances) {
    Scene scene;
    scene.gravity = vec3(0);
    Random random(7);
    const auto row = static_cast<std::size_t>(std::ceil(portable::cbrt(static_cast<double>(distances.size()))));
    for (std::size_t i = 0; i < distances.size(); ++i) {
        Body first, second;
        first.motion = Motion::kinematic;
        first.shape = a.shape;
        first.position = spacing * vec3(i % row, i / row % row, i / row / row);
        first.orientation = random.orientation();
        const vec4 any = glm::normalize(random.orientation());
        const vec3 direction = physics::rotate(any, vec3(1, 0, 0));
        first.angular_velocity = spin * physics::rotate(any, vec3(0, 1, 0));
        second.shape = b.shape;
        second.position = first.position + distances[i] * direction;
        second.orientation = random.orientation();
        second.friction = second.restitution = 0;
        scene.bodies.push_back(first);
        scene.bodies.push_back(second);
    }
    return scene;
}

Settings at_rest() {
    Settings settings;
    settings.sleeping = false;
    settings.substeps = 1;
    settings.push_speed = 1e-4f;            // overlaps persist
    settings.speculative_distance = 1e-4f;  // no speculative contacts
    return settings;
}

std::vector<bool> contacts_of(const World& world, std::size_t pairs) {
    std::vector<bool> found(pairs);
    const State& state = world.state();
    for (std::size_t i = 0; i < state.counted().contacts; ++i) {
        const physics::Contact& contact = state.contacts[i];
        if (contact.count > 0) found[state.id_of(state.body_of(contact.a)) / 2] = true;
    }
    return found;
}

std::vector<float> touching_distances(const Kind& a, const Kind& b, std::size_t pairs) {
    std::vector<float> inside(pairs, 0), apart(pairs, 2), middle(pairs);
    for (int i = 0; i < halvings; ++i) {
        for (std::size_t k = 0; k < pairs; ++k) middle[k] = (inside[k] + apart[k]) / 2;
        World world(pairs_of(a, b, middle), at_rest());
        world.step();
        const std::vector<bool> touch = contacts_of(world, pairs);
        for (std::size_t k = 0; k < pairs; ++k) (touch[k] ? inside : apart)[k] = middle[k];
    }
    for (float& distance : inside) distance -= overlap;
    return inside;
}

double narrowphase_ms(const StageTimes& times) {
    double sum = 0;
    for (const auto& [stage, ms] : times) sum += stage.starts_with("collide_") ? ms : 0;
    return sum;
}

struct Candidate {
    Kind a, b;
    Scene scene;
    std::vector<double> ms;
    double touching = 0;
    std::string device{};
};

void sample(Candidate& candidate, const Backend& machine) {
    World world(candidate.scene, at_rest(), machine.make_runner());
    const std::size_t pairs = candidate.scene.bodies.size() / 2;
    world.step(2);  // grows buffers, warms caches
    world.set_profiling(true);
    for (int i = 0; i < at_a_time; ++i) {
        world.step();
        candidate.ms.push_back(narrowphase_ms(world.last_stage_times()));
    }
    candidate.device = world.runner().device();
    const std::vector<bool> touch = contacts_of(world, pairs);
    candidate.touching = static_cast<double>(std::count(touch.begin(), touch.end(), true)) / static_cast<double>(pairs);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

void require_kinds(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        bool known = false;
        std::string all;
        for (const Kind& a : kinds()) {
            all += (all.empty() ? "" : ", ") + std::string(a.name);
            for (const Kind& b : kinds()) known = known || is_named({name}, a, b);
        }
        if (!known)
            throw UsageError(fmt::format("--pairs: {} names no two of these kinds: {}; say for instance hull-box", name, all));
    }
}

KindCosts measure_kinds(const std::vector<std::string>& names, std::size_t pairs, int steps, const Backend& machine, bool quiet) {
    const std::vector<Kind> all = kinds();
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i; j < all.size(); ++j) {
            if (i + j == 0 || names.empty() || is_named(names, all[i], all[j])) candidates.push_back({all[i], all[j], {}, {}});
        }
    }
    const int count = static_cast<int>(candidates.size()), rounds = (steps + at_a_time - 1) / at_a_time;
    Progress progress(fmt::format("{} pairs of each two kinds", pairs), (1 + rounds) * count, "parts", quiet);
    for (int i = 0; i < count && !is_interrupted(); ++i) {
        Candidate& candidate = candidates[static_cast<std::size_t>(i)];
        candidate.scene = pairs_of(candidate.a, candidate.b, touching_distances(candidate.a, candidate.b, pairs));
        progress.done(i + 1);
    }
    for (int part = 0; part < rounds * count && !is_interrupted(); ++part) {
        sample(candidates[static_cast<std::size_t>(part % count)], machine);
        progress.done(count + part + 1);
    }
    if (is_interrupted()) return {};
    KindCosts result{candidates.front().device, rounds * at_a_time, {}};
    const double boxes = median(candidates.front().ms);
    for (const Candidate& candidate : candidates) {
        const double ms = median(candidate.ms);
        result.costs.push_back(
            {candidate.a.name, candidate.b.name, pairs, candidate.touching, ms * 1e6 / static_cast<double>(pairs), ms / boxes});
    }
    return result;
}

std::vector<Cells> kind_rows(const std::vector<KindCost>& costs) {
    std::vector<Cells> rows = {{"kinds", "pairs", "touching %", "ns/pair", "of box-box"}};
    for (const KindCost& cost : costs) {
        rows.push_back({cost.a + "-" + cost.b, std::to_string(cost.pairs), fmt::format("{:.1f}", 100 * cost.touching),
                        fmt::format("{:.1f}", cost.nanoseconds), fmt::format("{:.2f}", cost.of_box_box)});
    }
    return rows;
}

}  // namespace scree::demos
