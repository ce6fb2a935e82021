// Records of stages: the same steps agree with theirs, from a scene and from a checkpoint, with any number of threads; one word
// that differs is found at its step, stage, table and element; records that cannot be meant are refused.
#include "compute/replay/stage_record.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <stdexcept>
#include <string>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

std::string refusal(std::span<const std::byte> record, const Scene& scene, const Settings& settings, int steps) {
    try {
        (void)compare_with_record(record, scene, settings, 1, steps);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("steps agree with the record of their stages, with any number of threads and from a checkpoint") {
    const Scene scene = tests::heap(60);
    World world(scene, {}, 1);
    world.step(30);
    const std::vector<std::byte> mark = world.save();
    world.step(3);
    const std::vector<std::byte> record = record_stages(scene, {}, 1, 33, mark);
    for (const int threads : {1, 3}) {
        const LockstepResult result = compare_with_record(record, scene, {}, threads, 33, mark);
        CAPTURE(result.stage, result.buffer, result.detail);
        CHECK(result.equal);
        CHECK(result.step == 33);
        CHECK(result.hash == world.state_hash());
    }
    CHECK(compare_with_record(record_stages(scene, {}, 1, 4), scene, {}, 2, 4).equal);
}

TEST_CASE("a word of a record that differs is found, with step, stage, table and element") {
    const Scene scene = tests::heap(20);
    const std::vector<std::byte> record = record_stages(scene, {}, 1, 2);
    // The last stage is told by what it wrote last: broken there, nothing before differs.
    std::vector<std::byte> broken = record;
    broken.back() ^= std::byte{1};
    const LockstepResult last = compare_with_record(broken, scene, {}, 1, 2);
    CHECK_FALSE(last.equal);
    CHECK(last.step == 1);
    CHECK_FALSE(last.stage.empty());
    // The record of body 7 in what the first substep of the first step wrote first.
    const std::string_view stage = "move_bodies";
    const auto words = std::as_bytes(std::span(stage));
    const auto at = std::search(record.begin(), record.end(), words.begin(), words.end());
    REQUIRE(at != record.end());
    std::uint32_t table = 0;
    std::memcpy(&table, &*at + stage.size(), sizeof table);
    const TableInfo& info = table_infos()[table];
    broken = record;
    const std::size_t begin = static_cast<std::size_t>(at - record.begin()) + stage.size() + sizeof table + sizeof(std::uint64_t);
    const std::size_t element = 7;
    broken[begin + element * info.record_bytes + 4] ^= std::byte{64};
    const LockstepResult found = compare_with_record(broken, scene, {}, 1, 2);
    CHECK_FALSE(found.equal);
    CHECK(found.step == 0);
    CHECK(found.stage == stage);
    CHECK(found.buffer == info.name);
    CHECK(found.element == element);
    CHECK(found.detail.find("byte 4: here 0x") != std::string::npos);
}

TEST_CASE("records of other scenes, settings and steps, and damaged ones, are refused") {
    const Scene scene = tests::heap(20);
    const std::vector<std::byte> record = record_stages(scene, {}, 1, 2);
    Settings other;
    other.substeps = 4;
    CHECK(refusal(record, scene, other, 2).find("another state") != std::string::npos);
    CHECK(refusal(record, tests::heap(21), {}, 2).find("another state") != std::string::npos);
    CHECK(refusal(record, scene, {}, 3).find("ends with step 2") != std::string::npos);
    CHECK(refusal(std::span(record).first(record.size() / 2), scene, {}, 2).find("damaged") != std::string::npos);
    CHECK(refusal(std::span(record).subspan(1), scene, {}, 2).find("is none") != std::string::npos);
    CHECK(refusal({}, scene, {}, 2).find("damaged") != std::string::npos);
}
