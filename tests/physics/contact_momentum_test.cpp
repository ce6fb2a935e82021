// Heavy-ball momentum of contact impulses: the law, and the sag of columns in closed form.
#include "shaders/physics/solve/contact_momentum.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

Mass split_in(float split) {
    Mass mass{};
    mass.split = split;
    return mass;
}

Impulse impulse_of(float now, float before) {
    Impulse impulse{};
    impulse.normal = vec4(now);
    impulse.solved_normal = vec4(before);
    return impulse;
}

// The first normal impulse after momentum of 0.5.
float after(float now, float before) {
    return with_momentum(impulse_of(now, before), 1, vec4(0.5f), vec4(0)).normal.x;
}

// A column awake for 20 s, in metres of sag of the topmost box.
double sag_of(int boxes, double half_extent, double gravity, Settings settings) {
    Scene scene;
    scene.gravity = vec3(0, -gravity, 0);
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < boxes; ++i) {
        Body body;
        body.shape = Box{vec3(static_cast<float>(half_extent))};
        body.position = vec3(0, half_extent * (2 * i + 1), 0);
        scene.bodies.push_back(body);
    }
    settings.sleeping = false;
    World world(scene, settings, 1);
    world.step(static_cast<int>(20 * settings.rate));
    return static_cast<double>(scene.bodies.back().position.y - world.bodies().back().position.y);
}

Parameters under_gravity() {
    Parameters parameters{};
    parameters.gravity = vec3(0, -1, 0);
    return parameters;
}

}  // namespace

TEST_CASE("contact momentum extrapolates the change of an impulse that lasts") {
    CHECK(after(2, 2) == 2);
    CHECK(after(3, 2) == 3.5f);
    CHECK(after(2, 3) == 1.5f);
    CHECK(after(1, 4) == 0);  // contacts never pull
    CHECK(after(2, 0) == 2);  // new points have no history
    CHECK(after(0, 2) == 0);  // points that have let go stay so
    CHECK(with_momentum(impulse_of(3, 2), 1, vec4(0.5f), vec4(0)).solved_normal.x == 3);
    CHECK(with_momentum(impulse_of(3, 2), 1, vec4(0.5f), vec4(0)).normal.y == 3);  // not a point of this contact
    Impulse struck = impulse_of(3, 2);
    struck.impact.x = 1;
    CHECK(with_momentum(struck, 1, vec4(0.5f), vec4(0)).normal.x == 3);  // impacts are exact
}

TEST_CASE("contact momentum restarts at a point that parts while its impulse falls") {
    const auto restarted = [](float now, float before) {
        return with_momentum(impulse_of(now, before), 1, vec4(0.5f), vec4(1)).normal.x;
    };
    CHECK(restarted(2, 3) == 0);
    CHECK(restarted(3, 2) == 3.5f);
    CHECK(restarted(2, 2) == 2);
}

TEST_CASE("contact momentum fades where mass is split among many contacts, and where a body overhangs its contact") {
    const auto momentum = [](float split_a, float split_b, float lever_a, float lever_b) {
        Mass a = split_in(split_a), b = split_in(split_b);
        a.inverse_mass = 2;
        b.inverse_mass = 0.5f;
        JacobianRow row{};
        row.inverse_effective_mass_a = 2 * (1 + lever_a);
        row.inverse_effective_mass_b = 0.5f * (1 + lever_b);
        return contact_momentum(row, 4, a, b, under_gravity());
    };
    CHECK(momentum(1, 2, 3, 3) == Approx(MOMENTUM));
    CHECK(momentum(1, MOMENTUM_SPLIT, 1, 1) == Approx(MOMENTUM));
    CHECK(momentum(40, 1, 3, 3) == Approx(MOMENTUM * MOMENTUM_SPLIT / 40));
    CHECK(momentum(1, 40, 3, 3) == Approx(MOMENTUM * MOMENTUM_SPLIT / 40));
    CHECK(momentum(1, 1, 0.1f, 3) == Approx(MOMENTUM * 0.1).epsilon(1e-4));
    CHECK(momentum(1, 1, 3, 0.1f) == Approx(MOMENTUM * 0.1).epsilon(1e-4));
    CHECK(contact_momentum(JacobianRow{}, 1, split_in(1), split_in(1), under_gravity()) == Approx(MOMENTUM));
    Mass fixed = split_in(1), moving = split_in(1);
    moving.inverse_mass = 1;
    JacobianRow row{};
    row.inverse_effective_mass_b = 4;
    CHECK(contact_momentum(row, 4, fixed, moving, Parameters{}) == 0);  // without gravity nothing bears a load
    CHECK(contact_momentum(row, 4, fixed, moving, under_gravity()) == Approx(MOMENTUM));
}

TEST_CASE("slabs on slender pillars come to rest") {
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    for (const float slab : {0.3f, 0.45f, 0.6f}) {
        const auto x = 3 * static_cast<float>(scene.bodies.size());
        Body pillar, plate;
        pillar.shape = Box{{0.1f, 1, 0.1f}};
        pillar.position = {x, 1, 0};
        plate.shape = Box{{slab, 0.1f, slab}};
        plate.position = {x, 2.1f, 0};
        scene.bodies.push_back(pillar);
        scene.bodies.push_back(plate);
    }
    World world(scene, {}, 1);
    world.step(300);
    CHECK(world.statistics().asleep == 6);
}

// Static compliance of a soft contact (contact_momentum.h): each contact gives way in proportion to its load and to the square
// of the substep, whatever the size of the boxes.
TEST_CASE("a column sags by its contacts' compliance, in proportion to gravity and the square of the substep") {
    struct Case {
        int boxes;
        double half_extent, gravity;
        float rate;
        int substeps;
    };
    for (const Case& c : {Case{6, 0.5, 9.81, 60, 8}, Case{6, 0.5, 9.81, 120, 8}, Case{6, 0.5, 9.81, 60, 16},
                          Case{6, 0.05, 9.81, 60, 8}, Case{5, 0.3, 1.62, 60, 8}, Case{5, 2, 24.8, 60, 8}}) {
        Settings settings;
        settings.rate = c.rate;
        settings.substeps = c.substeps;
        const double h = 1 / (static_cast<double>(c.rate) * c.substeps);
        const double expected = 0.00437 * std::pow(c.boxes / 10.0, 2) * std::pow(h * 480, 2) * c.gravity / 9.81;
        CAPTURE(c.boxes, c.half_extent, c.gravity, c.rate, c.substeps);
        CHECK(sag_of(c.boxes, c.half_extent, c.gravity, settings) == Approx(expected).epsilon(0.12));
    }
}
