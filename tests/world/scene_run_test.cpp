// How a scene file is run and shown: settings, duration, picture style, camera motion, and events over time.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

// A ground, a ball, a kinematic lift, a ball on a rope, and a wheel on a hinge.
std::string scene_with(const std::string& more) {
    return R"({"gravity": [0, 0, 0], "bodies": [
        {"name": "ground", "motion": "fixed", "shape": {"plane": {}}},
        {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "position": [0, 5, 0], "density": 1000},
        {"name": "lift", "motion": "kinematic", "shape": {"box": {"half_extents": [1, 0.1, 1]}}, "position": [5, 5, 0]},
        {"name": "bob", "shape": {"sphere": {"radius": 0.2}}, "position": [10, 5, 0]},
        {"name": "wheel", "shape": {"cylinder": {"radius": 0.5, "half_height": 0.1}}, "position": [15, 5, 0]}],
      "joints": [{"name": "rope", "kind": {"distance": {"greatest": 1}}, "b": "bob", "anchor_a": [10, 6, 0]},
                 {"name": "axle", "kind": {"hinge": {}}, "b": "wheel", "anchor": [15, 5, 0], "axis": [0, 1, 0]}])" +
           (more.empty() ? "}" : ", " + more + "}");
}

std::string refusal(const std::string& more) {
    return tests::refusal_of([&] { scene_from_json(scene_with(more)); });
}

// Runs a scene's events for some steps.
World played(const SceneDocument& document, int steps) {
    World world(document.scene, document.settings.value_or(Settings{}));
    for (int i = 0; i < steps; ++i) {
        perform_due(document.events, world);
        world.step();
    }
    perform_due(document.events, world);
    return world;
}

const std::string all_of_it = R"(
  "settings": {"substeps": 16, "rate": 120, "sleeping": false, "max_speed": 900},
  "duration": 2.5,
  "camera": {"eye": [3, 4, 5], "target": [0, 5, 0], "follow": "ball", "chase": true, "orbit": -30, "fit": true},
  "picture": {"color": "speed", "color_map": "viridis", "color_scale": "log", "color_range": [0.5, 20],
              "show": ["contacts", "joints"]},
  "events": [{"time": 0.5, "action": {"impulse": {"body": "ball", "impulse": [100, 0, 0], "offset": [0, 0.1, 0]}}},
             {"time": 0.5, "action": {"velocity": {"body": 2, "linear": [0, 1, 0], "angular": [0, 2, 0]}}},
             {"time": 1, "action": {"glide": {"body": "lift", "to": [6, 6, 1], "turn": [0, 1, 0], "duration": 0.5}}},
             {"time": 1, "action": {"explosion": {"centre": [0, 4, 0], "radius": 3, "speed": 5}}},
             {"time": 1.5, "action": {"release": {"joint": "rope"}}},
             {"time": 1.5, "action": {"motor": {"joint": "axle", "speed": 3, "max_force": 50}}},
             {"time": 2, "action": {"gravity": {"gravity": [0, -1.6, 0]}}}])";

}  // namespace

TEST_CASE("scene file: settings, duration, camera motion, picture and events are read, and written as they were read",
          "[scene]") {
    const SceneDocument document = scene_from_json(scene_with(all_of_it));
    REQUIRE(document.settings);
    CHECK(document.settings->substeps == 16);
    CHECK(document.settings->rate == 120);
    CHECK_FALSE(document.settings->sleeping);
    CHECK(document.settings->contact_hertz == Settings{}.contact_hertz);
    CHECK(document.duration == 2.5f);
    REQUIRE(document.viewpoint);
    CHECK(document.viewpoint->follow == 1);
    CHECK(document.viewpoint->chase);
    CHECK(document.viewpoint->orbit == -30);
    REQUIRE(document.picture);
    CHECK(document.picture->color == ShownQuantity::speed);
    CHECK(document.picture->show == std::vector<Overlay>{Overlay::contacts, Overlay::joints});
    REQUIRE(document.events.size() == 7);
    const std::string text = scene_to_json(document);
    CHECK(scene_to_json(scene_from_json(text)) == text);
    const auto schema = nlohmann::json::parse(scene_schema());
    const auto written = nlohmann::json::parse(text);
    for (const auto& [key, value] : written.items()) CHECK(schema["properties"].contains(key));
    CHECK(schema["$defs"]["picture"]["properties"]["show"]["items"]["enum"].size() == 7);
    CHECK(schema["$defs"]["settings"]["properties"]["substeps"]["default"] == 12);
    CHECK(schema["$defs"]["event_action"]["properties"].size() == 9);
    // What is left out stays left out.
    CHECK(scene_to_json(scene_from_json(scene_with(""))).find("settings") == std::string::npos);
}

TEST_CASE("scene file: a colour is numbers or hexadecimal digits, and is written as numbers", "[scene]") {
    const auto with = [](const std::string& color) {
        return R"({"bodies": [{"shape": {"sphere": {"radius": 0.5}}, "color": )" + color + "}]}";
    };
    const auto color = [&](const std::string& text) { return scene_from_json(with(text)).scene.bodies.at(0).color.value(); };
    CHECK(color("\"#ff8000\"") == glm::vec3(1, 128 / 255.0f, 0));
    CHECK(color("\"#fA0\"") == color("\"#ffAA00\""));
    CHECK(color("[1, 0.5, 0]") == glm::vec3(1, 0.5f, 0));
    const SceneDocument document = scene_from_json(with("\"#30f\""));
    CHECK(nlohmann::json::parse(scene_to_json(document)).at("bodies").at(0).at("color") == nlohmann::json({0.2, 0, 1}));
    CHECK(scene_from_json(scene_to_json(document)).scene.bodies.at(0).color == document.scene.bodies.at(0).color);
    for (const std::string wrong : {"\"red\"", "\"#ff80\"", "\"#gg0000\"", "\"ff8000\"", "\"#-1-1-1\"", "\"#ff80000\"", "\"\"",
                                    "[1, 0]", "0.5", "null", "{}"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(color(wrong), Catch::StartsWith("/bodies/0/color: must be an array of 3 numbers from 0 to 1") &&
                                            Catch::Contains("\"#ff8000\" or \"#f80\"; is "));
    }
    const auto schema = nlohmann::json::parse(scene_schema()).at("$defs").at("body").at("properties").at("color");
    CHECK(schema.at("anyOf").at(0).at("minItems") == 3);
    CHECK(schema.at("anyOf").at(1).at("type") == "string");
}

TEST_CASE("scene file: settings, pictures and events that cannot be are refused with their place", "[scene]") {
    CHECK(refusal(R"("settings": {"substeps": 0})") == "/settings/substeps: must be between 1 and 64, is 0");
    CHECK(refusal(R"("settings": {"substep": 9})")
              .starts_with("/settings/substep: unknown key \"substep\"; nearest: \"substeps\""));
    CHECK(refusal(R"("settings": {"substeps": 1.5})").starts_with("/settings/substeps: must be a whole number"));
    CHECK(refusal(R"("duration": -1)").starts_with("/duration: must be between 0 and 1000000 s"));
    CHECK(refusal(R"("picture": {"color": "momentun"})").find("nearest: \"momentum\"") != std::string::npos);
    CHECK(refusal(R"("picture": {"show": ["contact"]})").starts_with("/picture/show/0: unknown word \"contact\""));
    CHECK(refusal(R"("picture": {"color_range": [2, 1]})") == "/picture/color_range: must be [low, high], low first");
    CHECK(refusal(R"("picture": {"color_scale": "log", "color_range": [0, 1]})").starts_with("/picture/color_range: must begin"));
    CHECK(refusal(R"("camera": {"eye": [0, 0, 1], "target": [0, 0, 0], "chase": true})").starts_with("/camera/chase: needs"));
    CHECK(
        refusal(R"("camera": {"eye": [0, 0, 1], "target": [0, 0, 0], "follow": 9})").starts_with("/camera/follow: there is no"));
    const auto event = [](const std::string& action) {
        return refusal(R"("events": [{"time": 1, "action": {)" + action + "}}]");
    };
    CHECK(event(R"("impulse": {"body": "lift", "impulse": [1, 0, 0]})") ==
          "/events/0/action/impulse/body: must be a dynamic body");
    CHECK(event(R"("glide": {"body": "ball", "to": [1, 0, 0]})") == "/events/0/action/glide/body: must be a kinematic body");
    CHECK(event(R"("velocity": {"body": "ground"})") == "/events/0/action/velocity/body: must be a dynamic or kinematic body");
    CHECK(event(R"("impulse": {"body": "bal", "impulse": [1, 0, 0]})").find("there is no body named") != std::string::npos);
    CHECK(event(R"("impulse": {"body": 1})").find("lacks \"impulse\"") != std::string::npos);
    CHECK(event(R"("explosion": {"centre": [0, 0, 0], "radius": 0, "speed": 1})").find("must be above 0") != std::string::npos);
    CHECK(event(R"("release": {"joint": 7})") == "/events/0/action/release/joint: there is no joint 7; the scene has 2");
    CHECK(event(R"("motor": {"joint": "rope", "speed": 1, "max_force": 1})").ends_with("must be a hinge or a slider"));
    CHECK(event(R"("shove": {})").find("unknown action \"shove\"") != std::string::npos);
    CHECK(
        refusal(
            R"("events": [{"time": 1, "action": {"release": {"joint": 0}}}, {"time": 2, "action": {"release": {"joint": 0}}}])") ==
        "/events/1/action/release/joint: is released by /events/0, too");
}

TEST_CASE("events: each acts before the step whose start is nearest, and does what it says", "[world]") {
    const SceneDocument document = scene_from_json(scene_with(
        R"("settings": {"sleeping": false}, "events": [
           {"time": 0.1, "action": {"impulse": {"body": "ball", "impulse": [100, 0, 0]}}},
           {"time": 0.1, "action": {"glide": {"body": "lift", "to": [6, 7, 1], "turn": [0, 1.5, 0], "duration": 0.5}}},
           {"time": 0.2, "action": {"release": {"joint": "rope"}}},
           {"time": 0.3, "action": {"motor": {"joint": "axle", "speed": 3, "max_force": 500}}},
           {"time": 0.5, "action": {"gravity": {"gravity": [0, -2, 0]}}}])"));
    CHECK(played(document, 6).body(1).velocity == vec3(0));
    const float mass = mass_properties(Sphere{0.5f}, 1000).mass;
    CHECK(played(document, 7).body(1).velocity.x == Approx(100 / mass).epsilon(1e-4));
    const World later = played(document, 60);
    const BodyState lift = later.body(2);
    CHECK(glm::distance(lift.position, vec3(6, 7, 1)) < 1e-3f);
    CHECK(2 * std::acos(lift.orientation.w) == Approx(1.5).epsilon(1e-2));
    CHECK(lift.velocity == vec3(0));
    CHECK(later.scene().joints.size() == 1);
    CHECK(later.body(4).angular_velocity.y == Approx(3).epsilon(0.02));
    CHECK(later.body(3).velocity.y == Approx(-1).epsilon(0.04));  // half a second of free fall: the rope is gone
}

TEST_CASE("events: what is still to come goes into a saved scene", "[world]") {
    const SceneDocument document = scene_from_json(scene_with(
        R"("events": [{"time": 0.1, "action": {"release": {"joint": "rope"}}},
           {"time": 0.2, "action": {"glide": {"body": "lift", "to": [6, 5, 0], "duration": 1}}},
           {"time": 1, "action": {"motor": {"joint": "axle", "speed": 3, "max_force": 500}}}])"));
    const World world = played(document, 42);  // 0.7 s
    const std::vector<TimedEvent> coming = coming_events(document.events, world);
    REQUIRE(coming.size() == 2);
    CHECK(coming[0].time == 0);
    CHECK(std::get<GlideEvent>(coming[0].action).duration == Approx(0.5));
    CHECK(coming[1].time == Approx(0.3));
    CHECK(std::get<MotorEvent>(coming[1].action).joint == 0);  // the rope is gone
    SceneDocument saved{world.snapshot(), {}, {}, 0, {}, coming};
    const World goes_on = played(scene_from_json(scene_to_json(saved)), 60);
    CHECK(glm::distance(goes_on.body(2).position, vec3(6, 5, 0)) < 1e-3f);
    CHECK(goes_on.body(4).angular_velocity.y == Approx(3).epsilon(0.02));
}
