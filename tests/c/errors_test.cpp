// The C interface refuses bad input with a kind, a message and a place, and what it refuses changes nothing.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "tests/c/interface.h"

using namespace scree::c_tests;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("c: handles that are null, released or of another kind are refused") {
    std::uint64_t hash = 0;
    refused(scree_scene_hash(nullptr, &hash), SCREE_BAD_HANDLE, "a scene is null");
    refused(scree_world_hash(nullptr, &hash), SCREE_BAD_HANDLE, "a world is null");
    scree_scene* scene = nullptr;
    ok(scree_scene_create(&scene));
    scree_scene* const stale = scene;
    scree_scene_release(scene);
    refused(scree_scene_hash(stale, &hash), SCREE_BAD_HANDLE, "released");
    ok(scree_scene_create(&scene));  // may have its place in the table, and is another one
    CHECK(scene != stale);
    refused(scree_scene_hash(stale, &hash), SCREE_BAD_HANDLE, "released");
    scree_scene_release(stale);
    ok(scree_scene_hash(scene, &hash));
    refused(scree_world_hash(reinterpret_cast<scree_world*>(scene), &hash), SCREE_BAD_HANDLE, "no world's");
    refused(scree_scene_hash(reinterpret_cast<scree_scene*>(&hash), &hash), SCREE_BAD_HANDLE, "no scene's");
    scree_scene_release(scene);
    scree_world_release(nullptr);
    scree_view_release(nullptr);
}

TEST_CASE("c: descriptions are refused with the place of what is wrong, and add nothing") {
    const Scene scene = balls(1);
    const auto bad_body = [&](const char* body, const char* place) {
        CHECK(scree_scene_add_bodies(scene, body, 1, nullptr, 0, nullptr) == SCREE_BAD_SCENE);
        CHECK(std::string(scree_error_place()) == place);
    };
    bad_body(R"({"shape": {"cube": {}}})", "/bodies/2/shape");
    bad_body(R"({"shape": {"sphere": {"radius": "1"}}})", "/bodies/2/shape/sphere/radius");
    bad_body(R"({"shap": 1})", "/bodies/2/shap");
    bad_body("{", "");
    CHECK(scree_scene_add(scene, "joints", R"({"kind": {"hinge": {}}, "a": 7, "b": "nobody"})", nullptr) == SCREE_BAD_SCENE);
    CHECK(std::string(scree_error_place()).starts_with("/joints/0"));
    CHECK(scree_scene_add(scene, "events", R"({"time": -1})", nullptr) == SCREE_BAD_SCENE);
    CHECK(scree_scene_set(scene, "duration", "-3") == SCREE_BAD_SCENE);
    CHECK(std::string(scree_error_place()) == "/duration");
    refused(scree_scene_set(scene, "gravitty", "[0, 0, 0]"), SCREE_BAD_ARGUMENT, "gravity");
    refused(scree_scene_add(scene, "joint", "{}", nullptr), SCREE_BAD_ARGUMENT, "joints");
    refused(scree_scene_get(scene, "scene", nullptr), SCREE_BAD_ARGUMENT, "json: is null");
    const char* unlike_text = "\xff\xfe";
    refused(scree_scene_add_bodies(scene, unlike_text, 1, nullptr, 0, nullptr), SCREE_BAD_ARGUMENT, "body_json: is not UTF-8");
    refused(scree_scene_set(scene, unlike_text, "1"), SCREE_BAD_ARGUMENT, "key: is not UTF-8");
    refused(scree_scene_add_bodies(scene, nullptr, 1, nullptr, 0, nullptr), SCREE_BAD_ARGUMENT, "body_json: is null");
    scree_scene* made = nullptr;
    refused(scree_scene_demo("wal", 0, 1, &made), SCREE_BAD_ARGUMENT, "wall");
    refused(scree_scene_demo("wall", 60, 1, &made), SCREE_BAD_ARGUMENT, "bodies: the demo wall");
    refused(scree_scene_load("/nowhere/scene.json", nullptr, &made), SCREE_FILE_ERROR, "/nowhere/scene.json");
    CHECK(made == nullptr);
    const float places[] = {0, 0, 0};
    const scree_column unknown[] = {{"postion", places, 0}}, twice[] = {{"position", places, 0}, {"position", places, 0}},
                       narrow[] = {{"position", places, 8}}, none[] = {{"position", nullptr, 0}};
    const char* ball = R"({"shape": {"sphere": {"radius": 1}}})";
    refused(scree_scene_add_bodies(scene, ball, 1, unknown, 1, nullptr), SCREE_BAD_ARGUMENT, "position");
    refused(scree_scene_add_bodies(scene, ball, 1, twice, 2, nullptr), SCREE_BAD_ARGUMENT, "two columns");
    refused(scree_scene_add_bodies(scene, ball, 1, narrow, 1, nullptr), SCREE_BAD_ARGUMENT, "12");
    refused(scree_scene_add_bodies(scene, ball, 1, none, 1, nullptr), SCREE_BAD_ARGUMENT, "position: is null");
    refused(scree_scene_add_bodies(scene, ball, std::numeric_limits<std::size_t>::max(), nullptr, 0, nullptr), SCREE_NO_MEMORY,
            "");
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    refused(scree_scene_add(scene, "joints", deep.c_str(), nullptr), SCREE_BAD_SCENE, "nested");
    CHECK(scree_scene_set(scene, "gravity", "[1, 2, \"x\"]") == SCREE_BAD_SCENE);
    CHECK(scene.get("gravity") == "[0, -9.81, 0]");
    CHECK(scree_scene_add(scene, "cars", R"({"density": -1})", nullptr) == SCREE_BAD_SCENE);
    float mass = 7, inertia[3];
    refused(scree_mass_properties(ball, -1, &mass, inertia), SCREE_BAD_ARGUMENT, "density");
    refused(scree_mass_properties(ball, no_number, &mass, inertia), SCREE_BAD_ARGUMENT, "density");
    CHECK(mass == 7);
    std::size_t bodies = 0, joints = 0;
    ok(scree_scene_count(scene, "bodies", &bodies));
    ok(scree_scene_count(scene, "joints", &joints));
    CHECK(bodies == 2);
    CHECK(joints == 0);
}

TEST_CASE("c: structs without their size, or with members that are not known, are refused") {
    const Scene scene = balls(1);
    scree_world* world = nullptr;
    scree_world_options options{};
    refused(scree_world_create(scene, &options, &world), SCREE_BAD_ARGUMENT, "SCREE_INIT");
    options.size = 12;  // within a member
    options.backend = "cpu";
    refused(scree_world_create(scene, &options, &world), SCREE_BAD_ARGUMENT, "SCREE_INIT");
    options.size = sizeof options;
    options.backend = "cuda";
    refused(scree_world_create(scene, &options, &world), SCREE_BAD_ARGUMENT, "vulkan");
    options.backend = "cpu";
    options.threads = -1;
    refused(scree_world_create(scene, &options, &world), SCREE_BAD_ARGUMENT, "threads");
    options.threads = 1;
    options.settings_json = R"({"rate": 1})";
    CHECK(scree_world_create(scene, &options, &world) == SCREE_BAD_SCENE);
    CHECK(std::string(scree_error_place()) == "/settings/rate");
    options.settings_json = nullptr;
    struct Newer {  // of a later version
        scree_world_options known;
        std::uint64_t more[2];
    } newer{options, {0, 0}};
    newer.known.size = sizeof newer;
    newer.more[1] = 5;
    refused(scree_world_create(scene, &newer.known, &world), SCREE_BAD_ARGUMENT, "does not know");
    newer.more[1] = 0;
    ok(scree_world_create(scene, &newer.known, &world));
    struct Older {  // of an earlier version: steps and time
        std::size_t size;
        std::uint64_t steps;
        double time;
        std::uint64_t beyond;
    } older{offsetof(Older, beyond), 0, 0, 77};
    ok(scree_world_step(world, 30, nullptr, nullptr));
    ok(scree_world_get_info(world, reinterpret_cast<scree_world_info*>(&older)));
    CHECK(older.steps == 30);
    CHECK(older.time == Catch::Detail::Approx(0.5));
    CHECK(older.beyond == 77);
    scree_world_release(world);
}

TEST_CASE("c: a refused call leaves the world's bits as they are") {
    const World world(balls(4));
    world.step(10);
    const std::uint64_t before = world.hash();
    const std::int64_t some[] = {1, 9}, ground = 0, second = 2, negative = -1;
    const float bad[] = {0, 0, 0, no_number, 0, 0}, fine[] = {0, 0, 0, 0, 0, 0}, far[] = {1e9f, 0, 0};
    const scree_column position[] = {{"position", fine, 0}}, not_finite[] = {{"velocity", bad, 0}},
                       away[] = {{"position", far, 0}}, force[] = {{"force", bad, 0}}, push[] = {{"impulse", fine, 0}};
    refused(scree_world_write(world, some, 2, position, 1), SCREE_BAD_INDEX, "body 9 of 5");
    refused(scree_world_write(world, &negative, 1, position, 1), SCREE_BAD_INDEX, "body -1 of 5");
    const std::int64_t two[] = {1, 2};
    CHECK(scree_world_write(world, two, 2, not_finite, 1) != SCREE_OK);
    CHECK(scree_world_write(world, &second, 1, away, 1) != SCREE_OK);
    refused(scree_world_write(world, nullptr, 2, position, 1), SCREE_BAD_ARGUMENT, "null");
    refused(scree_world_apply(world, two, 2, force, 1), SCREE_BAD_ARGUMENT, "body 2: the force is not finite");
    refused(scree_world_apply(world, &ground, 1, push, 1), SCREE_BAD_ARGUMENT, "not dynamic");
    refused(scree_world_set_body(world, 1, "mass", "-1"), SCREE_BAD_SCENE, "mass");
    refused(scree_world_set_body(world, 1, "weight", "1"), SCREE_BAD_ARGUMENT, "mass");
    refused(scree_world_set_body(world, 99, "mass", "1"), SCREE_BAD_INDEX, "body 99 of 5");
    CHECK(scree_world_set_material(world, two, 2, R"({"friction": -4})") == SCREE_BAD_SCENE);
    CHECK(scree_world_set(world, "substeps", "12.5") != SCREE_OK);
    CHECK(scree_world_set(world, "substeps", "1000000") != SCREE_OK);
    refused(scree_world_set(world, "substep", "12"), SCREE_BAD_ARGUMENT, "substeps");
    scree_ray ray = {{0, 9, 0}, {0, -2, 0}, 10, 1, 1, 0};
    scree_hit hit;
    CHECK(scree_world_cast_rays(world, &ray, 1, sizeof ray, &hit, sizeof hit) != SCREE_OK);
    refused(scree_world_cast_rays(world, &ray, 1, 4, &hit, sizeof hit), SCREE_BAD_ARGUMENT, "stride");
    ray.along[1] = -1;
    ray.copy = 3;
    refused(scree_world_cast_rays(world, &ray, 1, sizeof ray, &hit, sizeof hit), SCREE_BAD_ARGUMENT, "copy");
    scree_array found;
    refused(scree_world_drives(world, 6, &found), SCREE_BAD_ARGUMENT, "axis");
    float row[3];
    const scree_output output[] = {{"position", row, 0}};
    refused(scree_world_read(world, output, 1, 1), SCREE_BAD_ARGUMENT, "1 rows");
    CHECK(world.hash() == before);
}

TEST_CASE("c: of joints and bodies all change, or none") {
    Scene scene = balls(3);
    ok(scree_scene_add(scene, "joints", R"({"kind": {"hinge": {}}, "a": 1, "b": 2})", nullptr));
    ok(scree_scene_add(scene, "joints", R"({"kind": {"ball": {}}, "a": 2, "b": 3})", nullptr));
    const World world(scene);
    const std::int64_t twice[] = {0, 0}, both[] = {0, 1};
    const float speed[] = {1, no_number}, force[] = {5, 5};
    const scree_column motors[] = {{"speed", speed, 0}, {"max_force", force, 0}};
    CHECK(scree_world_set_motors(world, twice, 2, -1, motors, 2) == SCREE_BAD_SCENE);
    CHECK(scree_world_set_motors(world, both, 2, -1, motors, 2) != SCREE_OK);
    CHECK(scree_world_set_springs(world, both, 2, -1, R"({"stiffness": 5})") != SCREE_OK);
    scree_array drives;
    ok(scree_world_drives(world, -1, &drives));
    CHECK(record<scree_drive>(drives, 0).motor_speed == 0);
    CHECK(record<scree_drive>(drives, 0).stiffness == 0);
    Scene broken = demo("glass");
    const World glass(broken);
    std::vector<std::uint8_t> exists(glass.info().bodies);
    const scree_output output[] = {{"exists", exists.data(), 0}};
    ok(scree_world_read(glass, output, 1, exists.size()));
    const auto unborn = static_cast<std::int64_t>(std::find(exists.begin(), exists.end(), 0) - exists.begin());
    REQUIRE(static_cast<std::size_t>(unborn) < exists.size());
    const std::int64_t some[] = {1, unborn};
    refused(scree_world_set_material(glass, some, 2, R"({"friction": 0.9})"), SCREE_BAD_ARGUMENT, "fragment");
}

// Calls with arguments that are right, wrong or senseless, in an order of chance: each returns, and what is refused leaves the
// bits.
TEST_CASE("c: calls of chance return, and refused ones change nothing") {
    std::mt19937 chance(20261129);
    const auto pick = [&](std::uint32_t count) { return static_cast<std::uint32_t>(chance() % count); };
    const Scene scene = balls(6);
    const World world(scene);
    const char* words[] = {"position", "velocity", "force", "mass",   "",          "\xff",
                           "substeps", "bodies",   "scene", "target", "max_force", nullptr};
    const char* texts[] = {"{}",
                           "[]",
                           "1",
                           "-1e39",
                           "null",
                           "{\"shape\": {\"box\": {}}}",
                           "\"x\"",
                           "{\"hinge\": {}}",
                           "[0,0,0]",
                           "\xff",
                           nullptr,
                           "{\"kind\": {\"ball\": {}}, \"a\": 1, \"b\": 2}",
                           "{\"sphere\": {\"radius\": 0.2}}"};
    const float numbers[] = {0, 1, -1, 1e30f, no_number, INFINITY, 0.25f, 2, 3, -0.0f, 1e-30f, 5};
    const std::int64_t indices[] = {0, 1, 2, 6, 7, -1, 1'000'000'000'000, 3};
    std::size_t refusals = 0, done = 0;
    for (int round = 0; round < 3000; ++round) {
        const std::uint64_t before = world.hash();
        const scree_column columns[] = {{words[pick(12)], pick(9) ? numbers : nullptr, std::size_t{pick(3) * 4}},
                                        {words[pick(12)], numbers, 0}};
        float rows[64];
        const scree_output outputs[] = {{words[pick(12)], pick(9) ? rows : nullptr, 0}};
        const std::int64_t* some = indices + pick(7);
        const std::size_t count = pick(3) == 0 ? 0 : 1, column_count = pick(3);
        scree_array found{};
        const char* text = nullptr;
        std::uint64_t starts[3];
        scree_hit hit{};
        scree_ray ray{};
        std::memcpy(ray.from, numbers + pick(5), sizeof ray.from + sizeof ray.along);
        ray.reach = numbers[pick(12)];
        ray.mask = pick(3);
        scree_placed placed{};
        std::memcpy(placed.position, numbers + pick(5), sizeof placed.position + sizeof placed.orientation);
        placed.ignored = indices[pick(8)];
        scree_world* const on =
            pick(40) ? static_cast<scree_world*>(world) : reinterpret_cast<scree_world*>(std::uintptr_t{pick(50)});
        bool changes = false;
        scree_result result = SCREE_OK;
        switch (pick(20)) {
            case 0:
                result = scree_world_write(on, some, count, columns, column_count), changes = true;
                break;
            case 1:
                result = scree_world_apply(on, some, count, columns, column_count), changes = true;
                break;
            case 2:
                result = scree_world_read(on, outputs, pick(2), 7 + pick(2));
                break;
            case 3:
                result = scree_world_read_of(on, some, count, outputs, pick(2));
                break;
            case 4:
                result = scree_world_set_body(on, static_cast<std::size_t>(indices[pick(8)]), words[pick(12)], texts[pick(13)]),
                changes = true;
                break;
            case 5:
                result = scree_world_set(on, words[pick(12)], texts[pick(13)]), changes = true;
                break;
            case 6:
                result = scree_world_cast_rays(on, &ray, count, sizeof ray, &hit, sizeof hit);
                break;
            case 7:
                result = scree_world_cast_rays_through(on, &ray, count, sizeof ray, starts, &found);
                break;
            case 8:
                result = scree_world_overlaps(on, texts[pick(13)], &placed, count, sizeof placed, starts, &found);
                break;
            case 9:
                result = scree_world_penetrations(on, texts[pick(13)], &placed, count, sizeof placed, starts, &found);
                break;
            case 10:
                result = scree_world_add_joint(on, texts[pick(13)], pick(2) ? numbers : nullptr, numbers + pick(9), nullptr),
                changes = true;
                break;
            case 11:
                result = scree_world_set_drives(on, some, count, static_cast<int>(pick(9)) - 2, columns, column_count),
                changes = true;
                break;
            case 12:
                result = scree_world_set_motors(on, some, count, -1, columns, column_count), changes = true;
                break;
            case 13:
                result = scree_world_set_material(on, some, count, texts[pick(13)]), changes = true;
                break;
            case 14:
                result = scree_world_get(on, words[pick(12)], &text);
                break;
            case 15:
                result = scree_world_step(on, pick(3), nullptr, nullptr), changes = true;
                break;
            case 16:
                result = scree_world_restore(on, numbers, pick(48)), changes = true;
                break;
            case 17:
                result = scree_world_explode(on, numbers + pick(9), numbers[pick(12)], numbers[pick(12)]), changes = true;
                break;
            case 18:
                result = scree_world_remove_joint(on, pick(4)), changes = true;
                break;
            default:
                result = scree_world_move(on, some, count, columns, column_count, static_cast<int>(pick(4)) - 1), changes = true;
                break;
        }
        ++(result == SCREE_OK ? done : refusals);
        if (result != SCREE_OK) REQUIRE(std::strlen(scree_error_message()) > 0);
        if (result != SCREE_OK || !changes) REQUIRE(world.hash() == before);
    }
    CHECK(refusals > 500);
    CHECK(done > 300);
}
