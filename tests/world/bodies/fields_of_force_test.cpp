// Wind, water and attractors, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/belts.h"

using namespace scree;

namespace {

constexpr float g = 9.81f;

Scene in_water(Body body, float density = 1000) {
    Scene scene;
    scene.bodies.push_back(std::move(body));
    scene.fields.water = Water{.density = density, .damping = 3};
    return scene;
}
Body box(vec3 half, float density, vec3 position) {
    Body made;
    made.shape = Box{half};
    made.density = density;
    made.position = position;
    return made;
}

}  // namespace

TEST_CASE("boxes and balls float as deep as they displace their mass, and right themselves") {
    for (const float density : {100.0f, 250.0f, 500.0f, 900.0f}) {
        World world(in_water(box({0.5f, 0.2f, 0.5f}, density, {0, 0.1f, 0})));
        world.step(1200);
        INFO("density " << density);
        // The bottom is 0.4 m density / 1000 below the surface.
        CHECK(world.body(0).position.y == Approx(0.2f - 0.4f * density / 1000).margin(1e-3));
        CHECK(glm::length(world.body(0).velocity) < 2e-3f);
    }
    Body ball;
    ball.shape = Sphere{0.3f};
    ball.density = 500;
    World half(in_water(ball));
    half.step(900);
    CHECK(half.body(0).position.y == Approx(0).margin(1e-3));
    ball.density = 156.25f;  // s = -0.5: (1/2)^2 (5/2) / 4 of the volume
    World less(in_water(ball));
    less.step(900);
    CHECK(less.body(0).position.y == Approx(0.15f).margin(1e-3));
    // A flat box that is tilted lies flat again; one that stands on its edge of 0.4 m falls over.
    Body tilted = box({0.5f, 0.2f, 0.5f}, 500, vec3(0));
    tilted.orientation = {std::sin(0.3f), 0, 0, std::cos(0.3f)};
    World flat(in_water(tilted));
    flat.step(1800);
    CHECK(std::abs(flat.body(0).orientation.x) < 0.01f);
    // What is heavier than water sinks.
    World stone(in_water(box(vec3(0.2f), 2500, vec3(0))));
    stone.step(300);
    CHECK(stone.body(0).position.y < -2);
}

TEST_CASE("a small tilt of a floating box swings back at the rate of its metacentric height") {
    // Half extents a, h, a at half the water's density: draft h, restoring moment rho g (I_waterline - V_sub BG) theta with
    // I = 4 a^4 / 3, V_sub = 4 a^2 h, BG = h / 2.
    const float a = 0.5f, h = 0.2f, density = 500;
    Body body = box({a, h, a}, density, vec3(0));
    body.orientation = {std::sin(0.01f), 0, 0, std::cos(0.01f)};
    body.drag = 0;
    Scene scene = in_water(body);
    scene.fields.water->damping = 0;
    World world(scene, {.rate = 240});
    const MassProperties mass = mass_properties(body.shape, density);
    const float moment = 1000 * g * (4 * a * a * a * a / 3 - 4 * a * a * h * h / 2);
    const float omega = std::sqrt(moment / mass.inertia.x);
    // The first passage through level is after a quarter of a period.
    int steps = 0;
    while (world.body(0).orientation.x > 0 && steps < 1000) world.step(), ++steps;
    CHECK(static_cast<float>(steps) / 240 == Approx(0.5f * 3.14159f / omega).epsilon(0.05));
}

TEST_CASE("wind drags by the area a body shows, up to terminal velocity") {
    const auto falling = [](vec3 half, vec4 orientation) {
        Scene scene;
        scene.fields.wind = Wind{};
        Body body = box(half, 200, {0, 0, 0});
        body.orientation = orientation;
        scene.bodies.push_back(body);
        World world(scene);
        world.step(1800);
        return -world.body(0).velocity.y;
    };
    const float side = std::sqrt(0.5f);
    const float mass = 200 * 8 * 0.5f * 0.02f * 0.5f;
    CHECK(falling({0.5f, 0.02f, 0.5f}, {0, 0, 0, 1}) == Approx(std::sqrt(2 * mass * g / (1.2f * 1.0f))).epsilon(0.01));
    CHECK(falling({0.5f, 0.02f, 0.5f}, {side, 0, 0, side}) == Approx(std::sqrt(2 * mass * g / (1.2f * 0.04f))).epsilon(0.03));
    Scene calm;
    calm.gravity = vec3(0);
    calm.fields.wind = Wind{.velocity = {20, 0, 0}};
    calm.bodies.push_back({.shape = Sphere{0.1f}, .density = 1});  // a very light one is never faster than the wind
    calm.bodies.push_back({.shape = Sphere{0.1f}, .position = {0, 5, 0}, .density = 1, .drag = 0});
    World world(calm);
    float fastest = 0;
    for (int i = 0; i < 300; ++i) {
        world.step();
        fastest = std::max(fastest, world.body(0).velocity.x);
    }
    CHECK(fastest < 20);
    CHECK(fastest > 17);
    CHECK(world.body(1).velocity == vec3(0));
    world.set_fields({});
    const vec3 before = world.body(0).velocity;
    world.step(60);
    CHECK(world.body(0).velocity == before);
}

TEST_CASE("bodies go round an attractor as round a sun") {
    Scene scene;
    scene.gravity = vec3(0);
    scene.fields.attractors.push_back({.position = {1, 2, 3}, .strength = 400});
    scene.fields.attractor_radius = 1e-3f;
    scene.bodies.push_back({.shape = Sphere{0.1f}, .position = {5, 2, 3}, .velocity = {0, 10, 0}});  // v^2 = 400 / 4
    World world(scene, {.rate = 240});
    for (int i = 0; i < 4; ++i) {
        world.step(150);
        CHECK(glm::length(world.body(0).position - vec3(1, 2, 3)) == Approx(4).epsilon(0.01));
    }
}

TEST_CASE("fields are kept in scene files, checkpoints and snapshots, and bad ones are refused by their place") {
    const std::string text = R"({"fields": {"wind": {"velocity": [3, 0, 0]}, "water": {"normal": [0, 2, 0], "offset": 1},
        "attractors": [{"position": [0, 9, 0], "strength": 10}]},
        "bodies": [{"shape": {"box": {"half_extents": [0.2, 0.2, 0.2]}}, "density": 300, "drag": 2}]})";
    const Scene scene = scene_from_json(text).scene;
    CHECK(scene.fields.water->offset == 1);
    CHECK(checked(scene).fields.water->normal == vec3(0, 1, 0));
    CHECK(scene_to_json(scene_from_json(scene_to_json(scene)).scene) == scene_to_json(scene));
    World world(scene), other(scene), plain(Scene{scene.gravity, scene.bodies, {}});
    plain.set_fields(scene.fields);
    world.step(100);
    plain.step(100);
    CHECK(plain.state_hash() == world.state_hash());
    const auto saved = world.save();
    world.step(50);
    other.restore(saved);
    other.step(50);
    CHECK(other.state_hash() == world.state_hash());
    CHECK(world.snapshot().fields.attractors.size() == 1);
    for (World* one : {&world, &other}) one->add_bodies(std::vector{box(vec3(0.1f), 100, {2, 3, 0})});
    world.step(300), other.step(300);
    CHECK(other.state_hash() == world.state_hash());
    CHECK(world.body(1).position.y > 0.9f);
    const auto refused = [&](const Fields& fields) { return tests::refusal_of([&] { world.set_fields(fields); }); };
    using Catch::Contains;
    CHECK_THAT(refused({.water = Water{.normal = vec3(0)}}), Contains("/fields/water/normal"));
    CHECK_THAT(refused({.water = Water{.density = -1}}), Contains("/fields/water/density"));
    CHECK_THAT(refused({.wind = Wind{.velocity = {NAN, 0, 0}}}), Contains("/fields/wind/velocity/0"));
    CHECK_THAT(refused({.attractors = std::vector<Attractor>(5)}), Contains("/fields/attractors"));
    CHECK(world.scene().fields.wind->velocity.x == 3);
}

TEST_CASE("growing buffers and threads change no bit in wind and water") {
    Scene scene = tests::belts(60);
    scene.fields = {.wind = Wind{.velocity = {4, 0, 1}}, .water = Water{.offset = 0.4f, .velocity = {0.3f, 0, 0}}};
    World world(scene, {}, 2), small(scene, {.pairs_at_first = 1, .contacts_at_first = 1}, 1);
    for (World* one : {&world, &small}) {
        one->step(30);
        one->apply_impulse(6, vec3(20, 10, 0));
        one->step(90);
    }
    CHECK(small.buffer_growths() > world.buffer_growths());
    CHECK(small.state_hash() == world.state_hash());
}
