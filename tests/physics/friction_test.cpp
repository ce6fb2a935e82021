// Friction of a patch at a given slip and spin, against maximum dissipation and the quadrature of uniform pressure.
#include <catch2/catch.hpp>
#include <cmath>

#include "shaders/physics/contact/friction.h"

using namespace scree;
using namespace scree::physics;

namespace {

constexpr double turn = 6.283185307179586;

// A body of 1 kg over the fixed A, with different moments of inertia, turned so that no axis is a tangent.
Mass uneven(double yaw) {
    const vec4 q(0, static_cast<float>(std::sin(yaw / 2)), 0, static_cast<float>(std::cos(yaw / 2)));
    Mass mass = tensor_in_world(axes_of(q), vec3(25, 3, 2.5f));
    mass.inverse_mass = 1;
    mass.split = 1;
    return mass;
}
Mass nothing() {
    Mass mass{};
    mass.split = 1;
    return mass;
}
Constraint patch(float twist_arm) {
    Constraint c{};
    c.normal = vec3(0, 1, 0);
    c.friction = 0.3f;
    c.centre = vec3(0, -0.3f, 0);
    c.flags = 4 | CONSTRAINT_ON_B;
    c.twist_arm = twist_arm;
    return c;
}
// Without gravity; the anchor of friction has the default settings' spring and leak at 480 substeps a second.
Parameters plain() {
    Parameters parameters{};
    parameters.h = 1.0f / 480;
    parameters.bias_rate = 19;
    parameters.impulse_scale = 0.052f;
    parameters.max_spin = 377;
    return parameters;
}
// The friction that the passes settle at while the body slides on at this velocity; normal impulse 1 N s.
Impulse settled(const Constraint& c, vec3 slip, vec3 spin, const Mass& mass) {
    SolveResult s{};
    const Parameters parameters = plain();
    for (int pass = 0; pass < 200; ++pass) {
        s.pair_velocity = {};
        s.pair_velocity.b.angular = spin;
        s.pair_velocity.b.linear = slip - cross3(spin, c.centre);
        s = solve_patch_friction(c, s, 1, nothing(), mass, false, parameters);
    }
    return s.impulse;
}

}  // namespace

TEST_CASE("friction opposes the slip of a body of any inertia at any yaw") {
    for (const double yaw : {0.0, 0.3, 0.8, 1.3}) {
        for (const double way : {0.0, 0.7, 2.0}) {
            for (const float speed : {0.05f, 3.0f}) {
                const vec3 slip(speed * static_cast<float>(std::cos(way)), 0, speed * static_cast<float>(std::sin(way)));
                const vec3 f = settled(patch(0.2f), slip, vec3(0), uneven(yaw)).friction;
                INFO("yaw " << yaw << ", slip " << way << " rad, " << speed << " m/s");
                CHECK(length3(f) == Approx(0.3).epsilon(1e-3));
                CHECK(dot3(f, slip) == Approx(-0.3 * static_cast<double>(speed)).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("spin and slip share the friction of a disc as under uniform pressure, within 3%") {
    const double radius = 0.5;
    for (const double ratio : {0.1, 0.5, 1.0, 1.5, 3.0, 10.0}) {  // of the slip to radius x spin
        double force = 0, moment = 0, area = 0;
        for (int ring = 0; ring < 200; ++ring) {
            const double r = (ring + 0.5) / 200 * radius;
            for (int k = 0; k < 200; ++k) {
                const double at = turn * (k + 0.5) / 200, u = ratio * radius - r * std::sin(at), w = r * std::cos(at);
                force += r * u / std::hypot(u, w);
                moment += r * r * (std::cos(at) * w - std::sin(at) * u) / std::hypot(u, w);
                area += r;
            }
        }
        const Impulse impulse = settled(patch(static_cast<float>(radius * 2 / 3)),
                                        vec3(static_cast<float>(ratio * radius * 4), 0, 0), vec3(0, 4, 0), uneven(0));
        INFO("slip of " << ratio << " R w");
        CHECK(std::abs(-static_cast<double>(impulse.friction.x) - 0.3 * force / area) < 0.03 * 0.3);
        CHECK(std::abs(-static_cast<double>(impulse.twist) - 0.3 * moment / area) < 0.03 * 0.3 * radius);
    }
}

TEST_CASE("friction stops a slow slip and spin at once") {
    const Mass mass = uneven(0.5);
    SolveResult s{};
    s.pair_velocity.b.linear = vec3(0.01f, 0, 0.02f);
    s.pair_velocity.b.angular = vec3(0, 0.02f, 0);
    const Constraint c = patch(0.2f);
    s = solve_patch_friction(c, s, 1, nothing(), mass, false, plain());
    const vec3 left = velocity_at(lever_arms(c, c.centre, vec3(0)), s.pair_velocity);
    CHECK(std::hypot(left.x, left.z) < 1e-6f);
    CHECK(std::abs(s.pair_velocity.b.angular.y) < 1e-6f);
}

TEST_CASE("a contact that has all but let go gives its friction back, and nothing more") {
    for (const float normal : {0.0f, 1e-30f, 1e-20f, 1e-10f}) {
        SolveResult s{};
        s.pair_velocity.b.linear = vec3(3, 0, 1);
        s.impulse.friction = vec3(5, 0, 2);
        s.impulse.twist = 0.5f;
        s = solve_patch_friction(patch(0.2f), s, normal, nothing(), uneven(0.5), false, plain());
        INFO("normal impulse " << normal << " N s");
        CHECK(length3(s.impulse.friction) < 1e-9f);
        CHECK(std::abs(s.impulse.twist) < 1e-9f);
        CHECK(s.pair_velocity.b.linear.x == Approx(-2));
        CHECK(s.pair_velocity.b.linear.z == Approx(-1));
    }
}

TEST_CASE("rolling resistance opposes the rotation of a body of any inertia") {
    Constraint c = patch(0);
    c.friction = 0;
    c.rolling_resistance = 0.01f;
    const vec3 spin(2, 1, 3);
    const vec3 resisting = settled(c, vec3(0), spin, uneven(0.7)).rolling;
    CHECK(length3(resisting) == Approx(0.01).epsilon(1e-3));
    CHECK(dot3(resisting, spin) == Approx(-0.01 * static_cast<double>(length3(spin))).epsilon(1e-4));
}

TEST_CASE("what a turning body carries along is held against the curvature of its path") {
    // A turns about its centre, B goes with it at 2 m: friction makes up for half a substep of w^2 r.
    const Constraint c = patch(0.2f);
    const Parameters parameters = plain();
    SolveResult s{};
    s.impulse.center_offset = vec3(2, 0.3f, 0);
    s.pair_velocity.a.angular = s.pair_velocity.b.angular = vec3(0, 1.5f, 0);
    s.pair_velocity.b.linear = cross3(vec3(0, 1.5f, 0), s.impulse.center_offset);
    s = solve_patch_friction(c, s, 1, nothing(), uneven(0), false, parameters);
    const LeverArms r = lever_arms(c, c.centre, s.impulse.center_offset);
    const double inwards = -static_cast<double>(velocity_at(r, s.pair_velocity).x);
    CHECK(inwards == Approx(0.5 / 480 * 1.5 * 1.5 * 2).epsilon(1e-3));
}

TEST_CASE("a patch that sticks is pulled back along its stretch, as a spring in the metric of the bodies") {
    const Mass mass = uneven(0.5);
    const Constraint c = patch(0.2f);
    SolveResult s{};
    s.impulse.stretch = vec3(1e-4f, 0, -2e-4f);
    s.impulse.turn = 3e-4f;
    const SolveResult after = solve_patch_friction(c, s, 1, nothing(), mass, true, plain());
    const vec3 back = velocity_at(lever_arms(c, c.centre, vec3(0)), after.pair_velocity);
    CHECK(back.x == Approx(-19 * 1e-4).epsilon(1e-3));
    CHECK(back.z == Approx(19 * 2e-4).epsilon(1e-3));
    CHECK(after.impulse.stretch.x == 1e-4f);
    const SolveResult relaxed = solve_patch_friction(c, s, 1, nothing(), mass, false, plain());
    CHECK(length3(relaxed.impulse.friction) == 0);  // the relax pass has no bias
}

TEST_CASE("a patch that has slid keeps the stretch at which the anchor bears its friction") {
    const Mass mass = uneven(0.5);
    const Constraint c = patch(0.2f);
    SolveResult s{};
    s.pair_velocity.b.linear = vec3(1, 0, 0.5f);
    for (int pass = 0; pass < 100; ++pass) {
        s = solve_patch_friction(c, s, 1, nothing(), mass, true, plain());
        s.pair_velocity = {};
        s.pair_velocity.b.linear = vec3(1, 0, 0.5f);
    }
    CHECK(length3(s.impulse.friction) == Approx(0.3).epsilon(1e-3));
    // Without slip, friction stays as it is: spring and leak are in balance.
    SolveResult at_rest = s;
    at_rest.pair_velocity = {};
    at_rest = solve_patch_friction(c, at_rest, 1.1f, nothing(), mass, true, plain());
    CHECK(length3(at_rest.impulse.friction - s.impulse.friction) < 0.01f * length3(s.impulse.friction));
}

TEST_CASE("what touches in one point has no anchor, nor what bears nothing") {
    Constraint c = patch(0);
    c.flags = 1 | CONSTRAINT_ON_B;
    SolveResult s{};
    s.impulse.stretch = vec3(1e-4f, 0, 0);
    s = solve_patch_friction(c, s, 1, nothing(), uneven(0), true, plain());
    CHECK(length3(s.impulse.friction) == 0);
    CHECK(length3(s.impulse.stretch) == 0);
    VelocityPair sliding{};
    sliding.b.linear = vec3(1, 0, 0);
    CHECK(length3(stretched(patch(0.2f), Impulse{}, sliding, plain()).stretch) == 0);
    Impulse bearing{};
    bearing.normal.x = 1;
    CHECK(stretched(patch(0.2f), bearing, sliding, plain()).stretch.x == Approx(1.0 / 480));
}
