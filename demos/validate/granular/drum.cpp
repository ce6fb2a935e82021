// A rotating drum: how its grains move at which Froude number.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compute/measures.h"
#include "compute/scene/portable_math.h"
#include "demos/validate/granular/granular.h"

namespace scree::demos {

using namespace granular;

namespace {

constexpr std::size_t drum_grains = 620;
constexpr float drum_radius = 10 * d, drum_half_length = 2.5f * d;
constexpr double drum_fill = 0.35;
constexpr std::array<double, 5> froude_numbers = {0.002, 0.03, 0.4, 0.9, 3.2};

// A cylinder's inner surface about the z axis, of 60 strips that are ridges of
// a third of d: without them grains slide.
Body drum(float radius, float half_length) {
    constexpr std::uint32_t sides = 60;
    Mesh mesh;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / sides,
                    out = radius - (k % 2 != 0 ? d / 3 : 0);
        const vec3 way(out * portable::cos(angle), out * portable::sin(angle), 0);
        mesh.vertices.push_back(way - vec3(0, 0, half_length));
        mesh.vertices.push_back(way + vec3(0, 0, half_length));
    }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % sides);
        mesh.triangles.emplace_back(a, a + 1, b);
        mesh.triangles.emplace_back(b, a + 1, b + 1);
    }
    Body body;
    body.name = "drum";
    body.motion = Motion::kinematic;
    body.shape = std::move(mesh);
    body.friction = 0.8f;
    body.friction_rule = CombineRule::maximum;
    return body;
}

struct DrumState {
    double flying = 0;   // share of the grains that touch nothing
    double carried = 0;  // share that turns with the drum
    double slope = 0;    // of the surface, degrees
};

// Slope of the line through the highest grains of strips of the width d, in the
// middle of the drum.
double slope_of_surface(const std::vector<BodyState>& states, double radius) {
    const int strips = static_cast<int>(1.2 * radius / dd);
    std::vector<double> tops(static_cast<std::size_t>(strips), -2 * radius);
    for (std::size_t i = 3; i < states.size(); ++i) {
        const int strip = static_cast<int>(std::floor((static_cast<double>(states[i].position.x) + 0.6 * radius) / dd));
        if (strip < 0 || strip >= strips) continue;
        double& top = tops[static_cast<std::size_t>(strip)];
        top = std::max(top, static_cast<double>(states[i].position.y));
    }
    std::vector<PlotPoint> surface;
    for (int strip = 0; strip < strips; ++strip)
        if (tops[static_cast<std::size_t>(strip)] > -2 * radius)
            surface.push_back({strip * dd, tops[static_cast<std::size_t>(strip)]});
    return portable::atan(fit(surface).slope) * 180 / std::numbers::pi;
}

DrumState drum_at(const GranularLab& lab, std::uint64_t seed, double froude) {
    const double scale = lab.scale(drum_grains);
    const float radius = drum_radius * static_cast<float>(scale), half = drum_half_length;
    const double r = static_cast<double>(radius), spin = std::sqrt(froude * g / r);
    Scene scene;
    scene.bodies.push_back(drum(radius, half + d));
    scene.bodies.push_back(wall({0, 0, 1}, -half, 0));
    scene.bodies.push_back(wall({0, 0, -1}, -half, 0));
    const double volume = drum_fill * std::numbers::pi * r * r * 2 * static_cast<double>(half) * 0.58;
    add_grains(scene, grains_of(static_cast<std::size_t>(volume / (std::numbers::pi / 6 * dd * dd * dd)), seed, 0.5f,
                                GrainBox{{-0.62f * radius, -0.7f * radius, -half}, {0.62f * radius, 0.7f * radius, half}}));
    World world = lab.world(scene, 240, 6);
    lab.run(world, 1.5);
    world.set_velocity(0, vec3(0), {0, 0, static_cast<float>(spin)});

    // Two turns; where grains are carried round, until they all have come up to speed.
    lab.run(world, froude > 0.5 ? 10 : std::max(3.0, std::min(8.0, 4 * std::numbers::pi / spin)));
    DrumState state;
    std::vector<double> slopes;
    std::vector<double> turned(world.scene().bodies.size(), 0);
    int step = 0, taken = 0;
    const double seconds = 3;
    lab.run(world, seconds, [&] {
        if (++step % 12 != 0) return;
        const std::vector<BodyState> states = world.bodies();
        const Measures now = measure(world);
        for (std::size_t i = 3; i < states.size(); ++i) {
            state.flying += now.grains.coordination[i] == 0;
            const glm::dvec3 at = states[i].position, v = states[i].velocity;
            turned[i] += (at.x * v.y - at.y * v.x) / std::max(at.x * at.x + at.y * at.y, 0.01 * r * r);
        }
        slopes.push_back(slope_of_surface(states, r));
        ++taken;
    });
    const double grains = static_cast<double>(turned.size() - 3);
    state.flying /= grains * taken;
    for (std::size_t i = 3; i < turned.size(); ++i) state.carried += turned[i] / taken > 0.9 * spin;
    state.carried /= grains;
    state.slope = mean_of(slopes);
    return state;
}

GranularMeasured drums(const GranularLab& lab, std::uint64_t seed) {
    GranularMeasured measured{{}, {{"touch nothing", {}}, {"turn with the drum", {}}}};
    std::vector<DrumState> states;
    for (const double froude : froude_numbers) {
        states.push_back(drum_at(lab, seed, froude));
        const double x = std::log10(froude);
        measured.points[0].points.push_back({x, states.back().flying});
        measured.points[1].points.push_back({x, states.back().carried});
    }
    measured.figures = {states[0].slope,
                        states[1].flying / states[0].flying,
                        states[2].flying / states[1].flying,
                        100 * states[2].carried,
                        100 * states[3].carried,
                        100 * states[4].carried};
    return measured;
}

}  // namespace

std::vector<GranularCase> drum_cases() {
    return {
        {.name = "drum",
         .title = "grains in a rotating drum roll, cascade, fly and are carried round, by the Froude number Fr = w^2 R / g",
         .source =
             "Mellmann, Powder Technol. 118, 251 (2001): rolling at Fr from 1e-4 to 1e-2, cascading to 0.1, cataracting to 1, "
             "then centrifuging; statics: a layer at r turns with the drum all the way round above w^2 r / g = sqrt(1 + 1 / "
             "mu^2)",
         .setup =
             "spheres of 0.9 to 1.1 d, friction 0.5, in a drum of radius 10 d with ridges of d / 3, 5 d long, filled to 35%; "
             "friction of the drum 0.8, of its ends 0; 240 Hz, 6 substeps; mean over 3 s",
         .grains = drum_grains,
         .figures = {{"Fr 0.002 (rolling): slope of the surface, degrees", "20 to 35", 20, 35},
                     {"Fr 0.03 (cascading) over Fr 0.002: grains that touch nothing", "above 1", 1, 100},
                     {"Fr 0.4 (cataracting) over Fr 0.03: grains that touch nothing", "above 1", 1, 100},
                     {"Fr 0.4: grains that turn with the drum, %", "below 100", 0, 99},
                     {"Fr 0.9: grains that turn with the drum, %", "below 100", 0, 99},
                     {"Fr 3.2 (centrifuging): grains that turn with the drum, %", "100", 99, 100}},
         .plot = {.x = "log10 of the Froude number", .y = "share of the grains", .lines = {}, .points = {}, .whole_range = false},
         .measure = drums}};
}

}  // namespace scree::demos
