// Joints and vehicles that lose their owner, on several ranks: told and saved as on one.
#include <catch2/catch.hpp>
#include <string>

#include "tests/world/on_ranks.h"
#include "tests/world/ownerless.h"

using namespace scree;

namespace {

// `first`: the first line.
void agree(const tests::Ownerless& one, const std::string& first) {
    const tests::Lines expected = tests::told_by_one(one.scene, one.script, one.poison);
    REQUIRE(expected[0] == first);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, one.scene, one.script, one.poison), expected);
}

}  // namespace

TEST_CASE("joints of bodies that are all in quarantine are told and saved by every rank as by one", "[world][ranks]") {
    agree(tests::joints_in_quarantine(), "4 in quarantine");
}

TEST_CASE("joints of bodies that have all broken are told and saved by every rank as by one", "[world][ranks]") {
    agree(tests::joints_of_broken_bodies(), "12 broken");
}

TEST_CASE("a joint between bodies in quarantine goes to another rank with the rest of its block", "[world][ranks]") {
    agree(tests::joint_in_quarantine_that_migrates(), "4 in quarantine");
}

TEST_CASE("a joint between bodies in quarantine that is cut off from its block is told by every rank as by one",
          "[world][ranks]") {
    agree(tests::joint_in_quarantine_cut_off(), "4 in quarantine");
}

TEST_CASE("a vehicle whose chassis is in quarantine is driven on ranks as on one", "[world][ranks]") {
    agree(tests::vehicle_in_quarantine(), "12 in quarantine");
}

TEST_CASE("a vehicle whose chassis has broken is told by every rank as by one", "[world][ranks]") {
    agree(tests::broken_vehicle(), "2 broken");
}
