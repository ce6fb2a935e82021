// The C interface: its worlds have the bits of the C++ library's, and its bulk calls read and set what they say.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/c/interface.h"
#include "tests/temporary_folder.h"

using namespace scree::c_tests;
using Catch::Detail::Approx;

namespace {

struct Row {  // of a caller's own records
    float mark = 7, position[3] = {}, orientation[4] = {}, velocity[3] = {}, spin[3] = {}, mass = 0;
    std::uint8_t asleep = 9, exists = 9;
};

std::vector<Row> rows_of(const World& world) {
    std::vector<Row> rows(world.info().bodies);
    const scree_output outputs[] = {
        {"position", rows[0].position, sizeof(Row)}, {"orientation", rows[0].orientation, sizeof(Row)},
        {"velocity", rows[0].velocity, sizeof(Row)}, {"angular_velocity", rows[0].spin, sizeof(Row)},
        {"mass", &rows[0].mass, sizeof(Row)},        {"asleep", &rows[0].asleep, sizeof(Row)},
        {"exists", &rows[0].exists, sizeof(Row)}};
    ok(scree_world_read(world, outputs, std::size(outputs), rows.size()));
    return rows;
}

std::string copied(const scree_array& bytes) {
    return {static_cast<const char*>(bytes.data), bytes.count * bytes.stride};
}

}  // namespace

TEST_CASE("c: a world has the bits of the C++ library's, also from the text that it gives of its scene") {
    for (const auto& [name, bodies] : {std::pair{"mix", 60}, {"drive", 0}, {"shatter", 0}, {"ragdolls", 0}}) {
        INFO(name);
        const Scene scene = demo(name, static_cast<std::size_t>(bodies));
        const World world(scene);
        const scree::SceneDocument document = scree::scene_from_json(scene.get("whole"));
        scree::World other(document.scene, document.settings.value_or(scree::Settings{}));
        world.step(30);
        for (int i = 0; i < 30; ++i) other.step();
        CHECK(world.hash() == other.state_hash());
        std::uint64_t hash = 0;
        ok(scree_scene_hash(scene, &hash));
        CHECK(hash == scree::hash_of(scree::checked(document.scene)));
    }
}

TEST_CASE("c: grains are added to a scene, and poured in by a world's steps") {
    const Scene scene = balls(1);
    const std::string region = R"("region": {"box": {"lower": [3, 0, -1], "upper": [5, 1, 1]}}})";
    std::size_t first = 0;
    ok(scree_scene_add(scene, "grains", (R"({"size": 0.1, "count": 30, )" + region).c_str(), &first));
    CHECK(first == 2);
    ok(scree_scene_add(scene, "grains", (R"({"size": 0.1, "count": 20, "count_rate": 100, )" + region).c_str(), &first));
    CHECK(first == 0);  // the event
    CHECK(scree_scene_add(scene, "grains", (R"({"size": 0.1, )" + region).c_str(), &first) == SCREE_BAD_SCENE);
    const World world(scene);
    CHECK(world.info().bodies == 32);
    world.step(60);
    CHECK(world.info().bodies > 32);
}

TEST_CASE("c: a servo wall of a scene is a joint, which presses on what it meets") {
    const Scene scene = balls(0);
    std::size_t lid = 0, joint = 9;
    ok(scree_scene_add_bodies(scene, R"({"shape": {"box": {"half_extents": [1, 0.1, 1]}}, "position": [0, 1, 0]})", 1, nullptr, 0,
                              &lid));
    const std::string wall = R"({"body": )" + std::to_string(lid);
    ok(scree_scene_add(scene, "servo_walls", (wall + R"(, "stress": 500, "max_speed": 1})").c_str(), &joint));
    CHECK(joint == 0);
    CHECK(scree_scene_add(scene, "servo_walls", (wall + R"(, "stress": 500})").c_str(), &joint) == SCREE_BAD_SCENE);
    CHECK(joint == 0);
    const World world(scene);
    world.step(120);
    CHECK(rows_of(world)[lid].position[1] == Approx(0.1).margin(0.01));
}

TEST_CASE("c: columns are read and set by their strides, and nothing beside them is touched") {
    const World world(balls(3));
    std::vector<Row> rows = rows_of(world);
    REQUIRE(rows.size() == 4);
    CHECK(rows[2].position[0] == 3);
    CHECK(rows[2].orientation[3] == 1);
    CHECK(rows[2].mass == Approx(1000 * 4 / 3.0 * 3.14159265 * 0.125).epsilon(1e-5));
    CHECK(rows[3].exists == 1);
    CHECK(rows[3].mark == 7);
    const std::int64_t chosen[] = {3, 1};
    rows[0].velocity[0] = 1;
    rows[1].velocity[0] = -2;
    const scree_column columns[] = {{"velocity", rows[0].velocity, sizeof(Row)}};
    ok(scree_world_write(world, chosen, 2, columns, 1));
    const std::vector<Row> now = rows_of(world);
    CHECK(now[3].velocity[0] == 1);
    CHECK(now[1].velocity[0] == -2);
    CHECK(now[2].velocity[0] == 0);
    CHECK(now[3].position[0] == 6);

    // An impulse of m v changes the velocity by v; a force of m g holds against gravity.
    const float impulse[] = {0, rows[2].mass, 0}, force[] = {0, rows[2].mass * 9.81f, 0};
    const scree_column pushes[] = {{"impulse", impulse, 0}, {"force", force, 0}};
    const std::int64_t pushed = 2;
    ok(scree_world_apply(world, &pushed, 1, pushes, 2));
    world.step(1);
    CHECK(rows_of(world)[2].velocity[1] == Approx(1).margin(1e-4));
}

TEST_CASE("c: bodies are added and removed by handles, and a removed one's handle is known as such") {
    const Scene more = balls(2);
    const World world(balls(2));
    scree_array added;
    ok(scree_world_add_bodies(world, more, &added));
    REQUIRE(added.count == 3);
    const scree_body last = record<scree_body>(added, 2);
    CHECK(world.info().bodies_there == 6);
    ok(scree_world_remove_bodies(world, &last, 1));
    std::uint8_t valid = 9;
    ok(scree_world_are_valid(world, &last, 1, &valid));
    CHECK(valid == 0);
    CHECK(world.info().bodies_there == 5);
    refused(scree_world_remove_bodies(world, &last, 1), SCREE_BAD_INDEX, "body");
    const std::int64_t one = 1;
    scree_body named{};
    ok(scree_world_bodies(world, &one, 1, &named));
    CHECK(named.index == 1);
}

TEST_CASE("c: a saved state is restored to the same bits, by bytes, by file and by rolling back") {
    const scree::tests::TemporaryFolder folder;
    const World world(balls(5));
    world.step(20);
    scree_array bytes;
    ok(scree_world_save(world, &bytes));
    const std::string saved = copied(bytes);
    const std::string file = (folder.path() / "state").string();
    ok(scree_world_write_checkpoint(world, file.c_str(), "noted"));
    ok(scree_world_keep_state(world));
    world.step(20);
    const std::uint64_t later = world.hash();
    const auto goes_on = [&] {
        CHECK(world.info().steps == 20);
        world.step(20);
        CHECK(world.hash() == later);
    };
    ok(scree_world_restore(world, saved.data(), saved.size()));
    goes_on();
    const char* note = nullptr;
    ok(scree_world_read_checkpoint(world, file.c_str(), &note));
    CHECK(std::string(note) == "noted");
    goes_on();
    ok(scree_world_keep_state(world));
    world.step(5);
    scree_array kept;
    ok(scree_world_kept_states(world, &kept));
    REQUIRE(kept.count >= 1);
    CHECK(record<std::uint64_t>(kept, kept.count - 1) == 40);
    ok(scree_world_roll_back(world, 5));
    CHECK(world.hash() == later);
    refused(scree_world_restore(world, saved.data(), saved.size() / 2), SCREE_BAD_CHECKPOINT, "");
    CHECK(world.hash() == later);
}

TEST_CASE("c: a world that follows the fountain has its bodies, and views are refused meanwhile") {
    const World world(demo("fountain", 100)), other(demo("fountain", 100));
    const std::size_t before = world.info().bodies;
    ok(scree_world_follow_demo(world, "fountain", 100, 1));
    world.step(25);
    other.step(25);
    CHECK(world.info().bodies == before + 3 * (100 / 36));
    CHECK(other.info().bodies == before);
    scree_view* view = nullptr;
    scree_array rows{};
    ok(scree_world_view(world, "poses", &view, &rows));
    refused(scree_world_step(world, 1, nullptr, nullptr), SCREE_VIEWED, "stepped after a demo");
    scree_view_release(view);
    ok(scree_world_follow_demo(world, nullptr, 0, 1));
    world.step(25);
    CHECK(world.info().bodies == before + 3 * (100 / 36));
    refused(scree_world_follow_demo(world, "fontain", 0, 1), SCREE_BAD_ARGUMENT, "fontain");
    refused(scree_world_follow_demo(world, "wall", 7, 1), SCREE_BAD_ARGUMENT, "bodies");
}

TEST_CASE("c: progress is told between steps, and may stop them") {
    const World world(balls(3));
    std::vector<std::uint64_t> told;
    const scree_progress note = [](void* user, std::uint64_t done, std::uint64_t) {
        auto& all = *static_cast<std::vector<std::uint64_t>*>(user);
        all.push_back(done);
        return all.size() == 3 ? 1 : 0;
    };
    refused(scree_world_step(world, 100000, note, &told), SCREE_STOPPED, "100000");
    REQUIRE(told.size() == 3);
    CHECK(world.info().steps == told[2]);
}

TEST_CASE("c: rays, casts, overlaps and nearest points find what is there") {
    const World world(balls(3));
    std::array<scree_ray, 2> rays{};
    for (scree_ray& ray : rays) ray = {{0, 9, 0}, {0, -1, 0}, INFINITY, 0xFFFFFFFF, 1, 0};
    rays[1].from[0] = 1.5f;
    std::array<scree_hit, 2> hits{};
    ok(scree_world_cast_rays(world, rays.data(), 2, sizeof(scree_ray), hits.data(), sizeof(scree_hit)));
    CHECK(hits[0].body == 1);
    CHECK(hits[0].distance == Approx(6.5));
    CHECK(hits[0].normal[1] == Approx(1));
    CHECK(hits[1].body == 0);
    CHECK(hits[1].distance == Approx(9));
    std::uint8_t any[2] = {9, 9};
    rays[1].reach = 1;
    ok(scree_world_rays_hit(world, rays.data(), 2, sizeof(scree_ray), any));
    CHECK(any[0] == 1);
    CHECK(any[1] == 0);
    std::uint64_t starts[3];
    scree_array through;
    ok(scree_world_cast_rays_through(world, rays.data(), 2, sizeof(scree_ray), starts, &through));
    CHECK(starts[1] == 2);  // the ball and the ground
    CHECK(starts[2] == 2);
    REQUIRE(through.count == 2);
    CHECK(record<scree_hit>(through, 1).body == 0);

    const char* ball = R"({"sphere": {"radius": 0.5}})";
    scree_cast cast = {{0, 9, 0}, {0, 0, 0, 1}, {0, -1, 0}, 100, 0xFFFFFFFF, 1, 0, -1};
    ok(scree_world_cast_shapes(world, ball, &cast, 1, sizeof cast, hits.data(), sizeof(scree_hit)));
    CHECK(hits[0].distance == Approx(6).margin(1e-3));
    cast.ignored = 1;
    ok(scree_world_cast_shapes(world, ball, &cast, 1, sizeof cast, hits.data(), sizeof(scree_hit)));
    CHECK(hits[0].body == 0);
    scree_placed placed = {{0, 2.75f, 0}, {0, 0, 0, 1}, 0xFFFFFFFF, -1, 0};
    scree_array found;
    ok(scree_world_overlaps(world, ball, &placed, 1, sizeof placed, starts, &found));
    REQUIRE(found.count == 1);
    CHECK(record<scree_part>(found, 0).body == 1);
    ok(scree_world_penetrations(world, ball, &placed, 1, sizeof placed, starts, &found));
    CHECK(record<scree_depth>(found, 0).depth == Approx(0.25));
    const scree_point point = {{3, 4, 0}, 10, 0xFFFFFFFF, 0};
    ok(scree_world_closest_points(world, &point, 1, sizeof point, hits.data(), sizeof(scree_hit)));
    CHECK(hits[0].body == 2);
    CHECK(hits[0].distance == Approx(1.5));
}

TEST_CASE("c: contacts and events are those of the C++ library") {
    const Scene scene = balls(2);
    const World world(scene);
    scree_event_options wanted = SCREE_INIT(scree_event_options);
    wanted.contacts = 1;
    wanted.hit_speed = 1;
    ok(scree_world_set_events(world, &wanted));
    world.step(120);
    scree_array events;
    ok(scree_world_take_events(world, &events));
    int begins = 0, hits = 0;
    for (std::size_t i = 0; i < events.count; ++i) {
        const auto& event = record<scree_event>(events, i);
        begins += event.kind == SCREE_EVENT_BEGIN ? 1 : 0;
        hits += event.kind == SCREE_EVENT_HIT ? 1 : 0;
        if (event.kind != SCREE_EVENT_HIT) continue;
        CHECK(event.speed == Approx(std::sqrt(2 * 9.81 * 1.5)).epsilon(0.03));  // of a fall of 1.5 m
        CHECK(event.a == 0);
    }
    CHECK(begins == 2);
    CHECK(hits == 2);
    scree_array contacts;
    ok(scree_world_contacts(world, &contacts));
    REQUIRE(contacts.count == 2);
    const auto& contact = record<scree_contact>(contacts, 0);
    CHECK(contact.count == 1);
    CHECK(contact.force[0] == Approx(1000 * 4 / 3.0 * 3.14159265 * 0.125 * 9.81).epsilon(0.02));
    CHECK(std::abs(contact.normal[1]) == Approx(1));
    scree_statistics statistics = SCREE_INIT(scree_statistics);
    ok(scree_world_statistics(world, SCREE_ALL_COPIES, &statistics));
    CHECK(statistics.manifolds == 2);
}

TEST_CASE("c: joints are driven, told and placed, and vehicles drive") {
    Scene scene = balls(2);
    std::size_t hinge = 9;
    ok(scree_scene_add(
        scene, "joints",
        R"({"name": "arm", "kind": {"hinge": {}}, "a": 1, "b": 2, "anchor_a": [1.5, 0, 0], "anchor_b": [-1.5, 0, 0]})", &hinge));
    ok(scree_scene_set(scene, "gravity", "[0, 0, 0]"));
    const World world(scene);
    scree_array found;
    ok(scree_world_find(world, "joints", "arm", &found));
    REQUIRE(found.count == 1);
    const std::int64_t joint = static_cast<std::int64_t>(record<std::uint64_t>(found, 0));
    const float stiffness = 1e6f, damping = 2e5f, target = 0.5f;
    const scree_column servo[] = {{"stiffness", &stiffness, 0}, {"damping", &damping, 0}, {"target", &target, 0}};
    ok(scree_world_set_drives(world, &joint, 1, -1, servo, 3));
    scree_array drives;
    ok(scree_world_drives(world, -1, &drives));
    CHECK(record<scree_drive>(drives, 0).target == 0.5f);
    CHECK(record<scree_drive>(drives, 0).max_force == INFINITY);
    world.step(240);
    scree_array states;
    ok(scree_world_joints(world, &states));
    const auto& state = record<scree_joint_state>(states, 0);
    CHECK(state.coordinates[state.axis] == Approx(0.5).margin(0.02));
    const float coordinate = -0.25f;
    const scree_column place[] = {{"coordinate", &coordinate, 0}};
    ok(scree_world_set_joint_coordinates(world, &joint, 1, -1, place, 1));
    ok(scree_world_joints(world, &states));
    CHECK(record<scree_joint_state>(states, 0).coordinates[state.axis] == Approx(-0.25).margin(1e-3));

    Scene road;
    ok(scree_scene_add_bodies(road, R"({"motion": "fixed", "shape": {"plane": {}}})", 1, nullptr, 0, nullptr));
    ok(scree_scene_add(road, "cars", R"({"name": "red", "position": [0, 0.6, 0]})", nullptr));
    const World driven(road);
    ok(scree_world_drive(driven, 0, 1, 0, 0, 0));
    driven.step(120);
    scree_array vehicles;
    ok(scree_world_vehicles(driven, &vehicles));
    CHECK(record<scree_vehicle_state>(vehicles, 0).speed > 2);
    refused(scree_world_drive(driven, 5, 1, 0, 0, 0), SCREE_BAD_INDEX, "5");
}

TEST_CASE("c: copies of a scene are each alike, and reset alone") {
    const World world(balls(2), "cpu", 3);
    CHECK(world.info().copies == 3);
    CHECK(world.info().bodies == 9);
    const float none[] = {0, 0, 0};
    ok(scree_world_set_gravity(world, 1, none));
    world.step(20);
    scree_array hashes;
    ok(scree_world_copy_hashes(world, &hashes));
    REQUIRE(hashes.count == 3);
    CHECK(record<std::uint64_t>(hashes, 0) == record<std::uint64_t>(hashes, 2));
    CHECK(record<std::uint64_t>(hashes, 0) != record<std::uint64_t>(hashes, 1));
    const std::uint8_t second[] = {0, 1, 0};
    ok(scree_world_reset(world, second, 3));
    CHECK(rows_of(world)[4].position[1] == 2);
    CHECK(rows_of(world)[1].position[1] < 1.9f);
    refused(scree_world_gravity(world, 3, std::array<float, 3>{}.data()), SCREE_BAD_INDEX, "copy 3 of 3");
}

TEST_CASE("c: views look into the tables, and what would move these is refused meanwhile") {
    const World world(balls(3));
    scree_view *poses = nullptr, *ids = nullptr;
    scree_array pose_rows, id_rows;
    ok(scree_world_view(world, "poses", &poses, &pose_rows));
    ok(scree_world_view(world, "ids", &ids, &id_rows));
    world.step(10);
    const std::vector<Row> rows = rows_of(world);
    for (std::size_t row = 0; row < id_rows.count; ++row) {
        const auto body = record<std::uint32_t>(id_rows, row);
        const auto* place = &record<float>(pose_rows, row);
        for (std::size_t k = 0; k < 3; ++k) CHECK(place[k] == rows[body].position[k]);
    }
    scree_array bytes;
    ok(scree_world_save(world, &bytes));
    const std::string saved = copied(bytes);
    refused(scree_world_restore(world, saved.data(), saved.size()), SCREE_VIEWED, "2 views");
    scree_view_release(poses);
    scree_view_release(ids);
    scree_view_release(ids);  // a second time is nothing
    ok(scree_world_restore(world, saved.data(), saved.size()));
}

TEST_CASE("c: threads step different worlds at once, and one that is in use is refused to another") {
    const World first(balls(50)), second(balls(50));
    std::thread beside([&] { first.step(200); });
    second.step(200);
    beside.join();
    CHECK(first.hash() == second.hash());

    struct Asked {
        scree_world* world;
        scree_result result = SCREE_OK;
    } asked{first};
    const scree_progress ask = [](void* user, std::uint64_t, std::uint64_t) {
        auto& of = *static_cast<Asked*>(user);
        std::thread([&] {
            std::uint64_t hash = 0;
            of.result = scree_world_hash(of.world, &hash);
        }).join();
        return 1;
    };
    CHECK(scree_world_step(first, 100000, ask, &asked) == SCREE_STOPPED);
    CHECK(asked.result == SCREE_BUSY);
}

TEST_CASE("c: a world that is released within its own progress goes on to the end of the step, and ends then") {
    const scree::tests::TemporaryFolder folder;
    const std::string file = (folder.path() / "a.glb").string();
    const Scene scene = balls(2);
    scree_world_options options = SCREE_INIT(scree_world_options);
    options.backend = "cpu";
    scree_world* world = nullptr;
    ok(scree_world_create(scene, &options, &world));
    scree_export* made = nullptr;
    ok(scree_world_export(world, file.c_str(), 1, 0, &made));
    const std::uintmax_t at_once = std::filesystem::file_size(file);
    const scree_progress release = [](void* of, std::uint64_t, std::uint64_t) {
        scree_world_release(static_cast<scree_world*>(of));
        return 0;
    };
    ok(scree_world_step(world, 30, release, world));
    refused(scree_world_step(world, 1, nullptr, nullptr), SCREE_BAD_HANDLE, "released");
    CHECK(std::filesystem::file_size(file) > at_once);
    ok(scree_export_close(made));  // its world has ended it
    refused(scree_export_close(made), SCREE_BAD_HANDLE, "released");
}

TEST_CASE("c: pictures have their channels, and a PNG of them begins as one") {
    const World world(balls(1));
    constexpr int width = 64, height = 48;
    std::vector<std::uint8_t> color(width * height * 3);
    std::vector<float> depth(width * height);
    std::vector<std::int32_t> body(width * height);
    scree_picture picture = SCREE_INIT(scree_picture);
    picture.width = width;
    picture.height = height;
    picture.camera_json = R"({"eye": [0, 2, 5], "target": [0, 2, 0]})";
    picture.copy = SCREE_ALL_COPIES;
    picture.depth = depth.data();
    picture.body = body.data();
    ok(scree_world_render(world, &picture));
    const std::size_t middle = height / 2 * width + width / 2;
    CHECK(body[middle] == 1);
    CHECK(depth[middle] == Approx(4.5).epsilon(0.01));
    CHECK(body[0] == -1);
    CHECK(depth[0] == INFINITY);
    picture.color = color.data();
    picture.look_json = R"({"canvas": "gl", "color": "own", "samples": 4})";
    ok(scree_world_render(world, &picture));
    CHECK(color[3 * middle] != color[0]);
    scree_array bytes;
    ok(scree_png(color.data(), width, height, 3, 8, &bytes));
    CHECK(copied(bytes).substr(1, 3) == "PNG");
}

TEST_CASE("c: an export is there at once, and whole when its world ends") {
    const scree::tests::TemporaryFolder folder;
    const std::string first = (folder.path() / "a.glb").string(), second = (folder.path() / "b.usda").string();
    std::uintmax_t at_once = 0;
    {
        const World world(balls(3));
        scree_export *closed = nullptr, *left = nullptr;
        ok(scree_world_export(world, first.c_str(), 2, 0, &closed));
        ok(scree_world_export(world, second.c_str(), 1, 0, &left));
        at_once = std::filesystem::file_size(second);
        world.step(20);
        const std::uintmax_t before = std::filesystem::file_size(first);
        ok(scree_export_close(closed));
        CHECK(std::filesystem::file_size(first) > before);
        refused(scree_export_close(closed), SCREE_BAD_HANDLE, "released");
#ifndef _WIN32  // where a folder stays while a file in it is open
        // One that cannot be written may be closed again.
        const std::filesystem::path gone = folder.path() / "gone";
        std::filesystem::create_directory(gone);
        scree_export* third = nullptr;
        ok(scree_world_export(world, (gone / "c.glb").string().c_str(), 1, 0, &third));
        std::filesystem::remove_all(gone);
        refused(scree_export_close(third), SCREE_FILE_ERROR, "c.glb");
        std::filesystem::create_directory(gone);
        ok(scree_export_close(third));
        CHECK(std::filesystem::exists(gone / "c.glb"));
#endif
    }
    CHECK(std::filesystem::file_size(second) > at_once);
}
