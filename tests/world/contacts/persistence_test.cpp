// Persistent manifolds: resting bodies keep them; sliding, tipping and impacts discard them.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "compute/cpu/reference_runner.h"
#include "compute/tables/state.h"
#include "tests/world/heaps.h"

using namespace scree;
using tests::ground;

namespace {

const Settings awake{.sleeping = false};  // sleeping bodies keep every manifold

// A scene stepped on the CPU with access to its tables, sleep off.
class Walk {
public:
    explicit Walk(const Scene& scene) : state(checked(scene), awake, 64, true), runner_(1) { runner_.attach(state); }
    void step(int count = 1) {
        for (int i = 0; i < count; ++i) {
            REQUIRE(runner_.step());
            std::map<Ends, Manifold> now;
            for (std::size_t k = 0; k < state.counted().contacts; ++k) {
                const physics::Contact& contact = state.contacts[k];
                const auto before = manifolds_.find({contact.a, contact.b});
                const bool lasts = before != manifolds_.end() && before->second.made.center_offset == contact.center_offset &&
                                   before->second.made.orientation_b == contact.orientation_b;
                now[{contact.a, contact.b}] = {contact, lasts ? before->second.age + 1 : 0};
            }
            manifolds_ = std::move(now);
        }
    }
    const physics::Contact* between(std::uint32_t a, std::uint32_t b) const {
        for (std::size_t i = 0; i < state.counted().contacts; ++i) {
            if (state.contacts[i].a == a && state.contacts[i].b == b) return &state.contacts[i];
        }
        return nullptr;
    }
    // Steps since the manifold was made, as bits that stay tell; none without a contact.
    std::optional<unsigned> age(std::uint32_t a, std::uint32_t b) const {
        const auto found = manifolds_.find({a, b});
        return found == manifolds_.end() ? std::nullopt : std::optional<unsigned>(found->second.age);
    }

    State state;

private:
    using Ends = std::pair<std::uint32_t, std::uint32_t>;
    struct Manifold {
        physics::Contact made;
        unsigned age = 0;
    };

    ReferenceRunner runner_;
    std::map<Ends, Manifold> manifolds_;
};

Body resting(Shape shape, float height, vec3 where = vec3(0)) {
    Body body;
    body.shape = shape;
    body.position = where + vec3(0, height, 0);
    return body;
}

}  // namespace

TEST_CASE("a box at rest keeps its contact, on the ground and on another box") {
    Scene scene;
    scene.bodies = {ground(), resting(Box{}, 0.5f), resting(Box{}, 1.5f)};
    Walk walk(scene);
    walk.step(30);
    const physics::Contact above = *walk.between(1, 2);
    const unsigned age_below = *walk.age(0, 1), age_above = *walk.age(1, 2);
    walk.step(60);
    REQUIRE(walk.age(0, 1) == age_below + 60);
    REQUIRE(walk.age(1, 2) == age_above + 60);
    REQUIRE(age_above >= 20);
    const physics::Contact after = *walk.between(1, 2);
    REQUIRE(after.count == 4);
    REQUIRE(after.normal == above.normal);
    for (int k = 0; k < 4; ++k) REQUIRE(after.points[k] == above.points[k]);
}

TEST_CASE("a box that slides, slowly or fast, lets go of its contact") {
    for (const float speed : {0.2f, 3.0f}) {
        Scene scene;
        scene.bodies = {ground(), resting(Box{}, 0.5f)};
        scene.bodies[0].friction = 0.0f;
        scene.bodies[1].velocity = {speed, 0, 0};
        Walk walk(scene);
        for (int i = 0; i < 30; ++i) {
            walk.step();
            CAPTURE(speed, i);
            REQUIRE(walk.age(0, 1) == 0u);
        }
    }
}

TEST_CASE("a box that creeps lets go once the marks lie too far apart") {
    Scene scene;
    scene.bodies = {ground(), resting(Box{}, 0.5f)};
    scene.bodies[0].friction = 0.0f;
    scene.bodies[1].velocity = {0.02f, 0, 0};  // 1% of the half width in half a second, below the speed that counts as sliding
    Walk walk(scene);
    unsigned oldest = 0;
    int let_go = 0;
    for (int i = 0; i < 90; ++i) {
        walk.step();
        REQUIRE(walk.age(0, 1).has_value());
        let_go += i > 0 && *walk.age(0, 1) == 0;
        oldest = std::max(oldest, *walk.age(0, 1));
    }
    REQUIRE(let_go >= 3);
    REQUIRE(let_go <= 8);
    REQUIRE(oldest >= 10);
    REQUIRE(oldest <= 17);  // 5 mm at 0.02 m/s are 15 steps
}

TEST_CASE("a box that tips lets go of its contact, and makes a lasting one once it lies") {
    Scene scene;
    scene.bodies = {ground(), resting(Box{vec3(0.2f, 1.0f, 0.2f)}, 1.0f)};
    scene.bodies[1].friction = 2.0f;
    Walk walk(scene);
    walk.step(30);
    REQUIRE(walk.age(0, 1) > 20u);
    walk.state.velocities[1].angular = {0, 0, -1.2f};  // about its right lower edge
    walk.state.velocities[1].linear = {1.2f, 0.24f, 0};
    walk.step();
    int upright = 0, made_anew = 0;
    for (int i = 0; i < 30; ++i) {
        walk.step();
        if (walk.state.poses[1].position.y < 0.3f) break;
        ++upright;
        const unsigned age = walk.age(0, 1).value_or(0);
        REQUIRE(age <= 6);  // its edge is at rest, but the manifold is recomputed after 5 degrees, at 1 rad/s
        made_anew += age == 0;
    }
    REQUIRE(upright > 10);
    REQUIRE(made_anew >= 3);
    walk.step(240);
    REQUIRE(walk.state.poses[1].position.y < 0.21f);  // it has fallen over
    REQUIRE(walk.age(0, 1) > 60u);
}

TEST_CASE("a box that is struck lets go of its contact, and only it does") {
    Scene scene;
    scene.bodies = {ground(), resting(Box{}, 0.5f), resting(Box{}, 0.5f, {5, 0, 0})};
    Body hammer = resting(Sphere{0.3f}, 0.6f, {-1.9f, 0, 0});
    hammer.velocity = {4, 0, 0};
    hammer.gravity_scale = 0;
    scene.bodies.push_back(hammer);
    Walk walk(scene);
    // Its surface is 1.1 m away, 16.5 steps.
    walk.step(12);
    REQUIRE(walk.age(0, 1) >= 8u);
    walk.step(8);
    REQUIRE(walk.state.velocities[1].linear.x > 0.05f);
    REQUIRE(walk.age(0, 1).value_or(0) == 0u);
    REQUIRE(walk.age(0, 2) >= 16u);
}

TEST_CASE("the contact of a ball that creeps is never kept, that of a lying capsule is") {
    Scene scene;
    scene.bodies = {ground(), resting(Sphere{0.5f}, 0.5f), resting(Capsule{0.3f, 0.5f}, 0.3f, {3, 0, 0}),
                    resting(Box{}, 0.5f, {6, 0, 0}), resting(Sphere{0.2f}, 1.2f, {6, 0, 0})};
    const float half = std::sqrt(0.5f);
    scene.bodies[2].orientation = {half, 0, 0, half};
    for (const std::size_t ball : {1, 4}) scene.bodies[ball].velocity.x = 0.001f;  // at rest it is made anew with the same bits
    Walk walk(scene);
    for (int i = 0; i < 60; ++i) {
        walk.step();
        REQUIRE(walk.age(0, 1) == 0u);
        REQUIRE(walk.age(3, 4) == 0u);
    }
    REQUIRE(walk.age(0, 2) > 40u);
    REQUIRE(walk.age(0, 3) > 40u);
}
