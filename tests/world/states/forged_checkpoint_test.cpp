// Forged checkpoints: any word may be any number, under the right hash. They are refused, or can be stepped.
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "compute/checkpoint.h"
#include "compute/world.h"
#include "compute/world/states/checkpoint_seal.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

constexpr std::size_t head_bytes = 56;

// A few words replaced: by numbers that lead out of tables, by neighbours of what they were, by floats that are none.
std::vector<std::byte> forged(std::vector<std::byte> state, std::mt19937& random) {
    const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
    for (std::size_t left = 1 + below(3); left > 0; --left) {
        const std::size_t at = head_bytes + below(state.size() - head_bytes - 4);
        std::uint32_t word = 0;
        std::memcpy(&word, state.data() + at, 4);
        const std::uint32_t others[] = {0xFFFFFFFFu,
                                        0x7FFFFFFFu,
                                        0x80000000u,
                                        0u,
                                        1u,
                                        word + 1,
                                        word - 1,
                                        word * 2,
                                        word ^ 1u << below(32),
                                        static_cast<std::uint32_t>(below(1000)),
                                        std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN()),
                                        std::bit_cast<std::uint32_t>(1e30f),
                                        std::bit_cast<std::uint32_t>(-1.0f)};
        word = others[below(std::size(others))];
        std::memcpy(state.data() + at, &word, 4);
    }
    seal_checkpoint(state);
    return state;
}

}  // namespace

TEST_CASE("a forged checkpoint is refused, or can be stepped", "[world]") {
    const Scene scene = tests::museum(40);
    World world(scene, {}, 1);
    world.set_events({.contacts = true, .hit_speed = 1, .breaks = true, .sleep = true, .sensors = true});
    for (int step = 0; step < 30; ++step) {
        tests::meddle(world);
        world.step();
    }
    const std::vector<std::byte> good = world.save();
    std::vector<std::byte> again = good;
    seal_checkpoint(again);
    REQUIRE(again == good);
    const std::uint64_t hash = world.state_hash();
    std::mt19937 random(7);
    int refused = 0, taken = 0;
    for (int k = 0; k < 3000; ++k) {
        CAPTURE(k);
        try {
            world.restore(forged(good, random));
        } catch (const CheckpointError&) {
            ++refused;
            if (refused % 50 == 0) REQUIRE(world.state_hash() == hash);
            continue;
        }
        ++taken;
        world.step(3);
        world.take_events();
        world.restore(good);
        REQUIRE(world.state_hash() == hash);
    }
    CHECK(refused > 300);
    CHECK(taken > 300);
}
