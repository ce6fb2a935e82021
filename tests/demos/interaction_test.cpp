// User interaction without a window: camera, grabbing, pushing, throwing and the clock.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "compute/scene/shape_geometry.h"
#include "demos/play/interaction.h"
#include "tests/temporary_folder.h"

using namespace scree;
using namespace scree::demos;
using host::Button;
using host::Key;
using host::key_of;

namespace {

constexpr Extent extent{640, 360};

// A session of a scene file, on the CPU.
struct Played {
    Session session;
    Interaction hands;

    explicit Played(const std::string& name = "stack")
        : session(
              [&] {
                  SceneOptions options;
                  options.name = name;
                  return options;
              }(),
              [] { return make_reference_runner(1); }),
          hands(session, extent) {}

    void at(host::EventKind kind, glm::vec2 pixel, Button button = Button::left, bool shift = false) {
        hands.on({.kind = kind, .x = pixel.x, .y = pixel.y, .button = button, .shift = shift});
    }
    void strike(Key key, bool shift = false) {
        hands.on({.kind = host::EventKind::key_pressed, .key = key, .shift = shift});
        hands.on({.kind = host::EventKind::key_released, .key = key, .shift = shift});
    }
    void pass(double seconds) {
        for (double passed = 0; passed < seconds - 1e-9; passed += 1.0 / 60) hands.advance(1.0 / 60 + 1e-12);
    }
    glm::vec2 pixel_of(std::size_t body) { return hands.eye().pixel_of(session.world().body(body).position, extent).value(); }
};

// The topmost body of the stack.
constexpr std::size_t top = 10;

}  // namespace

TEST_CASE("a ray through a pixel meets what is seen there") {
    OrbitCamera eye(Viewpoint{vec3(3, 5, 8), vec3(0.5f, 1, -1), 50});
    for (const vec3 point : {vec3(0.5f, 1, -1), vec3(2, 0, 1), vec3(-3, 4, -9)}) {
        const glm::vec2 pixel = eye.pixel_of(point, extent).value();
        const Ray ray = eye.ray(pixel.x, pixel.y, extent);
        REQUIRE(glm::length(glm::cross(point - ray.from, ray.along)) < 1e-4f * glm::length(point - ray.from));
    }
    const glm::vec2 middle = eye.pixel_of(eye.target(), extent).value();
    REQUIRE(middle.x == Approx(319.5f));
    REQUIRE(middle.y == Approx(179.5f));
    REQUIRE(glm::length(eye.position() - vec3(3, 5, 8)) < 1e-5f);
    REQUIRE_FALSE(eye.pixel_of(vec3(6, 9, 17), extent));  // behind the eye
    const Ray upper = eye.ray(319.5, 0, extent);
    REQUIRE(upper.along.y > eye.forward().y);
}

TEST_CASE("the camera stays above a level ground, however it is turned, moved and brought nearer") {
    Played played;
    const auto drag = [&](Button button, double down) {
        played.at(host::EventKind::pressed, {5, 5}, button);
        played.at(host::EventKind::moved, {5, 5 + down}, button);
        played.at(host::EventKind::released, {5, 5 + down}, button);
        REQUIRE(played.hands.eye().position().y > 0);
        REQUIRE(played.hands.eye().target().y >= 0);
    };
    drag(Button::right, -2000);
    drag(Button::middle, -2000);
    for (int i = 0; i < 30; ++i) {
        played.hands.on({.kind = host::EventKind::scrolled, .amount = -1});
        REQUIRE(played.hands.eye().position().y > 0);
    }
    drag(Button::right, 200);
    REQUIRE(played.hands.eye().position().y > 1);  // and turns up again
}

static std::optional<float> distance_to(const Shape& shape, vec3 position, vec4 orientation, const Ray& ray) {
    return ray_distance(shape, position, orientation, ray.from, ray.along);
}

TEST_CASE("a ray meets each kind of shape where its surface is") {
    const Ray down{vec3(0.1f, 5, 0), vec3(0, -1, 0)};
    const vec4 lying(0, 0, std::sqrt(0.5f), std::sqrt(0.5f));  // a quarter turn about z
    CHECK(distance_to(Sphere{1}, vec3(0), vec4(0, 0, 0, 1), down).value() == Approx(5 - std::sqrt(0.99f)));
    CHECK(distance_to(Box{vec3(1, 2, 3)}, vec3(0), vec4(0, 0, 0, 1), down).value() == Approx(3));
    CHECK(distance_to(Box{vec3(1, 2, 3)}, vec3(0), lying, down).value() == Approx(4));
    CHECK(distance_to(Capsule{0.5f, 1}, vec3(0), vec4(0, 0, 0, 1), down).value() == Approx(4 - std::sqrt(0.24f)));
    CHECK(distance_to(Capsule{0.5f, 1}, vec3(0), lying, down).value() == Approx(4.5f));
    CHECK(distance_to(Plane{vec3(0, 1, 0), 1}, vec3(0), vec4(0, 0, 0, 1), down).value() == Approx(4));
    CHECK_FALSE(distance_to(Sphere{1}, vec3(3, 0, 0), vec4(0, 0, 0, 1), down));
    CHECK_FALSE(distance_to(Capsule{0.5f, 1}, vec3(0, 0, 1), lying, down));
    CHECK_FALSE(distance_to(Box{vec3(1)}, vec3(0, 9, 0), vec4(0, 0, 0, 1), down));        // behind
    CHECK_FALSE(distance_to(Sphere{9}, vec3(0), vec4(0, 0, 0, 1), down));                 // begins inside
    CHECK_FALSE(distance_to(Plane{vec3(0, -1, 0), 1}, vec3(0), vec4(0, 0, 0, 1), down));  // from behind
}

TEST_CASE("a ray meets cylinders, cones and hulls where their surface is") {
    const Ray down{vec3(0.1f, 5, 0), vec3(0, -1, 0)};
    const vec4 upright(0, 0, 0, 1), lying(0, 0, std::sqrt(0.5f), std::sqrt(0.5f)), upside_down(0, 0, 1, 0);
    const Cylinder cylinder{0.5f, 1};
    CHECK(distance_to(cylinder, vec3(0), upright, down).value() == Approx(4));
    CHECK(distance_to(cylinder, vec3(0, 0, 0.3f), lying, down).value() == Approx(4.6f));
    CHECK_FALSE(distance_to(cylinder, vec3(0, 0, 0.6f), upright, down));     // beside its wall
    CHECK_FALSE(distance_to(cylinder, vec3(1.2f, 0, 0), lying, down));       // beyond its end
    CHECK_FALSE(distance_to(cylinder, vec3(0.1f, 5.5f, 0), upright, down));  // begins inside
    const Cone cone{0.5f, 1};                                                // from 0.25 below its centre of mass to 0.75 above
    CHECK(distance_to(cone, vec3(0), upright, down).value() == Approx(4.45f));
    CHECK(distance_to(cone, vec3(0), upside_down, down).value() == Approx(4.75f));
    CHECK(distance_to(cone, vec3(0), lying, down).value() == Approx(4.575f));
    CHECK_FALSE(distance_to(cone, vec3(0, 0, 0.55f), upright, down));
    CHECK_FALSE(distance_to(cone, vec3(0, 9, 0), upright, down));  // behind
    Scene scene;
    Hull cube;  // not centred at the body's origin
    for (int k = 0; k < 8; ++k) cube.points.emplace_back(k & 1 ? 9 : 11, k & 2 ? -1 : 1, k & 4 ? -1 : 1);
    scene.bodies.emplace_back().shape = cube;
    const World world(scene, {}, 1);
    const auto above = [&](float x) { return world.cast_ray({vec3(x, 5, 0), vec3(0, -1, 0)}); };
    REQUIRE(above(10.9f));
    CHECK(above(10.9f)->distance == Approx(4));
    CHECK_FALSE(above(11.1f));
    CHECK_FALSE(above(0));
}

TEST_CASE("a drag takes hold of the body under the pointer and draws it along") {
    Played played;
    const vec3 start = played.session.world().body(top).position;
    const glm::vec2 pixel = played.pixel_of(top);
    played.at(host::EventKind::moved, pixel);
    played.at(host::EventKind::pressed, pixel);
    REQUIRE(played.hands.selected() == top);
    for (int i = 1; i <= 30; ++i) {
        played.at(host::EventKind::moved, pixel + glm::vec2(2, -2) * static_cast<float>(i));
        played.pass(1.0 / 60);
    }
    REQUIRE(played.hands.pull());
    REQUIRE(played.hands.pull()->body == top);
    REQUIRE(played.hands.pull()->strength > 0);
    played.pass(2);
    const Pull pull = played.hands.pull().value();
    REQUIRE(glm::length(pull.to - pull.from) < 0.03f);  // sag of the grab spring
    // 60 pixels to the right and up, in the view plane of the grabbed point.
    const OrbitCamera& eye = played.hands.eye();
    const glm::vec2 now = eye.pixel_of(pull.from, extent).value();
    REQUIRE(now.x == Approx(pixel.x + 60).margin(1.5));
    REQUIRE(now.y == Approx(pixel.y - 60).margin(1.5));
    REQUIRE(glm::dot(played.session.world().body(top).position - start, eye.right()) > 1);
    played.at(host::EventKind::released, pixel);
    REQUIRE_FALSE(played.hands.pull());
    const float height = played.session.world().body(top).position.y;
    played.pass(0.3);
    REQUIRE(played.session.world().body(top).position.y < height - 0.2f);
    REQUIRE(played.hands.handled().size() == 1);
    REQUIRE(played.hands.handled()[0].body == top);
    REQUIRE(std::holds_alternative<Grab>(played.session.input().acts.front().act));
    REQUIRE(std::holds_alternative<Release>(played.session.input().acts.back().act));
}

TEST_CASE("the wheel draws a held body nearer, and else brings the eye nearer") {
    Played played;
    const float distance = played.hands.eye().distance();
    played.hands.on({.kind = host::EventKind::scrolled, .amount = 2});
    REQUIRE(played.hands.eye().distance() < distance);
    const glm::vec2 pixel = played.pixel_of(top);
    played.at(host::EventKind::pressed, pixel);
    const vec3 target = played.hands.pull()->to;
    const float held = played.hands.eye().distance();
    played.hands.on({.kind = host::EventKind::scrolled, .x = pixel.x, .y = pixel.y, .amount = -1});
    REQUIRE(played.hands.eye().distance() == held);
    REQUIRE(glm::length(played.hands.pull()->to - played.hands.eye().position()) <
            glm::length(target - played.hands.eye().position()));
}

TEST_CASE("beside bodies a drag looks round, and with the middle button it moves the view") {
    Played played;
    const OrbitCamera before = played.hands.eye();
    played.at(host::EventKind::moved, {5, 5});
    played.at(host::EventKind::pressed, {5, 5});  // the sky
    played.at(host::EventKind::moved, {55, 5});
    played.at(host::EventKind::released, {55, 5});
    REQUIRE(played.hands.eye().target() == before.target());
    REQUIRE(glm::length(played.hands.eye().position() - before.position()) > 0.1f);
    REQUIRE(played.hands.eye().distance() == before.distance());
    REQUIRE_FALSE(played.hands.selected());
    const OrbitCamera turned = played.hands.eye();
    const glm::vec2 pixel = turned.pixel_of(turned.target(), extent).value();
    played.at(host::EventKind::pressed, {55, 5}, Button::middle);
    played.at(host::EventKind::moved, {75, 15});
    played.at(host::EventKind::released, {75, 15}, Button::middle);
    // The point at the centre moved with the pointer.
    const glm::vec2 now = played.hands.eye().pixel_of(turned.target(), extent).value();
    REQUIRE(now.x - pixel.x == Approx(20).margin(0.1));
    REQUIRE(now.y - pixel.y == Approx(10).margin(0.1));
    REQUIRE(played.session.input().acts.empty());
}

TEST_CASE("the space bar throws a ball through the pointer, and b a box") {
    Played played;
    const std::size_t bodies = played.session.world().scene().bodies.size();
    const glm::vec2 pixel = played.pixel_of(5);
    played.at(host::EventKind::moved, pixel);
    played.strike(Key::space);
    REQUIRE(played.session.world().scene().bodies.size() == bodies + 1);
    REQUIRE(std::holds_alternative<Sphere>(played.session.world().scene().bodies.back().shape));
    const BodyState ball = played.session.world().body(bodies);
    const vec3 way = played.session.world().body(5).position - ball.position;
    REQUIRE(glm::dot(glm::normalize(way), glm::normalize(ball.velocity)) > 0.999f);
    played.strike(key_of('B'));
    REQUIRE(std::holds_alternative<Box>(played.session.world().scene().bodies.back().shape));
    REQUIRE(played.hands.thrown() == 2);
    played.pass(2);
    REQUIRE(played.session.world().body(5).position != played.session.world().scene().bodies[5].position);
}

TEST_CASE("the number keys add a body of each kind onto the middle of the view") {
    Played played;
    const std::size_t bodies = played.session.world().scene().bodies.size();
    for (const char number : {'1', '2', '3'}) {
        played.strike(key_of(number));
        played.pass(0.5);
    }
    const Scene& scene = played.session.world().scene();
    REQUIRE(scene.bodies.size() == bodies + 3);
    REQUIRE(std::holds_alternative<Sphere>(scene.bodies[bodies].shape));
    REQUIRE(std::holds_alternative<Capsule>(scene.bodies[bodies + 1].shape));
    REQUIRE(std::holds_alternative<Box>(scene.bodies[bodies + 2].shape));
    REQUIRE(played.session.world().statistics().not_finite == 0);
}

TEST_CASE("arrow keys push the selected body, as the view sees it, for as long as they are held") {
    for (const auto& [key, sign] : {std::pair(Key::left, -1.0f), {Key::right, 1.0f}}) {
        Played played;
        const glm::vec2 pixel = played.pixel_of(top);
        played.at(host::EventKind::pressed, pixel);
        played.at(host::EventKind::released, pixel);
        const vec3 start = played.session.world().body(top).position;
        played.hands.on({.kind = host::EventKind::key_pressed, .key = key});
        played.pass(0.5);
        played.hands.on({.kind = host::EventKind::key_released, .key = key});
        REQUIRE(sign * glm::dot(played.session.world().body(top).position - start, played.hands.eye().right()) > 0.5f);
        const std::size_t acts = played.session.input().acts.size();
        played.pass(0.1);
        REQUIRE(played.session.input().acts.size() == acts);
    }
}

TEST_CASE("an explosion throws apart what is near the pointer") {
    Played played;
    played.at(host::EventKind::moved, played.pixel_of(3));
    played.strike(key_of('X'));
    played.pass(1.0 / 60);
    REQUIRE(played.session.world().statistics().max_speed > 3);
}

TEST_CASE("pause stops the clock, a single step is one, and slow motion is slow") {
    Played played;
    played.pass(0.5);
    const std::uint64_t steps = played.session.world().steps();
    REQUIRE(steps == 30);
    played.strike(key_of('P'));
    played.pass(1);
    REQUIRE(played.session.world().steps() == steps);
    played.strike(key_of('.'));
    played.pass(0.2);
    REQUIRE(played.session.world().steps() == steps + 1);
    played.strike(key_of('P'));
    played.strike(key_of('L'));
    played.strike(key_of('L'));
    played.pass(1);
    REQUIRE(played.session.world().steps() == Approx(steps + 1 + 15).margin(1));
    for (int i = 0; i < 3; ++i) played.strike(key_of('L'));
    REQUIRE(played.hands.pace == 1);
}

TEST_CASE("a machine that falls behind makes up to a second in a part of one, and forgets the rest") {
    Played played;
    const auto start = std::chrono::steady_clock::now();
    played.hands.advance(10);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    REQUIRE(played.session.world().steps() >= 1);
    REQUIRE(played.session.world().steps() <= 60);
    // Steps beyond a quarter of a second are left out, but for the one under way and the next.
    if (played.session.world().steps() > 2) REQUIRE(taken.count() < 2);
    const std::uint64_t steps = played.session.world().steps();
    played.hands.advance(0.001);
    REQUIRE(played.session.world().steps() <= steps + 1);
}

TEST_CASE("the clock is true while steps are cheap, however few pictures are drawn") {
    Played played;
    for (int i = 0; i < 6; ++i) played.hands.advance(0.4);  // two and a half pictures a second
    REQUIRE(played.session.world().steps() >= 60);          // 144, but on a machine under load
    REQUIRE(played.session.world().steps() <= 145);
}

TEST_CASE("to begin again and to open the next demo let go of everything") {
    Played played;
    const glm::vec2 pixel = played.pixel_of(top);
    played.at(host::EventKind::pressed, pixel);
    played.pass(0.1);
    played.strike(key_of('R'));
    REQUIRE(played.session.world().steps() == 0);
    REQUIRE_FALSE(played.hands.pull());
    REQUIRE_FALSE(played.hands.selected());
    played.at(host::EventKind::moved, pixel + glm::vec2(50, 0));
    played.at(host::EventKind::released, pixel);
    REQUIRE(played.session.input().acts.empty());

    const std::string first = played.session.options().name;
    played.strike(Key::tab);
    REQUIRE(played.session.options().name != first);
    played.strike(Key::tab, true);
    REQUIRE(played.session.options().name == first);
}

TEST_CASE("a click selects what cannot be grabbed, and a drag that begins there looks round") {
    Played played;
    const glm::vec2 ground = played.hands.eye().pixel_of(vec3(2, 0, 1), extent).value();
    played.at(host::EventKind::moved, ground);
    played.at(host::EventKind::pressed, ground);
    played.at(host::EventKind::moved, ground + glm::vec2(40, 0));
    played.at(host::EventKind::released, ground + glm::vec2(40, 0));
    REQUIRE_FALSE(played.hands.selected());
    const glm::vec2 now = played.hands.eye().pixel_of(vec3(2, 0, 1), extent).value();
    played.at(host::EventKind::pressed, now);
    played.at(host::EventKind::released, now);
    REQUIRE(played.hands.selected() == 0);
    played.hands.on({.kind = host::EventKind::key_pressed, .key = Key::left});  // no force on it, and no complaint
    played.pass(0.1);
    REQUIRE(played.hands.message().empty());
    played.strike(Key::escape);
    REQUIRE_FALSE(played.hands.selected());
    REQUIRE_FALSE(played.hands.wants_to_close());
}

TEST_CASE("the selected body is duplicated onto what is there, and deleted, and both are recorded") {
    Played played;
    played.hands.select(top);
    const std::size_t bodies = played.session.world().scene().bodies.size();
    const float height = played.session.world().body(top).position.y;
    played.strike(key_of('V'));
    REQUIRE(played.session.world().scene().bodies.size() == bodies + 1);
    REQUIRE(played.session.world().body(bodies).position.y > height + 0.5f);
    REQUIRE(played.hands.selected() == top);
    played.strike(Key::del);
    REQUIRE_FALSE(played.hands.selected());
    REQUIRE_FALSE(has_body(played.session.world(), top));
    played.strike(Key::del);  // nothing is selected
    REQUIRE(played.session.input().acts.size() == 2);
    const glm::vec2 pixel = played.pixel_of(5);
    played.at(host::EventKind::pressed, pixel);
    REQUIRE(played.hands.held() == 5);
    played.session.perform(Remove{5});  // as a script may
    played.pass(0.1);
    REQUIRE_FALSE(played.hands.held());
    REQUIRE_FALSE(played.hands.selected());
    played.at(host::EventKind::moved, pixel + glm::vec2(20, 0));
    played.at(host::EventKind::released, pixel);
    played.hands.go_to(0);
    REQUIRE(played.hands.message().empty());
    played.hands.select(0);
    played.strike(key_of('V'));
    REQUIRE_THAT(played.hands.message(), Catch::Contains("plane"));
}

TEST_CASE("duplicates of every shape are replayed from the recording's text with the same bits") {
    Played played("assortment");
    played.pass(0.2);
    const std::size_t bodies = played.session.world().scene().bodies.size();
    std::size_t made = 0;
    for (std::size_t body = 0; body < bodies && made < 40; ++body) {
        if (played.session.world().scene().bodies[body].motion != scree::Motion::dynamic) continue;
        played.hands.select(body);
        played.strike(key_of('V'));
        REQUIRE(played.hands.message().empty());
        ++made;
    }
    REQUIRE(made > 5);
    played.pass(0.5);
    const Input input = input_from_json(json_of(played.session.input()));
    World world(played.session.subject().scene, played.session.subject().settings(played.session.options()),
                make_reference_runner(1));
    for (perform_due(input, world); world.steps() < input.steps; perform_due(input, world)) world.step();
    REQUIRE(world.state_hash() == played.session.world().state_hash());
}

TEST_CASE("two clicks join two bodies by each kind of joint, and the recording says so") {
    for (std::size_t kind = 0; kind < join_words().size(); ++kind) {
        CAPTURE(join_words()[kind]);
        Played played;
        const auto click = [&](std::size_t body) {
            const glm::vec2 pixel = played.pixel_of(body);
            played.at(host::EventKind::pressed, pixel);
            played.at(host::EventKind::released, pixel);
        };
        played.hands.join_kind = static_cast<JoinKind>(kind);
        played.strike(key_of('J'));
        REQUIRE(played.hands.joining());
        click(top);
        REQUIRE(played.hands.first_point()->body == top);
        click(top);
        REQUIRE_THAT(played.hands.message(), Catch::Contains("same body"));
        click(top - 3);
        REQUIRE(played.hands.message().empty());
        REQUIRE_FALSE(played.hands.joining());
        REQUIRE(played.hands.joined() == 1);
        const Scene& scene = played.session.world().scene();
        REQUIRE(scene.joints.size() == 1);
        REQUIRE(scene.joints[0].a == top);
        REQUIRE(scene.joints[0].b == top - 3);
        const auto act = std::get<Join>(played.session.input().acts.at(0).act);
        REQUIRE(act.joint.kind.index() == scene.joints[0].kind.index());
        played.pass(0.2);
        REQUIRE(played.session.world().joint(0).gap < (kind < 4 ? 0.01f : 5.0f));
        played.hands.perform(Unjoin{0});
        REQUIRE(played.session.world().scene().joints.empty());
    }
    Played played;
    played.strike(key_of('J'));
    played.strike(Key::escape);
    REQUIRE_FALSE(played.hands.joining());
}

TEST_CASE("a scene file that is dropped is opened, and a wrong one told") {
    Played played;
    played.hands.on({.kind = host::EventKind::dropped, .file = "nowhere/scene.json"});
    REQUIRE_THAT(played.hands.message(), Catch::Contains("nowhere/scene.json"));
    REQUIRE(played.session.options().name == "stack");
    const tests::TemporaryFolder folder;
    const std::string file = folder.write("ball.json", R"({"bodies": [{"shape": {"sphere": {"radius": 0.5}}}]})");
    played.hands.on({.kind = host::EventKind::dropped, .file = file});
    REQUIRE(played.hands.message().empty());
    REQUIRE(played.session.world().scene().bodies.size() == 1);
}

TEST_CASE("the view follows the selected body") {
    Played played;
    played.at(host::EventKind::pressed, played.pixel_of(top));
    played.at(host::EventKind::released, played.pixel_of(top));
    played.strike(key_of('F'));
    played.at(host::EventKind::moved, {0, 0});
    played.strike(key_of('X'));
    played.pass(0.5);
    REQUIRE(glm::length(played.hands.eye().target() - played.session.world().body(top).position) < 1e-5f);
}

TEST_CASE("a window of another size sees another ray under the same pixel") {
    Played played;
    played.hands.on({.kind = host::EventKind::resized, .x = 1280, .y = 720});
    REQUIRE(played.hands.extent().width == 1280);
    const glm::vec2 pixel = played.hands.eye().pixel_of(played.session.world().body(top).position, {1280, 720}).value();
    played.at(host::EventKind::pressed, pixel);
    REQUIRE(played.hands.selected() == top);
}

TEST_CASE("what the world refuses becomes a message") {
    Played played;
    played.hands.perform(Push{99, vec3(0)});
    REQUIRE_THAT(played.hands.message(), Catch::Contains("body 99"));
    played.hands.open("nosuch");
    REQUIRE_THAT(played.hands.message(), Catch::Contains("unknown demo"));
    REQUIRE(played.session.options().name == "stack");
}

TEST_CASE("a body is grabbed by its number, where the pointer is or by its centre") {
    Played played;
    played.pass(0.1);
    played.at(host::EventKind::moved, played.pixel_of(top));
    played.hands.grab_body(top);
    REQUIRE(played.hands.held() == top);
    played.hands.let_all_go();
    CHECK_FALSE(played.hands.held());
    played.at(host::EventKind::moved, {1, 1});  // the sky: the body has left the pointer meanwhile
    played.hands.grab_body(top);
    CHECK(played.hands.held() == top);
    CHECK(played.hands.selected() == top);
    played.hands.let_all_go();
    played.hands.grab_body(0);  // the ground
    CHECK_FALSE(played.hands.held());
    played.hands.grab_body(100000);
    CHECK_FALSE(played.hands.held());
}

TEST_CASE("the pointer points at a picture from elsewhere") {
    Played played;
    const Viewpoint view{vec3(5, 9, 4), played.session.world().body(top).position, 35};
    played.hands.look_from(view, {800, 800});
    played.at(host::EventKind::moved, {400, 400});
    const std::optional<RayHit> hit = played.hands.hovered();
    REQUIRE(hit);
    CHECK(hit->body == top);
}
