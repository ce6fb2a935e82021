// The race of processors over random programs (random_program.h): every number of lanes and threads gives the same bits.
// SCREE_PROGRAMS=10000 runs so many, from SCREE_PROGRAMS_FROM on.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "compute/cpu/reference_runner.h"
#include "tests/world/random_program.h"

using namespace scree;

namespace {

std::uint32_t number_in(const char* variable, std::uint32_t otherwise) {
    const char* said = std::getenv(variable);
    return said ? static_cast<std::uint32_t>(std::atol(said)) : otherwise;
}

}  // namespace

TEST_CASE("random programs give the same bits with any number of lanes and threads", "[world]") {
    const auto scalar = [] { return std::make_unique<ReferenceRunner>(1, 1); };
    const std::uint32_t first = number_in("SCREE_PROGRAMS_FROM", 1);
    for (std::uint32_t seed = first; seed < first + number_in("SCREE_PROGRAMS", 40); ++seed) {
        INFO("program " << seed);
        for (const auto& [threads, lanes] : {std::pair{1, 4}, {2, 8}, {1, 16}, {4, 16}}) {
            if (seed % 4 != static_cast<std::uint32_t>(lanes + threads) % 4 && std::getenv("SCREE_PROGRAMS") == nullptr) continue;
            INFO(threads << " threads, " << lanes << " lanes");
            tests::RandomProgram program = tests::random_program(seed);
            const std::string parts = tests::difference(program, scalar, [threads = threads, lanes = lanes] {
                return std::make_unique<ReferenceRunner>(threads, lanes);
            });
            if (!parts.empty()) FAIL_CHECK(parts);
        }
    }
}

namespace {

// Where one lane and eight part, empty if nowhere.
std::string parting_of(std::uint32_t seed) {
    tests::RandomProgram program = tests::random_program(seed);
    return tests::difference(
        program, [] { return std::make_unique<ReferenceRunner>(1, 1); }, [] { return std::make_unique<ReferenceRunner>(1, 8); });
}

}  // namespace

TEST_CASE("a contact without torsional friction beside one with it: lanes keep to themselves", "[world]") {
    // Program 481: a box and a tyre on a height field; eight lanes gave the tyre the twist of the box.
    CHECK(parting_of(481).empty());
}

TEST_CASE("an impact that lasts while its material loses restitution leaves nothing behind, in lanes or alone", "[world]") {
    // Program 22817: one lane kept the energy that the impact had yet to return.
    CHECK(parting_of(22817).empty());
}
