// Granular media: grains that run out of a hopper, and a sleeper on ballast under a wheel's load.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "compute/grains.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/shape_geometry.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float of_gravity = 9.81f;          // m/s^2
constexpr std::size_t few_grains = 500;      // fewer are no medium, of whose flow something could be promised
constexpr std::size_t steady_grains = 1000;  // fewer run out in bursts: arches form over the outlet, and break

// A fixed mesh of square rings, one above the other, whose faces look inwards: one sees through it from outside.
Body rings(const char* name, const std::vector<glm::vec2>& half_widths_and_heights, float friction) {
    Mesh mesh;
    for (const glm::vec2 ring : half_widths_and_heights)
        for (int k = 0; k < 4; ++k)
            mesh.vertices.emplace_back(k == 1 || k == 2 ? ring.x : -ring.x, ring.y, k >= 2 ? ring.x : -ring.x);
    for (std::uint32_t r = 0; r + 1 < half_widths_and_heights.size(); ++r) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t a = 4 * r + k, b = 4 * r + (k + 1) % 4;
            mesh.triangles.emplace_back(a, b, b + 4);
            mesh.triangles.emplace_back(a, b + 4, a + 4);
        }
    }
    Body body;
    body.name = name;
    body.motion = Motion::fixed;
    body.shape = std::move(mesh);
    body.friction = friction;
    return body;
}

std::uint64_t step_at(float seconds, const World& world) {
    return static_cast<std::uint64_t>(std::lround(seconds * world.settings().rate));
}

// ---- the hopper. All lengths follow from the cube root of the grains' number.
struct Hopper {
    explicit Hopper(std::size_t count)
        : scale(grain * portable::cbrt(static_cast<float>(std::max<std::size_t>(count, 1)))),
          half_width(std::max(0.55f * scale, 4 * grain)),
          half_outlet(std::max(0.2f * scale, 2.8f * grain)),
          outlet(0.8f * scale + 3 * grain),
          shoulder(outlet + half_width - half_outlet),
          rim(shoulder + 5.0f * static_cast<float>(count) * grain * grain * grain / (4 * half_width * half_width) + 4 * grain),
          open(1.5f + 0.7f * std::sqrt(scale)) {}

    // Beverloo, Leniger and van de Velde (1961), for a square outlet, kg/s.
    double beverloo(double density) const {
        const double wide = 2 * static_cast<double>(half_outlet) - 1.4 * static_cast<double>(grain);
        return 0.58 * 0.58 * density * std::sqrt(static_cast<double>(of_gravity)) * wide * wide * std::sqrt(wide) * 4 /
               std::numbers::pi;
    }

    static constexpr float grain = 0.1f;  // m
    float scale, half_width, half_outlet;
    float outlet, shoulder, rim;  // m, heights: of the outlet, where the walls become upright, and of their rim
    float open;                   // s, when the gate opens
};

// kg that have left, at a moment.
double mass_below(const Trace& trace, const Trace::Moment& moment, float height) {
    double mass = 0;
    for (std::size_t i = 0; i < moment.bodies.size(); ++i)
        if (trace.scene.bodies[i].motion == Motion::dynamic && moment.bodies[i].position.y < height)
            mass += static_cast<double>(mass_properties(trace.scene.bodies[i]).mass);
    return mass;
}

// kg/s between neighbouring snapshots.
std::vector<double> flows(const Trace& trace, float height) {
    std::vector<double> found;
    for (std::size_t i = 1; i < trace.snapshots.size(); ++i)
        found.push_back((mass_below(trace, trace.snapshots[i], height) - mass_below(trace, trace.snapshots[i - 1], height)) /
                        (trace.snapshots[i].time - trace.snapshots[i - 1].time));
    return found;
}

// `count`: of all grains.
double mean_of(const std::vector<double>& values) {
    double mean = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    return mean;
}

Promise promise_of(const Hopper& hopper, double density, double seconds_of_flow, std::size_t count) {
    const float height = hopper.outlet - Hopper::grain, far = hopper.half_width + 0.05f;
    std::vector<double> times;
    for (const double part : {0.15, 0.4, 0.65, 0.9}) times.push_back(static_cast<double>(hopper.open) + part * seconds_of_flow);
    const double law = hopper.beverloo(density);
    Promise promise(at_least("grains that ran out, of all", 0.99, "", "at the end",
                             [height](const Trace& trace) {
                                 double out = 0, all = 0;
                                 for (std::size_t i = 0; i < trace.end.size(); ++i) {
                                     if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
                                     all += 1;
                                     out += trace.end[i].position.y < height;
                                 }
                                 return all > 0 ? out / all : 0;
                             }),
                    all_within({-far, 0, -far}, {far, hopper.rim, far}), because(penetration_below(0.02), any_number));
    if (count < few_grains) return promise;
    if (count >= steady_grains)
        promise.also(because(at_most("mass flow's change, of its mean", 0.1 + 8 / std::sqrt(static_cast<double>(count)), "",
                                     "greatest less least of three spans while it runs out",
                                     [height](const Trace& trace) {
                                         const std::vector<double> all = flows(trace, height);
                                         if (all.empty()) return no_number;
                                         const auto [least, most] = std::minmax_element(all.begin(), all.end());
                                         return (*most - *least) / mean_of(all);
                                     }),
                             any_number));
    promise.also(because(between("mass flow, of Beverloo's law", 0.5, 1.1, "", "mean of these spans",
                                 [height, law](const Trace& trace) { return mean_of(flows(trace, height)) / law; }),
                         any_number));
    return std::move(promise).keeping(std::move(times));
}

}  // namespace

DemoScene hopper(const DemoOptions& options) {
    const Hopper hopper(options.bodies);
    constexpr float friction = 0.5f, g = Hopper::grain;
    const float w = hopper.half_width;
    Scene scene;
    scene.bodies.push_back(ground(friction));
    scene.bodies.push_back(rings("hopper", {{hopper.half_outlet, hopper.outlet}, {w, hopper.shoulder}, {w, hopper.rim}}, 0.3f));
    scene.bodies.push_back(rings("bin", {{w, 0}, {w, hopper.outlet - 2.5f * g}}, friction));
    const float half_gate = hopper.half_outlet + g;
    const std::size_t gate = add_body(scene, Box{{half_gate, 0.1f * g, half_gate}}, {0, hopper.outlet - 0.11f * g, 0});
    scene.bodies[gate].motion = Motion::kinematic;
    scene.bodies[gate].name = "gate";
    Grains grains;
    grains.sieve = {{0.8f * g, 0}, {0.9f * g, 30}, {1.05f * g, 75}, {1.2f * g, 100}};
    grains.shapes = {{PolyhedronGrain{.elongation = 0.85f, .flatness = 0.85f, .roundness = 0.6f, .corners = 14}}};
    grains.material.friction = friction;
    grains.seed = options.seed;
    grains.count = options.bodies;
    grains.region = GrainBox{{-w, hopper.shoulder, -w}, {w, hopper.rim, w}};
    const auto supply = std::make_shared<const GrainSupply>(grains);
    const double flow_time = supply->mass() / hopper.beverloo(static_cast<double>(grains.density));
    const float seconds = hopper.open + 1.6f * static_cast<float>(flow_time) + 1.5f;
    const float way = 2 * half_gate + g;
    // The gate slides aside within half a second.
    Script script = [gate, way, open = hopper.open](World& world) {
        if (world.steps() == step_at(open, world)) world.set_velocity(gate, {2 * way, 0, 0}, vec3(0));
        if (world.steps() == step_at(open + 0.5f, world)) world.set_velocity(gate, vec3(0), vec3(0));
    };
    const vec3 low(-1.1f * w, 0, -1.1f * w), high(1.1f * w, 0.5f * (hopper.shoulder + hopper.rim), 1.1f * w);
    DemoScene made{std::move(scene),
                   view_of(low, high, 25, 12),
                   low,
                   high,
                   seconds,
                   promise_of(hopper, static_cast<double>(grains.density), flow_time, options.bodies),
                   true,
                   std::move(script)};
    made.others = [supply](const TakeBody& take) { supply->place(take); };
    return made;
}

// ---- ballast
namespace {

// A block of a sleeper on a bed in a pit. Lengths follow from the stones' volume.
struct Bed {
    explicit Bed(double stones) : side(portable::cbrt(static_cast<float>(stones / (0.55 * 0.5)))) {}
    float depth() const { return 0.5f * side; }
    vec3 half_block() const { return {0.34f * side, 0.07f * side, 0.2f * side}; }
    // Twice the block's weight, N. Contacts are soft for what a stone weighs: a wheel's load would need many more substeps.
    double load() const {
        return 2 * 8 * static_cast<double>(half_block().x * half_block().y * half_block().z * block_density * of_gravity);
    }

    static constexpr float block_density = 2400;     // kg/m^3
    static constexpr float cycle = 1;                // s
    static constexpr float laid = 3, loaded = 4.5f;  // s, when the block is laid, and when its load begins
    static constexpr int cycles = 4;
    static constexpr float seconds = loaded + cycles * cycle + 0.5f;
    float side;  // m
};
// The sleeper hangs above the pit until it is laid on the highest stone below it.
void lay_sleeper(World& world, std::size_t sleeper, const Bed& bed) {
    const vec3 half = bed.half_block();
    float top = 0;
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = world.scene().bodies[i];
        if (body.motion != Motion::dynamic) continue;
        const float reach = bounding_radius(body.shape);
        const vec3 at = states[i].position;
        if (std::abs(at.x) < half.x + reach && std::abs(at.z) < half.z + reach) top = std::max(top, at.y + reach);
    }
    world.set_motion(sleeper, Motion::dynamic);
    const BodyChange change{.body = sleeper, .position = vec3(0, top + half.y, 0)};
    world.set_bodies({&change, 1});
}

constexpr std::size_t sleeper = 2;  // its index

}  // namespace

DemoScene ballast(const DemoOptions& options) {
    Grains grains;
    grains.sieve = {{0.0224f, 0}, {0.0315f, 5}, {0.04f, 45}, {0.05f, 85}, {0.063f, 100}};
    grains.shapes = {{PolyhedronGrain{.elongation = 0.75f, .flatness = 0.75f, .roundness = 0.15f, .corners = 12}}};
    grains.material.friction = 0.7f;
    grains.seed = options.seed;
    grains.count = options.bodies;
    const double density = static_cast<double>(grains.density);
    const Bed bed(GrainSupply(grains).mass() / density);
    const float half = 0.5f * bed.side, wall = 4 * bed.side;
    grains.region = GrainBox{{-half, 0, -half}, {half, wall, half}};
    const auto supply = std::make_shared<const GrainSupply>(grains);
    Scene scene;
    scene.bodies.push_back(ground(0.7f));
    scene.bodies.push_back(rings("pit", {{half, 0}, {half, wall}}, 0.5f));
    Body block = box_at({0, wall + 2 * bed.side, 0}, bed.half_block());
    block.name = "sleeper";
    block.motion = Motion::kinematic;
    block.density = Bed::block_density;
    block.friction = 0.7f;
    scene.bodies.push_back(block);
    Script script = [bed](World& world) {
        if (world.steps() == step_at(Bed::laid, world)) lay_sleeper(world, sleeper, bed);
        const auto first = step_at(Bed::loaded, world), end = step_at(Bed::loaded + Bed::cycles * Bed::cycle, world);
        if (world.steps() < first || world.steps() >= end) return;
        const double turn =
            2 * std::numbers::pi * static_cast<double>(world.steps() - first) / static_cast<double>(step_at(Bed::cycle, world));
        world.apply_force(sleeper, {0, static_cast<float>(-bed.load() * 0.5 * (1 - portable::cos(turn))), 0});
    };
    const double depth = static_cast<double>(bed.depth());
    const float far = half + 0.02f;
    Promise promise(because(at_most("settlement under the load, of the bed's depth", 0.16, "", "from before the load to the end",
                                    [depth](const Trace& trace) {
                                        return static_cast<double>(trace.snapshots.front().bodies[sleeper].position.y -
                                                                   trace.snapshots.back().bodies[sleeper].position.y) /
                                               depth;
                                    }),
                            any_number),
                    all_within({-far, 0, -far}, {far, wall, far}), because(penetration_below(0.01), any_number));
    if (options.bodies >= few_grains)
        promise.also(because(at_most("tilt of the sleeper", 8, "degrees", "at the end",
                                     [](const Trace& trace) {
                                         return tilt(trace.snapshots.back().bodies[sleeper], {0, 1, 0});
                                     }),
                             any_number));
    const vec3 low(-half, 0, -half), high(half, 0.9f * bed.side, half);
    DemoScene made{
        std::move(scene),
        view_of(low, high, 30, 30),
        low,
        high,
        Bed::seconds,
        std::move(promise).keeping({static_cast<double>(Bed::loaded) - 0.05, static_cast<double>(Bed::seconds) - 0.05}),
        true,
        std::move(script)};
    made.others = [supply](const TakeBody& take) { supply->place(take); };
    return made;
}

}  // namespace scree::demos
