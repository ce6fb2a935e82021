// scree sweep: combinations, one table, resuming, failures, shards.
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

const std::string slope = R"({"bodies": [
    {"name": "floor", "motion": "fixed", "shape": {"plane": {}}},
    {"name": "puck", "shape": {"box": {"half_extents": [0.2, 0.1, 0.2]}}, "position": [0, 0.1, 0], "velocity": [2, 0, 0]}]})";

// The rows of a table without failures, each by its column: no cell has a comma.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& table) {
    std::istringstream lines(table);
    std::vector<std::string> heading;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        std::vector<std::string> cells{""};
        for (const char c : line)
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        if (heading.empty()) {
            heading = cells;
            continue;
        }
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i) row[heading.at(i)] = cells[i];
    }
    return rows;
}

}  // namespace

TEST_CASE("program: a sweep runs all combinations into one table, and goes on where it was") {
    const Place place;
    const std::string scene = place.write("scene.json", slope), table = (place / "results.csv").string();
    const std::string command =
        "sweep " + scene + " --set bodies/puck/friction=0.1:0.5:3 --set substeps=4,8 --steps 30 -o " + table;
    const Outcome first = run_scree(command);
    INFO(first.errors);
    REQUIRE(first.status == 0);
    CHECK(says(first.errors, "6 of 6 runs done"));
    const auto rows = rows_of(place.read("results.csv"));
    REQUIRE(rows.size() == 6);
    CHECK(rows[3].at("bodies/puck/friction") == "0.3");
    CHECK(rows[3].at("substeps") == "8");
    CHECK(rows[3].at("steps") == "30");
    CHECK(std::stod(rows[0].at("max_speed")) > std::stod(rows[4].at("max_speed")));  // less friction, faster
    // Each row is what the program alone gives.
    const Outcome alone =
        run_scree("run " + scene + " --backend cpu --steps 30 --substeps 8 --set bodies/puck/friction=0.3 --quiet --report -");
    CHECK(nlohmann::json::parse(alone.output).at("state_hash") == rows[3].at("state_hash"));
    // As if it had been interrupted after four.
    std::filesystem::remove(place / "results.csv.runs/run-000001.json");
    std::filesystem::remove(place / "results.csv.runs/run-000005.json");
    const Outcome again = run_scree(command);
    CHECK(says(again.errors, "4 of 6 runs are done already"));
    CHECK(rows_of(place.read("results.csv"))[5].at("state_hash") == rows[5].at("state_hash"));
    const Outcome other = run_scree("sweep " + scene + " --set substeps=4,8 --steps 30 -o " + table);
    CHECK(other.status == 2);
    CHECK(says(other.errors, "has the reports of another sweep; --fresh removes them"));
}

TEST_CASE("program: failed runs of a sweep are told, counted and in the table") {
    const Place place;
    const std::string scene = place.write("scene.json", slope), table = (place / "results.csv").string();
    const Outcome some = run_scree("sweep " + scene + " --set bodies/puck/friction=0.5,-1 --steps 5 -o " + table);
    CHECK(some.status == 1);
    CHECK(says(some.errors, "run 1 failed: "));
    CHECK(says(some.errors, "1 of 2 runs done, 1 failed"));
    CHECK(says(place.read("results.csv"), "/bodies/1/friction: must be between 0 and 100"));
    const auto refused = [&](const std::string& words, const std::string& reason) {
        const Outcome outcome = run_scree("sweep " + words);
        INFO(outcome.errors);
        CHECK(outcome.status == 2);
        CHECK(says(outcome.errors, reason));
    };
    refused(scene + " -o " + table, "nothing varies");
    refused(scene + " --set substeps=4 ", "name the table with -o");
    refused(scene + " --set substeps=4:8 -o " + table, "N is missing");
    refused(scene + " --set substeps=8..4 -o " + table, "A..B counts upwards");
    refused(scene + " --set seed=1..3 -o " + table, "is of demos");
    refused(scene + " --set bodies/puck/frition=1 -o " + table, "nearest: \"friction\"");
    refused(scene + " --set substeps=1..1000 --set rate=10:100:2000 -o " + table, "more than 1000000 runs");
    refused("nothing --set substeps=4 -o " + table, "unknown demo");
}

TEST_CASE("program: shards of a sweep share its runs, and a dry run prints them") {
    const Place place;
    const std::string table = (place / "walls.csv").string();
    const std::string command = "sweep stack --set seed=1..3 --steps 3 -o " + table;
    CHECK(run_scree(command + " --shard 2/2").status == 0);
    CHECK(rows_of(place.read("walls.csv")).size() == 1);
    CHECK(run_scree(command + " --shard 1/2").status == 0);
    const auto rows = rows_of(place.read("walls.csv"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].at("seed") == "1");
    CHECK(rows[0].at("state_hash") != rows[1].at("state_hash"));
    const Outcome dry = run_scree(command + " --dry-run");
    CHECK(says(dry.output, "scree run stack --seed 2 --steps 3 --threads 1 --backend cpu --quiet --report " + table +
                               ".runs/run-000001.json"));
    CHECK(run_scree("sweep stack --set seed=1..3 -o x.csv --shard 3/2").status == 2);
}

TEST_CASE("program: an interrupted sweep leaves whole reports alone, and the same command completes it") {
    const Place place;
    const std::string table = (place / "results.csv").string();
    const std::string command = "sweep pile --bodies 200 --set seed=1..6 --steps 400 -j 2 -o " + table;
    const Outcome cut = run_scree(command, "timeout -s INT 2");
    const bool was_cut = cut.status == 130 || cut.status == 124;
    INFO(cut.errors);
    REQUIRE((was_cut || cut.status == 0));  // a fast machine has finished
    for (const auto& entry : std::filesystem::directory_iterator(place / "results.csv.runs")) {
        const std::string name = entry.path().filename().string();
        CHECK((name == "sweep.json" || name.ends_with(".json")));
        if (name != "sweep.json")
            CHECK_FALSE(nlohmann::json::parse(place.read("results.csv.runs/" + name)).at("interrupted").get<bool>());
    }
    CHECK(run_scree(command).status == 0);
    CHECK(rows_of(place.read("results.csv")).size() == 6);
}
