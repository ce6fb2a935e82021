// A drum that turns about a level axis, with a bed of balls in it.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "compute/grains.h"
#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr std::size_t many_balls = 500;  // with fewer a bed is a few balls thick, and slumps

// All lengths follow from the volume of the balls.
struct Drum {
    explicit Drum(double solids) {
        constexpr double share = 0.11;  // of the drum that is solid: balls in rows fill a box in it
        radius = std::max(portable::cbrt(static_cast<float>(solids / (share * std::numbers::pi * 0.8))), 3 * ball);
        length = static_cast<float>(solids / (share * std::numbers::pi)) / (radius * radius);
        length = std::max(length, 3 * ball);
        spin = std::sqrt(froude * 9.81f / radius);
    }
    // Mellmann (Powder Technology 118, 2001): a bed of this share cascades from 1e-3 to 1e-1, and centrifuges from 1 on.
    static constexpr float froude = 0.03f;  // spin^2 radius / g
    static constexpr float ball = 0.1f;     // m, largest
    static constexpr float ridge = 0.07f;   // of the radius
    float radius, length;                   // m
    float spin;                             // rad/s, about z
};

// A closed mesh whose faces look inwards: one sees through it from outside.
Body mesh_of(const Drum& drum) {
    constexpr std::uint32_t sides = 60;
    Mesh mesh;
    const float outer = drum.radius / portable::cos(static_cast<float>(std::numbers::pi) / sides);
    for (std::uint32_t k = 0; k < sides; ++k) {
        const float angle = 2 * static_cast<float>(std::numbers::pi) * static_cast<float>(k) / sides;
        const float corner =
            k % 5 == 0 ? (1 - Drum::ridge) * outer : outer;  // ridges lift the balls, which would roll on the wall
        for (const float end : {-0.5f, 0.5f})
            mesh.vertices.emplace_back(corner * portable::cos(angle), corner * portable::sin(angle), end * drum.length);
    }
    mesh.vertices.emplace_back(0, 0, -0.5f * drum.length);
    mesh.vertices.emplace_back(0, 0, 0.5f * drum.length);
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t back = 2 * k, next = 2 * ((k + 1) % sides);
        mesh.triangles.emplace_back(back, back + 1, next + 1);
        mesh.triangles.emplace_back(back, next + 1, next);
        mesh.triangles.emplace_back(back, next, 2 * sides);
        mesh.triangles.emplace_back(next + 1, back + 1, 2 * sides + 1);
    }
    Body body;
    body.name = "drum";
    body.motion = Motion::kinematic;
    body.shape = std::move(mesh);
    body.friction = 0.8f;
    body.angular_velocity = {0, 0, drum.spin};
    return body;
}

// Of the bed's centre of mass, degrees: 0 below the axis, positive where the wall rises.
double lean(const Trace& trace, const Trace::Moment& moment) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < moment.bodies.size(); ++i)
        if (trace.scene.bodies[i].motion == Motion::dynamic)
            sum += static_cast<double>(mass_properties(trace.scene.bodies[i]).mass) * glm::dvec3(moment.bodies[i].position);
    return portable::atan2(sum.x, -sum.y) / static_cast<double>(degrees);
}
double mean_lean(const Trace& trace) {
    double mean = 0;
    for (const Trace::Moment& moment : trace.snapshots) mean += lean(trace, moment) / static_cast<double>(trace.snapshots.size());
    return mean;
}

// Of the balls at the wall, that do not flow: the median of their speed along the wall, of the wall's own there.
double carried(const Trace& trace, const Drum& drum) {
    std::vector<double> shares;
    for (const Trace::Moment& moment : trace.snapshots)
        for (std::size_t i = 0; i < moment.bodies.size(); ++i) {
            if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
            const vec3 at = moment.bodies[i].position, v = moment.bodies[i].velocity;
            const double r = std::sqrt(static_cast<double>(at.x * at.x + at.y * at.y));
            if (r < static_cast<double>(drum.radius - 0.6f * Drum::ball)) continue;
            shares.push_back(static_cast<double>(at.x * v.y - at.y * v.x) / (r * r * static_cast<double>(drum.spin)));
        }
    if (shares.empty()) return 0;
    std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
    return shares[shares.size() / 2];
}

}  // namespace

DemoScene drum(const DemoOptions& options) {
    Grains grains;
    grains.sieve = {{0.7f * Drum::ball, 0}, {0.85f * Drum::ball, 50}, {Drum::ball, 100}};
    grains.material.friction = 0.4f;
    grains.rolling = 0.05f;
    grains.seed = options.seed;
    grains.count = options.bodies;
    const Drum drum(GrainSupply(grains).mass() / static_cast<double>(grains.density));
    const float half = 0.65f * drum.radius, end = 0.5f * drum.length;
    grains.region = GrainBox{{-half, -half, -end}, {half, half, end}};
    const auto supply = std::make_shared<const GrainSupply>(grains);
    Scene scene;
    scene.bodies.push_back(mesh_of(drum));
    constexpr float seconds = 12;
    std::vector<double> times;
    for (int i = 0; i < 21; ++i) times.push_back(static_cast<double>(seconds) * 0.5 + 0.25 * i);
    const float far = drum.radius + 0.01f;
    Promise promise(all_within({-far, -far, -end - 0.01f}, {far, far, end + 0.01f}),
                    because(penetration_below(0.02), any_number));
    if (options.bodies >= many_balls) {
        promise.also(because(between("lean of the bed", 30, 50, "degrees",
                                     "angle of its centre of mass from below the axis, mean of the second half", mean_lean),
                             any_number));
        promise.also(because(at_most("change of this lean", 7, "degrees", "greatest from its mean, in the second half",
                                     [](const Trace& trace) {
                                         const double mean = mean_lean(trace);
                                         double most = 0;
                                         for (const Trace::Moment& moment : trace.snapshots)
                                             most = std::max(most, std::abs(lean(trace, moment) - mean));
                                         return most;
                                     }),
                             any_number));
        promise.also(because(between("speed of balls at the wall, of the wall's", 0.9, 1.02, "", "median in the second half",
                                     [drum](const Trace& trace) { return carried(trace, drum); }),
                             any_number));
    }
    const vec3 high(drum.radius, drum.radius, end), low = -high;
    DemoScene made{
        std::move(scene), view_of(low, high, 20, 12), low, high, seconds, std::move(promise).keeping(std::move(times))};
    made.others = [supply](const TakeBody& take) { supply->place(take); };
    return made;
}

}  // namespace scree::demos
