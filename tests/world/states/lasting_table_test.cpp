// A lasting table of rows is declared once; its records then go wherever their bodies go.
#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "tests/world/coarse.h"
#include "tests/world/states/lasting_probe.h"

using namespace scree;
using tests::Marks;

namespace {

// Bodies that fly past each other.
Scene crossing() {
    return tests::swarm(300, 0.5f);
}

std::set<std::uint32_t> owned_ids(const State& share) {
    std::set<std::uint32_t> ids;
    for (std::uint32_t row = 0; row < share.fixed().first_part; ++row)
        if (share.is_owned(row)) ids.insert(share.id_of(row));
    return ids;
}

}  // namespace

TEST_CASE("lasting tables: records move with their bodies to other rows", "[world]") {
    World world(crossing(), tests::coarse(), 1);
    tests::mark(world);
    for (int i = 0; i < 4; ++i) {
        world.step(10);
        world.reorder();
    }
    world.step(10);
    REQUIRE(tests::is_moved(world));
    CHECK(tests::marks_of(world) == tests::expected_marks(crossing(), tests::coarse(), 50));
}

TEST_CASE("lasting tables: records move with their bodies to other ranks, into shares and out of them", "[world]") {
    constexpr int early = 20, late = 100;
    std::vector<Marks> marks(3);
    std::vector<std::uint8_t> were_shared(3), has_others(3);
    std::vector<std::byte> saved;
    run_in_process(3, [&](const std::shared_ptr<Exchange>& exchange) {
        const auto rank = static_cast<std::size_t>(exchange->rank());
        World world(crossing(), tests::coarse(), make_distributed_runner(exchange));
        tests::mark(world);
        world.step(early);
        world.share_out();
        were_shared[rank] = world.share().has_value();
        if (!were_shared[rank]) return;
        const std::set<std::uint32_t> before = owned_ids(world.share()->state);
        world.step(late - early);
        world.share_out();
        has_others[rank] = owned_ids(world.share()->state) != before;
        world.save_in_pieces([&](std::uint64_t at, std::span<const std::byte> piece) {
            if (saved.size() < at + piece.size()) saved.resize(at + piece.size());
            std::copy(piece.begin(), piece.end(), saved.begin() + static_cast<std::ptrdiff_t>(at));
        });
        marks[rank] = tests::marks_of(world);
    });
    CHECK(were_shared == std::vector<std::uint8_t>(3, 1));
    CHECK(has_others == std::vector<std::uint8_t>(3, 1));
    const Marks expected = tests::expected_marks(crossing(), tests::coarse(), late);
    for (const Marks& of_rank : marks) CHECK(of_rank == expected);
    World resumed(crossing(), tests::coarse(), 1);
    resumed.restore(saved);
    CHECK(tests::marks_of(resumed) == expected);
}

TEST_CASE("lasting tables: records are in checkpoints, and in states for rollback", "[world]") {
    World world(crossing(), tests::coarse(), 1);
    tests::mark(world);
    world.step(10);
    const std::vector<std::byte> saved = world.save();
    const Marks then = tests::marks_of(world);
    world.keep_state();
    world.step(10);
    const Marks later = tests::marks_of(world);
    tests::mark(world, 1000);
    world.roll_back(10);
    CHECK(tests::marks_of(world) == then);
    World resumed(crossing(), tests::coarse(), 1);
    resumed.restore(saved);
    CHECK(tests::marks_of(resumed) == then);
    resumed.step(10);
    CHECK(tests::marks_of(resumed) == later);
}

TEST_CASE("lasting tables: a copy that is reset begins with the records of the start, the others go on", "[world]") {
    constexpr std::size_t copies = 3;
    const Scene scene = tests::swarm(20, 0.5f);
    World world(scene, tests::coarse(), make_reference_runner(1), copies);
    const Marks start = tests::marks_of(world);
    tests::mark(world);
    const Marks marked = tests::marks_of(world);
    world.reset_copy(1);
    const Marks now = tests::marks_of(world);
    for (std::size_t id = 0; id < now.size(); ++id) CHECK(now[id] == (id / 20 == 1 ? start[id] : marked[id]));
}

TEST_CASE("lasting tables: a body in the row of a removed one begins with nothing", "[world]") {
    World world(crossing(), tests::coarse(), 1);
    tests::mark(world);
    world.remove_body(7);
    world.step(2);
    const std::size_t index = world.add_bodies(std::vector<Body>{crossing().bodies[7]})[0].index;
    REQUIRE(index == 7);
    CHECK(tests::marks_of(world)[7] == tests::Mark{});
}
