// Bodies that touch another in several contacts: columns of them come to rest.
#include "tests/world/feet.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/glm.hpp>

#include "compute/world.h"

using namespace scree;

namespace {

struct Motion3 {
    float speed = 0, spin = 0;  // m/s, rad/s: the greatest of any body in any step
};
// After `settling` seconds, in the second that follows.
Motion3 motion_of(const Scene& scene, int settling, float rate = 60) {
    Settings settings;
    settings.sleeping = false;
    settings.rate = rate;
    World world(scene, settings, 1);
    world.step(static_cast<int>(rate) * settling);
    Motion3 most;
    for (int step = 0; step < static_cast<int>(rate); ++step) {
        world.step();
        for (const BodyState& body : world.bodies()) {
            most.speed = std::max(most.speed, glm::length(body.velocity));
            most.spin = std::max(most.spin, glm::length(body.angular_velocity));
        }
    }
    return most;
}

}  // namespace

TEST_CASE("columns of two, three and five bodies on three to eight legs come to rest within three seconds") {
    for (const int legs : {3, 4, 6, 8})
        for (const int count : {2, 3, 5}) {
            CAPTURE(legs, count);
            const Motion3 most = motion_of(tests::column_of(tests::on_legs(legs), 1, count), 3);
            CHECK(most.speed < 0.0005f);
            CHECK(most.spin < 0.001f);
        }
}

TEST_CASE("columns of bodies on legs come to rest at other rates") {
    for (const float rate : {30.0f, 240.0f}) {
        CAPTURE(rate);
        const Motion3 most = motion_of(tests::column_of(tests::on_legs(4), 1, 3), 3, rate);
        CHECK(most.speed < 0.001f);
        CHECK(most.spin < 0.002f);
    }
}

// The contacts of the slab with the posts are more than one block holds.
TEST_CASE("a table on a slab on a hundred posts comes to rest") {
    const Motion3 most = motion_of(tests::what_has_feet(10), 3);
    CHECK(most.speed < 0.0005f);
    CHECK(most.spin < 0.001f);
}
