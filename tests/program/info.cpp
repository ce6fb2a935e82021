// scree info: degrees of freedom of trees and loops, joints with limits and drives, couplings, masses.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

json info_of(const std::string& arguments) {
    const Outcome told = run_scree("info " + arguments + " --json");
    INFO(told.errors);
    REQUIRE(told.status == 0);
    return json::parse(told.output);
}
std::string file_of(const std::string& name) {
    return std::string("'") + SCREE_SOURCE_DIR + "/tests/imports/" + name + "'";
}

}  // namespace

TEST_CASE("program: info counts the degrees of robots, and tells joints, limits, drives, couplings and mass", "[program]") {
    const json arm = info_of(file_of("arm.urdf"));
    CHECK(arm.at("degrees_of_freedom") == 5);  // six joints, of which one mimics another
    CHECK(arm.at("is_exact") == true);
    CHECK((arm.at("free_bases") == 0 && arm.at("joint_degrees") == 6 && arm.at("coupled_degrees") == 1));
    CHECK(arm.at("mass").get<double>() == Approx(3 + 2.5 + 1.5 + 0.6 + 0.08 + 0.08));
    REQUIRE(arm.at("joints").size() == 6);
    const json& elbow = arm.at("joints").at(2);
    CHECK((elbow.at("name") == "elbow" && elbow.at("kind") == "hinge" && elbow.at("a") == "upper" && elbow.at("b") == "fore"));
    CHECK(elbow.at("axes").at(0).at("limits").at(1).get<double>() == Approx(2));
    CHECK(elbow.at("axes").at(0).at("spring").at("max_force").get<double>() == Approx(60));
    REQUIRE(arm.at("couplings").size() == 1);
    CHECK(arm.at("couplings").at(0).at("joints").size() == 2);
    CHECK(info_of(file_of("arm.urdf") + " --base free").at("degrees_of_freedom") == 5);  // its root is the link "world"
    const json dog = info_of(file_of("quadruped.xml"));
    CHECK((dog.at("degrees_of_freedom") == 18 && dog.at("free_bases") == 1 && dog.at("loops") == 0));
    const json steering = info_of(file_of("steering.xml"));
    CHECK((steering.at("loops") == 1 && steering.at("is_exact") == false && steering.at("degrees_of_freedom") == 0));
    const Outcome text = run_scree("info " + file_of("steering.xml"));
    CHECK(says(text.output, "degrees of freedom: at least 0"));
    CHECK(says(text.output, "left_kingpin"));
    CHECK(says(text.output, "-0.7 to 0.7 rad"));
    const Outcome of_arm = run_scree("info " + file_of("arm.urdf"));
    CHECK(says(of_arm.output, "degrees of freedom: 5"));
    CHECK(says(of_arm.output, "at most 60 N m"));
}

TEST_CASE("program: info counts every kind of joint of a scene, and refuses what is no scene", "[program]") {
    const Place place;
    const auto scene = [&](const std::string& joints) {
        return "'" +
               place.write("s.json", R"({"bodies": [{"name": "a", "shape": {"sphere": {"radius": 0.1}}},
          {"name": "b", "shape": {"sphere": {"radius": 0.1}}, "position": [1, 0, 0]}], "joints": [)" +
                                         joints + "]}") +
               "'";
    };
    const auto degrees = [&](const std::string& joints) { return info_of(scene(joints)).at("degrees_of_freedom").get<int>(); };
    const std::string between = R"("a": "a", "b": "b", "anchor": [0.5, 0, 0]})";
    CHECK(degrees("") == 12);
    CHECK(degrees(R"({"kind": {"ball": {}}, )" + between) == 9);
    CHECK(degrees(R"({"kind": {"hinge": {}}, )" + between) == 7);
    CHECK(degrees(R"({"kind": {"fixed": {}}, )" + between) == 6);
    CHECK(degrees(R"({"kind": {"hinge": {}}, )" + between + R"(, {"kind": {"fixed": {}}, "b": "a", "anchor": [0, 0, 0]})") == 1);
    CHECK(degrees(R"({"kind": {"hinge": {}}, )" + between + ", " + R"({"kind": {"hinge": {}}, )" + between) ==
          2);  // a loop: 12 - 10
    const Outcome none = run_scree("info '" + (place / "none.urdf").string() + "'");
    CHECK(none.status == 2);
    CHECK(says(none.errors, "none.urdf"));
    CHECK(run_scree("info").status == 2);
    CHECK(run_scree("info stack --jsn").status == 2);
    const std::string help = run_scree("info --help").output;
    CHECK(says(help, "--json"));
}
