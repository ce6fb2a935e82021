// Unrest of contacts: who is restless, from when, and for how long.
#include <catch2/catch.hpp>

#include "shaders/physics/solve/contact_preparation.h"

using namespace scree::physics;

namespace {

Parameters on_earth() {
    Parameters parameters{};
    parameters.dt = 1.0f / 60;
    parameters.h = 1.0f / 480;
    parameters.gravity = vec3(0, -9.81f, 0);
    return parameters;
}
// A box of 1 m whose four points lie half a metre about its centre, on the ground.
Constraint on_the_ground() {
    Constraint c{};
    c.normal = vec3(0, 1, 0);
    c.flags = 4 | CONSTRAINT_ON_B;
    c.arms_x = vec4(-0.5f, 0.5f, 0.5f, -0.5f);
    c.arms_y = vec4(-0.5f);
    c.arms_z = vec4(-0.5f, -0.5f, 0.5f, 0.5f);
    return c;
}
float after_steps(int steps, float unrest, vec3 velocity, vec3 spin, float half_width = 0.5f) {
    VelocityPair v{};
    v.b.linear = velocity;
    v.b.angular = spin;
    const Parameters parameters = on_earth();
    for (int i = 0; i < steps; ++i)
        unrest = unrest_after(unrest, on_the_ground(), vec3(0, 0.5f, 0), v, calm_speed(half_width, parameters), parameters);
    return unrest;
}

}  // namespace

TEST_CASE("a contact that rocks is restless after four seconds, and until it was calm for twenty") {
    const vec3 still(0), rocking(0, 0, 0.05f);  // corners at 25 mm/s
    REQUIRE_FALSE(is_restless_contact(after_steps(235, 0, still, rocking)));
    const float restless = after_steps(245, 0, still, rocking);
    REQUIRE(is_restless_contact(restless));
    REQUIRE(is_restless_contact(after_steps(19 * 60, restless, still, still)));
    REQUIRE_FALSE(is_restless_contact(after_steps(21 * 60, restless, still, still)));
    REQUIRE(after_steps(60 * 60, restless, still, still) == 0.0f);
}

TEST_CASE("sliding and turning about the normal do not make a contact restless, and small bodies are restless at lower speeds") {
    const vec3 still(0);
    REQUIRE(after_steps(600, 0, vec3(3, 0, 1), vec3(0, 2, 0)) == 0.0f);
    const vec3 slowly(0, 0, 0.008f);  // corners at 4 mm/s, below a quarter of what gravity adds in a substep
    REQUIRE(after_steps(600, 0, still, slowly) == 0.0f);
    REQUIRE(is_restless_contact(after_steps(600, 0, still, slowly, 0.005f)));
}

TEST_CASE("a new manifold of two bodies keeps the unrest of the one before") {
    Pair pair{};
    Manifold manifold{};
    manifold.normal = vec3(0, 1, 0);
    manifold.points[0] = vec4(0, 0, 0, -0.001f);
    Pose a{}, b{};
    a.orientation = b.orientation = vec4(0, 0, 0, 1);
    b.position = vec3(0, 0.5f, 0);
    BodyProperties properties{};
    properties.size = vec3(0.5f);
    Contact before = contact_of(pair, manifold, 1, a, b);
    before.unrest = 3;
    const PreparedContact prepared =
        warm_started(without_impulses(contact_of(pair, manifold, 1, a, b)), before, no_impulse(vec3(0)), properties, properties);
    REQUIRE(prepared.contact.unrest == 3.0f);
}
