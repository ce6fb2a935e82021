// Every demo's promise on the CPU, with few bodies where possible.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "demos/scenes/demos.h"
#include "demos/suite/suite.h"

using namespace scree;

namespace {

const std::vector<std::string> quick = {"rest", "stack", "seesaw", "slopes", "cradle", "dominoes"};
const std::vector<std::string> standing = {"tower",      "stack20", "stack80", "smallstack", "ministack", "heavytop",
                                           "heaviertop", "cards",   "jenga",   "scales",     "coins"};
const std::vector<std::string> moving = {
    "onset", "hold",     "steep", "rolling", "bounce",    "tumbling", "swarm", "shots",  "strikes", "solids",  "compounds",
    "feet",  "rollmesh", "yaw",   "spins",   "turntable", "blows",    "pairs", "plough", "arches",  "capstan", "joinedshots"};
const std::vector<std::string> heaps = {"pile",    "mix",  "avalanche", "assortment", "mix1m",  "bins",    "overlap",
                                        "terrain", "mesh", "calm",      "fountain",   "hopper", "ballast", "drum"};
const std::vector<std::string> buildings = {"wall", "pyramid"};
const std::vector<std::string> monuments = {"gables", "net", "ring"};
const std::vector<std::string> sleepers = {"pile1m"};
const std::vector<std::string> jointed = {"chain", "bridge", "machine", "pendulums", "ragdolls"};
const std::vector<std::string> driven = {"drive", "cars", "roadtest"};
const std::vector<std::string> breaking = {"thresholds", "wrecking"};
const std::vector<std::string> splintering = {"glass", "shatter", "fragments"};
const std::vector<std::string> large = {"pyramid100", "tray", "hulls1m"};  // take minutes: left to `scree check`

std::vector<demos::Row> verdict_of(const std::string& name, float offset) {
    const demos::Demo* demo = demos::find_demo(name);
    REQUIRE(demo);
    demos::DemoOptions options;
    options.bodies = demo->takes_bodies ? 100 : 0;
    options.offset = offset;
    return demos::run_trial(*demo, options, make_reference_runner(1)).rows;
}

void check_kept(const std::vector<std::string>& names, float offset = 0) {
    for (const std::string& name : names) {
        for (const demos::Row& row : verdict_of(name, offset)) {
            if (row.by_clock) continue;  // timing is left to `scree check`, since tests run concurrently
            INFO(name << ": " << row.what << ": promised " << row.promised << ", measured " << row.measured);
            CHECK(row.pass);
            // With other numbers of bodies and far from the origin other values are measured.
            if (offset == 0 && !demos::find_demo(name)->takes_bodies) CHECK((row.is_sharp() || !row.reason.empty()));
        }
    }
}

}  // namespace

TEST_CASE("every demo is held to its promise here, or takes minutes") {
    std::vector<std::string> held, all;
    for (const auto* group : {&quick, &standing, &moving, &heaps, &buildings, &monuments, &sleepers, &jointed, &driven, &breaking,
                              &splintering, &large})
        held.insert(held.end(), group->begin(), group->end());
    for (const demos::Demo& demo : demos::all_demos()) all.emplace_back(demo.name);
    std::sort(held.begin(), held.end());
    std::sort(all.begin(), all.end());
    REQUIRE(held == all);
}

TEST_CASE("the small demos keep their promises") {
    check_kept(quick);
}

TEST_CASE("what slides, rolls, bounces, tumbles and is shot keeps to the formulas") {
    check_kept(moving);
}

TEST_CASE("ten kilometres from the origin promises are kept as at it") {
    check_kept(
        {"stack", "stack20", "heavytop", "seesaw", "slopes", "onset", "rolling", "bounce", "cradle", "tumbling", "dominoes"},
        10000);
}

TEST_CASE("what shall stand stands") {
    check_kept(standing);
}

TEST_CASE("what shall break breaks, and nothing else") {
    check_kept(breaking);
}

TEST_CASE("what bursts into many pieces keeps its promises", "[long]") {
    check_kept(splintering);
}

TEST_CASE("a small pile lies still, and is struck") {
    check_kept(sleepers);
}

TEST_CASE("heaps of a hundred bodies keep their promises") {
    check_kept(heaps);
}

TEST_CASE("what hangs together keeps its promises") {
    check_kept(jointed);
}

TEST_CASE("the cars of a course and a track keep their promises") {
    check_kept({driven[0], driven[1]});
}

TEST_CASE("cars brake, accelerate, corner and park as the formulas say") {
    check_kept({driven[2]});
}

TEST_CASE("the wall keeps its promise", "[long]") {
    check_kept({buildings[0]});
}

TEST_CASE("rings, gables and nets as others show them keep their promises", "[long]") {
    check_kept(monuments);
}

TEST_CASE("the pyramid keeps its promise", "[long]") {
    check_kept({buildings[1]});
}
