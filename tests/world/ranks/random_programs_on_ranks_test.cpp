// Random programs (random_program.h) on several ranks: the bits of one. SCREE_PROGRAMS and SCREE_PROGRAMS_FROM as for the race of
// processors.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <string>

#include "compute/distributed/distributed.h"
#include "tests/world/random_program.h"

using namespace scree;

namespace {

// Where 2 to 4 ranks, by the seed, and one processor part, empty if nowhere.
std::string parting_of(int seed) {
    tests::RandomProgram program = tests::random_program(static_cast<std::uint32_t>(seed));
    return tests::difference(
        program, [](const tests::RandomProgram& tried) { return tests::steps_of(tried, make_reference_runner(1)); },
        tests::steps_on_ranks(2 + seed % 3,
                              [](const std::shared_ptr<Exchange>& exchange) { return make_distributed_runner(exchange); }));
}

}  // namespace

TEST_CASE("random programs give the same bits on several ranks as on one", "[world][ranks]") {
    const char *count = std::getenv("SCREE_PROGRAMS"), *from = std::getenv("SCREE_PROGRAMS_FROM");
    const int first = from ? std::atoi(from) : 1;
    for (int seed = first; seed < first + (count ? std::atoi(count) : 20); ++seed) {
        INFO("program " << seed);
        const std::string parts = parting_of(seed);
        if (!parts.empty()) FAIL_CHECK(parts);
    }
}

TEST_CASE("a body that becomes dynamic keeps its contacts, whichever rank moves it", "[world][ranks]") {
    CHECK(parting_of(1576).empty());  // its neighbour's owner alone knew them
    CHECK(parting_of(5392).empty());  // one kept since the body was dynamic before: on one rank alone
}

TEST_CASE("a compound that comes into spare rows is seen by ranks beside it", "[world][ranks]") {
    CHECK(parting_of(2625).empty());
}

TEST_CASE("joints between bodies that are all in quarantine are broken on every rank", "[world][ranks]") {
    CHECK(parting_of(3309).empty());
}
