// Generated documents: the tables of promises and experiments in tests/README.md are current.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "demos/program/report.h"
#include "demos/suite/selection.h"
#include "demos/suite/suite.h"
#include "demos/validate/experiment.h"

namespace {

std::string tests_readme() {
    std::ostringstream readme;
    readme << std::ifstream(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/README.md").rdbuf();
    return readme.str();
}

}  // namespace

TEST_CASE("the table of promises in tests/README.md is what the program prints", "[demos]") {
    const std::string table = scree::demos::promises_as_markdown(scree::demos::select_demos({}));
    REQUIRE(table.find("| stack |") != std::string::npos);
    INFO("write the output of `scree check --list --markdown` into tests/README.md, behind the line <!-- promises -->");
    const std::string mark = "<!-- promises -->\n";
    const std::string text = tests_readme();
    REQUIRE(text.find(mark) != std::string::npos);
    REQUIRE(text.substr(text.find(mark) + mark.size()) == "\n" + table);
}

TEST_CASE("the table of experiments in tests/README.md is what the program prints", "[demos]") {
    const std::string table = scree::demos::experiments_as_markdown(scree::demos::all_experiments());
    REQUIRE(table.find("| pendulum |") != std::string::npos);
    INFO("write the output of `scree validate --list` into tests/README.md, behind the line <!-- experiments -->");
    REQUIRE(tests_readme().find("<!-- experiments -->\n\n" + table + "\n<!-- end of experiments -->\n") != std::string::npos);
}

TEST_CASE("demos/README.md tells what every key of a report means", "[demos]") {
    std::ostringstream readme;
    readme << std::ifstream(std::filesystem::path(SCREE_SOURCE_DIR) / "demos/README.md").rdbuf();
    const std::string text = readme.str();
    const nlohmann::json report = nlohmann::json::parse(scree::demos::json_of({}));
    for (const auto& [key, value] : report.items()) {
        INFO(key);
        CHECK(text.find("`" + key + "`") != std::string::npos);
    }
}
