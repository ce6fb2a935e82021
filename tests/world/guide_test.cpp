// The C++ of the book (demos/docs): each block of a page stands here word for word, which tests/house/documents.cpp checks, and
// runs.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "compute/checkpoint.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/measures.h"
#include "compute/world.h"

namespace {

using scree::vec3;

// A ground and `boxes` boxes in a row.
scree::Scene row_of(int boxes) {
    scree::Scene scene;
    scene.bodies.push_back({.motion = scree::Motion::fixed, .shape = scree::Plane{}});
    for (int i = 0; i < boxes; ++i) {
        scree::Body box{.shape = scree::Box{vec3(0.4f)}};
        box.position = {float(i), 0.5f, 0};
        scene.bodies.push_back(box);
    }
    return scene;
}

}  // namespace

TEST_CASE("guide: a world is stepped and read", "[guide]") {
    const scree::Scene scene = row_of(3);
    const scree::Settings settings;
    const std::size_t body = 2;
    float highest = 0;
    scree::World world(scene, settings);   // on the CPU, with all cores
    world.apply_impulse(body, {0, 5, 0});  // N s, in the next step
    world.step(60);
    for (const scree::BodyState& state : world.bodies()) highest = std::max(highest, state.position.y);
    const std::uint64_t hash = world.state_hash();  // equal on every device
    CHECK(highest == Approx(0.4).margin(0.01));
    CHECK(hash != scree::World(scene).state_hash());
}

TEST_CASE("guide: bodies come, go and are moved", "[guide]") {
    scree::World world(row_of(3));
    std::vector<scree::Body> bodies(20);
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].position = {float(i), 5, 9};
    const std::vector<scree::BodyHandle> born = world.add_bodies(bodies);                    // one upload of what changed
    world.remove_bodies(std::span(born).first(10));                                          // indices of others stay
    world.set_bodies(std::vector{scree::BodyChange{.body = 3, .position = vec3(0, 5, 0)}});  // poses, velocities: in bulk
    world.set_motion(3, scree::Motion::kinematic);  // also set_material, set_mass, set_filter, set_exclusion
    world.set_user_data(3, 42);                     // a number of your own, also Body::user_data
    world.move_bodies(std::vector{scree::BodyTarget{.body = 3, .position = vec3(0, 2, 0), .steps = 60}});  // there after 60 steps
    world.step(60);
    CHECK(world.body(3).position.y == Approx(2).margin(1e-4));
    CHECK(world.bodies_there() == 14);
    CHECK(world.user_data(3) == 42);
}

TEST_CASE("guide: sensors report what is in them", "[guide]") {
    scree::Scene scene = row_of(2);
    scene.bodies.push_back({.motion = scree::Motion::fixed, .shape = scree::Box{vec3(0.3f)}, .role = scree::Role::sensor});
    scene.bodies.back().position = {1, 0.5f, 0};
    scree::World world(scene);
    std::vector<std::uint32_t> inside;
    world.set_events({.sensors = true});  // sensor_begin and sensor_end: one end for every begin; sleep ends none
    world.step();
    for (const scree::SensorOverlap& one : world.sensed()) inside.push_back(one.body);  // now: sensor, its part, body, its part
    CHECK(inside == std::vector<std::uint32_t>{2});
}

TEST_CASE("guide: joints come and go", "[guide]") {
    scree::World world(row_of(3));
    const std::vector<scree::Joint> joints{world.joint_at(scree::Hinge{}, 1, 2, vec3(0.5f, 0.5f, 0))};
    const std::vector<scree::JointHandle> made = world.add_joints(joints);  // takes the indices of removed ones first
    world.remove_joints(made);                                              // indices of others stay
    CHECK_FALSE(world.is_valid(made[0]));
}

TEST_CASE("guide: contacts and events are read", "[guide]") {
    scree::Scene scene = row_of(2);
    scene.bodies[2].position.y = 2;
    scree::World world(scene);
    const std::vector<std::size_t> ids{1, 2};
    std::size_t hits = 0, points = 0;
    world.set_events({.contacts = true, .hit_speed = 1, .breaks = true, .sleep = true});
    world.step(60);
    for (const scree::Event& event : world.take_events()) hits += event.kind == scree::EventKind::hit;
    for (const scree::ContactState& contact : world.contacts()) points += contact.count;  // points, separations, forces
    const std::vector<vec3> forces = world.touch_forces(ids);                             // N, of the last substep
    CHECK(hits == 2);                                                                     // of both boxes
    CHECK(points == 8);
    CHECK(forces[0].y == Approx(512 * 9.81).epsilon(0.05));
}

TEST_CASE("guide: grains are measured", "[guide]") {
    scree::World world(row_of(3));
    scree::MeasureRequest request;
    request.regions.push_back({"core", scree::MeasureSphere{{0, 0.5f, 0}, 0.5f}});
    request.bodies.push_back({.body = 0});  // force and torque on the ground
    scree::Measuring measuring(request, world);
    for (int i = 0; i < 60; ++i) {
        world.step();
        measuring.after_step(world);  // gates alone need it
    }
    const scree::Measures now = measuring.take(world);
    const double pressure = now.regions[0].pressure, load = now.bodies[0].force.y;
    CHECK(load == Approx(-3 * 512 * 9.81).epsilon(0.01));
    CHECK(pressure > 0);
}

TEST_CASE("guide: queries find bodies", "[guide]") {
    const scree::World world(row_of(3));
    const std::vector<scree::RayQuery> rays{{.from = vec3(0, 5, 0), .along = vec3(0, -1, 0)}};
    const std::vector<scree::ShapeCast> casts{
        {.shape = scree::Sphere{0.1f}, .from = vec3(1, 5, 0), .along = vec3(0, -1, 0), .reach = 10}};
    const std::vector<scree::ShapeOverlap> shapes{{.shape = scree::Sphere{0.2f}, .position = vec3(2, 0.5f, 0)}};
    const std::vector<scree::ClosestQuery> points{{.point = vec3(0, 1.4f, 0)}};
    const auto hits = world.cast_rays(rays);            // the nearest of each; rays_hit: whether any; cast_rays_through: all
    const auto stops = world.cast_shapes(casts);        // a convex shape, or a compound of them, moved along a line
    const auto lists = world.overlaps(shapes);          // lists[i]: bodies and parts that a shape overlaps
    const auto depths = world.penetrations(shapes);     // the same with depths (m) and the ways out
    const auto nearest = world.closest_points(points);  // the nearest point of any body within a reach
    CHECK(hits[0].value().body == 1);
    CHECK(stops[0].value().body == 2);
    CHECK(lists[0][0].body == 3);
    CHECK(depths[0][0].depth == Approx(0.6f));
    CHECK(nearest[0].value().body == 1);
}

TEST_CASE("guide: states are saved, restored and gone back to", "[guide]") {
    scree::World world(row_of(3));
    const std::filesystem::path folder = std::filesystem::temp_directory_path(), before = std::filesystem::current_path();
    std::filesystem::current_path(folder);
    const std::vector<std::byte> mark = world.save();  // contacts with impulses, sleep, joints, breaks, edits, settings
    world.step(60);
    world.restore(mark);                               // the next 60 steps give the same bits again
    scree::write_checkpoint("run.checkpoint", world);  // checkpoint.h: atomic, versioned, hashed
    std::filesystem::current_path(before);
    CHECK(std::filesystem::remove(folder / "run.checkpoint"));
    CHECK(world.save() == mark);

    for (int i = 0; i < 10; ++i) {
        world.keep_state();  // of ten the oldest goes; on a device it stays in its memory
        world.step();
    }
    world.roll_back(10);  // ten steps ago, edits undone; exact
    world.step(10);       // the same bits again
    scree::World other(row_of(3));
    other.step(10);
    CHECK(world.state_hash() == other.state_hash());
}

TEST_CASE("guide: a world holds many copies of a scene", "[guide]") {
    const scree::Scene scene = row_of(4);
    const scree::Settings settings;
    std::unique_ptr<scree::Runner> runner = scree::make_reference_runner();
    std::vector<std::uint8_t> mask(1024);
    mask[7] = 1;
    const auto vary = [](std::size_t copy, scree::Scene& one) {  // may be left out
        one.gravity.y = -9.81f + 0.01f * float(copy);            // values differ: poses, masses, materials, joints, gravity
    };
    scree::World world(scene, settings, std::move(runner), 1024, vary);
    world.apply_impulse(world.body_of(7, 3), {0, 5, 0});  // body 3 of copy 7: ids of a copy follow those of the copy before
    world.step(60);
    const std::uint64_t hash = world.state_hash_of(7);  // that of this scene alone, whatever the other copies did
    world.reset(mask);                                  // a mask of the copies that go back to their start
    scree::Scene seventh = scene;
    vary(7, seventh);
    scree::World alone(seventh);
    CHECK(world.state_hash_of(7) == alone.state_hash());
    alone.apply_impulse(3, {0, 5, 0});
    alone.step(60);
    CHECK(hash == alone.state_hash());
}

TEST_CASE("guide: ranks share a world", "[guide]") {
    const scree::Scene scene = row_of(8);
    const scree::Settings settings;
    std::uint64_t first = 0;
    scree::run_in_process(
        4, [&](const std::shared_ptr<scree::Exchange>& exchange) {  // threads as ranks; MPI: scree run --distributed
            scree::World world(scene, settings, scree::make_distributed_runner(exchange, 1));
            world.step(600);
            const std::uint64_t hash = world.state_hash();  // gathered: every rank calls it
            if (exchange->rank() == 0) first = hash;
        });
    scree::World one(scene, settings);
    one.step(600);
    CHECK(first == one.state_hash());
}
