// Checkpoints: a restored world goes on with the same bits, and what cannot be restored changes nothing.
#include "compute/checkpoint.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

// The hash after every step up to `steps`.
std::vector<std::uint64_t> hashes(World& world, std::uint64_t steps) {
    std::vector<std::uint64_t> all;
    while (world.steps() < steps) {
        tests::meddle(world);
        world.step();
        all.push_back(world.state_hash());
    }
    return all;
}

std::string refusal(World& world, std::vector<std::byte> bytes) {
    try {
        world.restore(bytes);
    } catch (const CheckpointError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a restored world goes on with the same bits, in the same world and in new ones", "[world]") {
    const Scene scene = tests::museum(80);
    World world(scene, {}, 2);
    for (const std::uint64_t moment : {0, 7, 16, 28, 90}) {
        INFO("saved after " << moment << " steps");
        hashes(world, moment);
        const std::vector<std::byte> mark = world.save();
        REQUIRE(inspect_checkpoint(mark).steps == moment);
        const std::vector<std::uint64_t> first = hashes(world, moment + 40);
        const std::size_t bodies = world.scene().bodies.size(), joints = world.scene().joints.size();
        world.restore(mark);
        REQUIRE(world.steps() == moment);
        REQUIRE(hashes(world, moment + 40) == first);
        World other(scene, {}, 1);
        other.step(3);
        other.restore(mark);
        REQUIRE(other.save() == mark);
        REQUIRE(hashes(other, moment + 40) == first);
        REQUIRE(other.scene().bodies.size() == bodies);
        REQUIRE(other.scene().joints.size() == joints);
        REQUIRE(other.save() == world.save());
        world.restore(mark);
    }
}

TEST_CASE("a world at rest sleeps on after it was restored, and its statistics are the same", "[world]") {
    const Scene scene = tests::heap(150);
    World world(scene, {}, 2);
    world.step(700);
    const Statistics before = world.statistics();
    REQUIRE(before.asleep > 50);
    const std::vector<std::byte> mark = world.save();
    World other(scene, {}, 1);
    other.restore(mark);
    const Statistics after = other.statistics();
    REQUIRE(after.asleep == before.asleep);
    REQUIRE(after.manifolds == before.manifolds);
    REQUIRE(after.points == before.points);
    REQUIRE(after.penetration_mean == before.penetration_mean);
    REQUIRE(after.spin_limited == before.spin_limited);
    for (World* one : {&world, &other}) one->explode({0, 0, 0}, 2, 5), one->step(100);
    REQUIRE(world.state_hash() == other.state_hash());
}

TEST_CASE("a checkpoint keeps settings, pending actions and grips", "[world]") {
    const Scene scene = tests::heap(30);
    Settings fine;
    fine.rate = 120;
    fine.substeps = 5;
    fine.sleeping = false;
    World world(scene, fine, 1);
    world.step(10);
    world.grip(3, vec3(0), vec3(1, 5, 0));
    world.apply_impulse(4, vec3(100, 200, 0));
    world.set_velocity(5, vec3(0, 9, 0), vec3(1));
    world.wake_all();
    World other(scene, {}, 2);  // with other settings
    other.restore(world.save());
    REQUIRE(other.settings().rate == 120);
    REQUIRE(other.time() == world.time());
    world.step(30);
    other.step(30);
    REQUIRE(world.state_hash() == other.state_hash());
    world.move_grip(0, vec3(0));
    other.move_grip(0, vec3(0));
    world.step(30);
    other.step(30);
    REQUIRE(world.state_hash() == other.state_hash());
}

TEST_CASE("bodies in another order in memory are restored into it, and out of it", "[world]") {
    const Scene scene = tests::museum(60);
    World plain(scene, {}, 1), sorted(scene, {}, 2);
    for (World* one : {&plain, &sorted}) one->step(20);
    const std::vector<std::byte> unsorted = sorted.save();
    sorted.reorder();
    sorted.step(10);
    plain.step(10);
    REQUIRE(sorted.reorderings() == 1);
    World other(scene, {}, 1);
    other.restore(sorted.save());
    REQUIRE(other.row_of(5) == sorted.row_of(5));
    for (World* one : {&other, &plain}) one->step(30);
    REQUIRE(other.state_hash() == plain.state_hash());
    sorted.restore(unsorted);
    sorted.step(40);
    REQUIRE(sorted.state_hash() == plain.state_hash());
}

TEST_CASE("worlds whose bodies were sorted in memory at different times save the same bytes once both are sorted", "[world]") {
    const Scene scene = tests::heap(300);
    World one(scene, {}, 1), other(scene, {}, 2);
    for (int i = 0; i < 40; ++i) {
        if (i == 3) one.reorder();
        if (i == 11 || i == 30) other.reorder();
        for (World* world : {&one, &other}) world->step(2);
    }
    REQUIRE(one.state_hash() == other.state_hash());
    REQUIRE(one.save() != other.save());
    for (World* world : {&one, &other}) {
        world->reorder();
        world->step();
    }
    REQUIRE(one.state_hash() == other.state_hash());
    REQUIRE(one.save() == other.save());
}

TEST_CASE("a damaged, shortened or foreign checkpoint is refused with a reason, and changes nothing", "[world]") {
    const Scene scene = tests::museum(20);
    World world(scene, {}, 1), untouched(scene, {}, 1);
    world.step(20);
    untouched.step(20);
    const std::vector<std::byte> mark = world.save();
    world.step(5);
    untouched.step(5);
    using Catch::Contains;
    tests::Noise noise(3);
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<std::byte> bad = mark;
        const auto place = static_cast<std::size_t>((noise() + 1) / 2 * static_cast<float>(mark.size() - 1));
        bad[place] ^= std::byte{1};
        INFO("byte " << place);
        REQUIRE(!refusal(world, bad).empty());
    }
    std::vector<std::byte> bad = mark;
    bad.back() ^= std::byte{16};
    REQUIRE_THAT(refusal(world, bad), Contains("damaged"));
    REQUIRE_THAT(refusal(world, {mark.begin(), mark.end() - 100}), Contains("cut short"));
    REQUIRE_THAT(refusal(world, {mark.begin(), mark.begin() + 20}), Contains("no checkpoint"));
    REQUIRE_THAT(refusal(world, {}), Contains("no checkpoint"));
    bad = mark;
    bad[8] = std::byte{77};
    REQUIRE_THAT(refusal(world, bad), Contains("format 77"));
    Scene heavier = scene;
    heavier.bodies[3].density = 1001;
    World foreign(heavier, {}, 1);
    REQUIRE_THAT(refusal(world, foreign.save()), Contains("another scene"));
    REQUIRE(refusal(world, untouched.save()).empty());  // and one that fits is not
    world.step(30);
    untouched.step(30);
    REQUIRE(world.state_hash() == untouched.state_hash());
}

TEST_CASE("a checkpoint file holds a note, and says what is wrong with it", "[world]") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "scree-checkpoint-test";
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / "a.checkpoint";
    const Scene scene = tests::heap(20);
    World world(scene, {}, 1), other(scene, {}, 1);
    world.step(12);
    write_checkpoint(path, world, "on a Sunday");
    const CheckpointFile file = read_checkpoint(path);
    REQUIRE(file.note == "on a Sunday");
    other.restore(file.state);
    REQUIRE(other.state_hash() == world.state_hash());
    REQUIRE_THROWS_WITH(read_checkpoint(folder / "none"), Catch::Contains("none"));
    std::ofstream(path, std::ios::app) << "more";
    REQUIRE_THROWS_WITH(read_checkpoint(path), Catch::Contains("a.checkpoint") && Catch::Contains("too long"));
    std::ofstream(path) << "a poem";
    REQUIRE_THROWS_WITH(read_checkpoint(path), Catch::Contains("no checkpoint of scree"));
    std::filesystem::remove_all(folder);
}
