// Persistent manifolds, effective mass of contact points, and mass splitting.
#include <catch2/catch.hpp>
#include <cmath>

#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/contact/contact.h"
#include "shaders/physics/contact/contact_constraint.h"
#include "shaders/physics/contact/persistence.h"

using namespace scree;
using namespace scree::physics;

namespace {

BodyProperties box(float half) {
    BodyProperties properties{};
    properties.shape = SHAPE_BOX;
    properties.size = vec3(half);
    properties.friction = 0.6f;
    return properties;
}
BodyProperties ball(float radius) {
    BodyProperties properties{};
    properties.shape = SHAPE_SPHERE;
    properties.size = vec3(radius);
    properties.friction = 0.6f;
    return properties;
}

vec4 about_x(double degrees) {
    const double half = degrees * 3.14159265358979 / 360;
    return {static_cast<float>(std::sin(half)), 0, 0, static_cast<float>(std::cos(half))};
}

// Whether the manifold of two stacked 1 m boxes with four points persists after both have rotated.
bool kept(vec4 turn_a, vec4 turn_b, vec3 spin_b = vec3(0)) {
    Contact contact{};
    contact.count = 4;
    contact.normal = vec3(0, 1, 0);
    contact.center_offset = vec3(0, 1, 0);
    contact.orientation_a = contact.orientation_b = vec4(0, 0, 0, 1);
    // Narrow along the axis of rotation, so that slip does not end the manifold earlier.
    for (int k = 0; k < 4; ++k) contact.points[k] = vec4(k % 2 == 0 ? 0.5f : -0.5f, 0.5f, k < 2 ? 0.01f : -0.01f, 0);
    Impulse impulse = no_impulse(contact.center_offset);
    impulse.normal = vec4(1);
    Pose a{}, b{};
    a.orientation = turn_a;
    b.orientation = turn_b;
    // B moves with A's face.
    b.position = rotate(turn_a, vec3(0, 0.5f, 0)) + rotate(turn_b, vec3(0, 0.5f, 0));
    Velocity va{}, vb{};
    vb.angular = spin_b;
    vb.linear = cross3(spin_b, vec3(0, 0.5f, 0));  // about the centre of the contact
    return may_persist(impulse, SHAPE_BOX, SHAPE_BOX) && is_persistent(contact, box(0.5f), a, va, box(0.5f), b, vb);
}

Parameters some_parameters() {
    Parameters parameters{};
    parameters.inverse_relaxation = 1 / 1.5f;
    parameters.speculative = 0.02f;
    return parameters;
}

}  // namespace

TEST_CASE("a contact is let go when a body tips against the other, not when both turn together") {
    const vec4 still(0, 0, 0, 1);
    CHECK(kept(still, still));
    CHECK(kept(still, about_x(0.3)));
    CHECK_FALSE(kept(still, about_x(0.5)));
    CHECK_FALSE(kept(about_x(-0.5), still));
    CHECK(kept(about_x(3), about_x(3.3)));
    CHECK_FALSE(kept(about_x(6), about_x(6)));
    CHECK(kept(still, still, vec3(0.04f, 0, 0)));
    CHECK_FALSE(kept(still, still, vec3(0.06f, 0, 0)));
}

TEST_CASE("a corner resists twisting as a patch of a hundredth of the body, a ball does not") {
    Contact contact{};
    contact.count = 1;
    contact.normal = vec3(0, 1, 0);
    contact.orientation_a = contact.orientation_b = vec4(0, 0, 0, 1);
    CHECK(constraint_of(contact, box(0.5f), box(2), 0, 1, some_parameters()).twist_arm == Approx(0.005f));
    CHECK(constraint_of(contact, box(0.5f), ball(2), 0, 1, some_parameters()).twist_arm == 0);
    CHECK(constraint_of(contact, ball(0.5f), ball(2), 0, 1, some_parameters()).twist_arm == 0);
}

TEST_CASE("of a body's mass half is shared alike and half by what presses") {
    const Parameters parameters = some_parameters();
    const float packed = pack_shares(3, 8);
    const float parts[] = {1 / split_factor(packed, 4, parameters), 1 / split_factor(packed, 4, parameters),
                           1 / split_factor(packed, 0, parameters)};
    CHECK(parts[0] == Approx(1.5 * (0.5 / 3 + 0.25)).epsilon(0.01));
    CHECK(parts[2] == Approx(1.5 * (0.5 / 3)).epsilon(0.01));
    CHECK(parts[0] + parts[1] + parts[2] == Approx(1.5).epsilon(0.01));
    CHECK(split_factor(pack_shares(1, 8), 8, parameters) == 1);
    CHECK(split_factor(0, 0, parameters) == 1);  // no history for new bodies
}
