// Scenes and scripts that leave joints and vehicles without an owner.
#include "tests/world/ownerless.h"

#include <utility>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"
#include "compute/vehicle_presets.h"
#include "compute/world/states/state_bytes.h"
#include "tests/world/sleepers.h"

namespace scree::tests {

Scene pairs_on_springs(int pairs) {
    std::string bodies, joints;
    for (int k = 0; k < pairs; ++k) {
        bodies += fmt::format(R"({}
            {{"shape": {{"box": {{"half_extents": [0.5, 0.5, 0.5]}}}}, "position": [{}, 0.51, 0],
              "orientation": [0, 0.25881904, 0, 0.9659258], "velocity": [1, 0, 0]}},
            {{"shape": {{"box": {{"half_extents": [0.6, 0.15, 0.4]}}}}, "position": [{}, 0.16, 0],
              "orientation": [0, -0.17364818, 0, 0.9848077]}})",
                              k > 0 ? "," : "", 40 * k + 0.8, 40 * k + 2.4);
        joints +=
            fmt::format(R"({}{{"kind": {{"slider": {{"spring": {{"stiffness": 40000, "damping": 100}}}}}}, "a": {}, "b": {}}})",
                        k > 0 ? "," : "", 2 * k, 2 * k + 1);
    }
    return scene_from_json(fmt::format(R"({{"gravity": [0, 0, 0], "bodies": [{}], "joints": [{}]}})", bodies, joints)).scene;
}

namespace {

// A ball before each pair, on a slack joint: it stays when the pair goes into quarantine.
Scene chains(int count) {
    Scene scene = pairs_on_springs(count);
    const std::size_t balls = scene.joints.size();
    for (Joint& joint : scene.joints) joint.a += balls, joint.b += balls;
    std::vector<Body> bodies;
    for (std::size_t k = 0; k < balls; ++k) {
        bodies.push_back(at(Sphere{0.2f}, scene.bodies[2 * k].position + vec3(0, 3, 0)));
        bodies.back().velocity = vec3(0, 0.1f, 0);
        scene.joints.push_back({.kind = Distance{.greatest = 1000}, .a = k, .b = balls + 2 * k});
    }
    scene.bodies.insert(scene.bodies.begin(), bodies.begin(), bodies.end());
    return checked(scene);
}

// The tables of joints and vehicles in a saved state.
std::string records_in(const std::vector<std::byte>& saved, const Scene& scene) {
    State state(checked(scene), {}, 64, true);
    restore_tables(state, saved);
    std::string bytes;
    for (const Table table : {Table::joints, Table::joint_blocks, Table::vehicles})
        for (const std::byte byte : state.raw(table)) bytes += static_cast<char>(byte);
    return bytes;
}

// The pairs on springs 0 and 5 of six chains, in step 6. Tells how many bodies that are.
const Poison ends{{6, 7, 16, 17}, 6};
std::string with_ends_in_quarantine(World& world) {
    world.step(9);
    return fmt::format("{} in quarantine", world.quarantines().size());
}

}  // namespace

Ownerless joints_in_quarantine() {
    const Scene scene = pairs_on_springs(6);
    return {scene,
            [scene](World& world) {
                Lines lines;
                world.step(9);  // not read before: that would bring the records to all
                lines.push_back(fmt::format("{} in quarantine", world.quarantines().size()));
                lines.push_back(line_of_joints(world));
                const std::vector<std::byte> mark = world.save();
                lines.push_back(records_in(mark, scene));
                world.step(3);
                lines.push_back(line_of_joints(world));
                world.restore(mark);
                lines.push_back(line_of_joints(world));
                world.step(34);  // borders move in between
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            },
            {{2, 3, 8, 9}, 6}};
}

Ownerless joints_of_broken_bodies() {
    Scene scene = pairs_on_springs(6);
    scene.gravity = vec3(0, -9.81f, 0);
    scene.bodies.push_back(ground());
    for (std::size_t k = 0; k < 12; ++k) {
        Body& body = scene.bodies[k];
        body.position.y += 1 + 0.1f * static_cast<float>(k / 2);
        body.fracture = Fracture{.impulse = 100, .cutting = Cutting::boxes, .pieces = 4};
    }
    scene = checked(scene);
    return {scene, [scene](World& world) {
                Lines lines;
                std::vector<std::byte> mark;
                for (int step = 1; step <= 80; ++step) {
                    world.step();
                    if (step % 10 == 0) lines.push_back(line_of_joints(world));
                    if (step == 50) mark = world.save();
                }
                lines.insert(lines.begin(), fmt::format("{} broken", world.statistics().broken));
                lines.push_back(records_in(mark, scene));
                world.restore(mark);
                lines.push_back(line_of_joints(world));
                world.step(30);
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            }};
}

Ownerless joint_in_quarantine_that_migrates() {
    const Scene scene = chains(6);
    return {scene,
            [scene](World& world) {
                Lines lines{with_ends_in_quarantine(world)};
                world.set_bodies(std::vector{BodyChange{.body = 0, .position = vec3(190, 9, 0)},
                                             BodyChange{.body = 5, .position = vec3(10, 9, 0)}});
                world.step(60);
                lines.push_back(hash_text(world.state_hash()));
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            },
            ends};
}

Ownerless joint_in_quarantine_cut_off() {
    const Scene scene = chains(6);
    return {scene,
            [scene](World& world) {
                Lines lines{with_ends_in_quarantine(world)};
                world.remove_joint(11);
                world.remove_joint(6);
                world.step(3);
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            },
            ends};
}

Ownerless vehicle_in_quarantine() {
    Scene scene;
    scene.bodies = {ground()};
    for (int k = 0; k < 4; ++k) {
        const std::size_t car = add_car(scene, {.position = vec3(30.0f * static_cast<float>(k), 0, 0), .speed = 3});
        const std::size_t chassis = scene.vehicles[car].chassis;
        scene.bodies.push_back(at(Box{vec3(0.6f, 0.15f, 0.4f)}, scene.bodies[chassis].position + vec3(0.3f, 3, 0)));
        scene.bodies.back().orientation = {0, -0.17364818f, 0, 0.9848077f};
        scene.joints.push_back(joint_at(scene, Slider{.slide = {.spring = Spring{.stiffness = 1000, .damping = 100}}}, chassis,
                                        scene.bodies.size() - 1, scene.bodies.back().position, vec3(0, 1, 0)));
    }
    Poison poison{{}, 6};  // the first car and the last one, with what is on them
    for (std::size_t body = 1; body < scene.bodies.size(); ++body)
        if (const std::size_t car = (body - 1) / ((scene.bodies.size() - 1) / 4); car == 0 || car == 3)
            poison.bodies.push_back(body);
    scene = checked(scene);
    return {scene,
            [scene](World& world) {
                Lines lines;
                for (std::size_t vehicle = 0; vehicle < 4; ++vehicle) world.drive(vehicle, {.throttle = 0.5f, .steer = 1});
                world.step(9);
                lines.push_back(fmt::format("{} in quarantine", world.quarantines().size()));
                world.step(20);
                lines.push_back(line_of_vehicles(world));
                lines.push_back(hash_text(world.state_hash()));
                world.step(20);
                lines.push_back(line_of_vehicles(world));
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            },
            poison};
}

Ownerless broken_vehicle() {
    Scene scene;
    scene.bodies = {ground()};
    for (int k = 0; k < 4; ++k) {
        const std::size_t cart = add_cart(scene, {.position = vec3(30.0f * static_cast<float>(k), 0, 0)});
        Body& chassis = scene.bodies[scene.vehicles[cart].chassis];
        chassis.fracture = Fracture{.impulse = 1000, .cutting = Cutting::boxes, .pieces = 4};
        if (k % 2 > 0) continue;
        scene.bodies.push_back(at(Sphere{0.5f}, chassis.position + vec3(0, 3, 0)));
        scene.bodies.back().velocity = {0, -20, 0};
    }
    scene = checked(scene);
    return {scene, [scene](World& world) {
                Lines lines;
                for (std::size_t vehicle = 0; vehicle < 4; ++vehicle) world.drive(vehicle, {.throttle = 1, .steer = 0.5f});
                world.step(20);
                lines.push_back(fmt::format("{} broken", world.statistics().broken));
                lines.push_back(line_of_vehicles(world));
                lines.push_back(line_of_joints(world));
                lines.push_back(records_in(world.save(), scene));
                return lines;
            }};
}

}  // namespace scree::tests
