// Driving a vehicle by keys, the chase camera, and bit-exact replay of driving.
#include <catch2/catch.hpp>
#include <cmath>

#include "demos/play/interaction.h"
#include "shaders/physics/base/arithmetic.h"

using namespace scree;
using namespace scree::demos;
using host::Key;
using host::key_of;

namespace {

SceneOptions options_of(const std::string& name) {
    SceneOptions options;
    options.name = name;
    return options;
}

struct Driven {
    Session session{options_of("drive"), [] { return make_reference_runner(1); }};
    Interaction hands{session, Extent{640, 360}};

    void press(Key key) { hands.on({.kind = host::EventKind::key_pressed, .key = key}); }
    void release(Key key) { hands.on({.kind = host::EventKind::key_released, .key = key}); }
    void pass(double seconds) {
        for (double passed = 0; passed < seconds - 1e-9; passed += 1.0 / 60) hands.advance(1.0 / 60 + 1e-12);
    }
    VehicleState car() { return session.world().vehicle(0); }
};

}  // namespace

TEST_CASE("keys take the car over from its driver: they accelerate, steer, brake and hold it, and a replay does the same") {
    Driven played;
    played.pass(0.5);
    REQUIRE(played.car().by_route);
    played.press(key_of('W'));
    played.pass(1);
    REQUIRE_FALSE(played.car().by_route);
    REQUIRE(played.car().controls.throttle == 1);
    REQUIRE(played.car().speed > 3);
    played.press(key_of('A'));
    played.pass(0.5);
    REQUIRE(played.car().controls.steer == 1);
    REQUIRE(played.car().curvature > 0.02f);
    REQUIRE(played.session.world().body(1).angular_velocity.y > 0.1f);
    played.release(key_of('A'));
    played.release(key_of('W'));
    played.press(Key::down);
    played.pass(0.1);
    REQUIRE(played.car().controls.brake == 1);
    played.pass(2);
    REQUIRE(played.car().controls.throttle == -1);  // at rest, so the key reverses
    REQUIRE(played.car().speed < -0.5f);
    played.release(Key::down);
    played.press(Key::space);
    played.pass(1.5);
    REQUIRE(played.car().controls.hand_brake == 1);
    REQUIRE(std::abs(played.car().speed) < 0.05f);
    REQUIRE(played.hands.thrown() == 0);
    played.release(Key::space);
    played.press(Key::backspace);
    played.pass(0.1);
    REQUIRE(played.session.world().body(1).position.y > 0.8f);
    played.pass(0.5);

    const Input input = input_from_json(json_of(played.session.input()));
    World again(played.session.subject().scene, played.session.subject().settings(options_of("drive")), make_reference_runner(2));
    const Script script = script_of(input, "played", {});
    for (std::uint64_t i = 0; i < input.steps; ++i) {
        script(again);
        again.step();
    }
    REQUIRE(input.acts.size() >= 6);
    REQUIRE(again.state_hash() == *input.end_hash);
}

TEST_CASE("the camera chases the car from behind, smoothly, until it is told to stay") {
    Driven played;
    played.pass(4);
    const auto behind = [&] {
        const BodyState body = played.session.world().body(1);
        const vec3 ahead = physics::rotate(body.orientation, vec3(0, 0, 1));
        return glm::dot(glm::normalize(body.position - played.hands.eye().position()), ahead);
    };
    REQUIRE(behind() > 0.9f);
    vec3 before = played.hands.eye().position();
    for (int i = 0; i < 60; ++i) {
        played.pass(1.0 / 60);
        REQUIRE(glm::distance(played.hands.eye().position(), before) < 0.6f);
        before = played.hands.eye().position();
    }
    played.press(key_of('C'));
    const vec3 target = played.hands.eye().target();
    played.pass(0.5);
    REQUIRE(played.hands.eye().target() == target);
}

TEST_CASE("where there is no vehicle the keys are what they were") {
    Session session{options_of("stack"), [] { return make_reference_runner(1); }};
    Interaction hands{session, Extent{640, 360}};
    REQUIRE_FALSE(hands.vehicle());
    REQUIRE_FALSE(hands.chases);
    hands.on({.kind = host::EventKind::key_pressed, .key = Key::space});
    REQUIRE(hands.thrown() == 1);
}
