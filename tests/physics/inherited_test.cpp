// Warm starting: impulses that a contact inherits from the previous step.
#include <catch2/catch.hpp>

#include "shaders/physics/contact/contact.h"

using namespace scree;
using namespace scree::physics;

namespace {

// A planar manifold of `count` points on a square, without rotation.
Contact patch(std::uint32_t count) {
    Contact contact{};
    contact.count = count;
    contact.normal = vec3(0, 1, 0);
    contact.orientation_a = contact.orientation_b = vec4(0, 0, 0, 1);
    for (std::uint32_t k = 0; k < count; ++k) contact.points[k] = vec4(k % 2 == 0 ? 0.5f : -0.5f, 0.5f, k < 2 ? 0.5f : -0.5f, 0);
    contact.features = 0x03020100u;
    return contact;
}

}  // namespace

TEST_CASE("a contact that shrinks to one point keeps its push and its friction, and no twist that nothing would take back") {
    Impulse was = no_impulse(vec3(0));
    was.normal = vec4(4, 3, 2, 1);
    was.friction = vec3(0.5f, 0, 0.25f);
    was.twist = 0.75f;
    for (const std::uint32_t count : {1u, 2u, 4u}) {
        const Impulse now = warm_start_from(patch(count), was, matches_of(patch(count), patch(4), 0.1f), false);
        INFO(count << " points");
        CHECK(now.normal.x == 4);
        CHECK(now.friction == was.friction);
        CHECK(now.twist == (count > 1 ? was.twist : 0));
    }
    CHECK(warm_start_from(patch(1), was, matches_of(patch(1), patch(1), 0.1f), true).twist == was.twist);
}
