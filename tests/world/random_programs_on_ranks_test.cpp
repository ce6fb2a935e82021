// Random programs (random_program.h) on several ranks: the bits of one. SCREE_PROGRAMS and SCREE_PROGRAMS_FROM as for the race of
// processors.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <string>

#include "compute/distributed/distributed.h"
#include "tests/world/random_program.h"

using namespace scree;

TEST_CASE("random programs give the same bits on several ranks as on one", "[world][ranks]") {
    const char *count = std::getenv("SCREE_PROGRAMS"), *from = std::getenv("SCREE_PROGRAMS_FROM");
    const auto alone = [](const tests::RandomProgram& program) { return tests::steps_of(program, make_reference_runner(1)); };
    const int first = from ? std::atoi(from) : 1;
    for (int seed = first; seed < first + (count ? std::atoi(count) : 20); ++seed) {
        const int ranks = 2 + seed % 3;
        INFO("program " << seed << " on " << ranks << " ranks");
        tests::RandomProgram program = tests::random_program(static_cast<std::uint32_t>(seed));
        const auto on_ranks = tests::steps_on_ranks(
            ranks, [](const std::shared_ptr<Exchange>& exchange) { return make_distributed_runner(exchange); });
        const std::string parts = tests::difference(program, alone, on_ranks);
        if (!parts.empty()) FAIL_CHECK(parts);
    }
}
