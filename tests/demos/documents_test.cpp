// Generated documents: the table of promises in tests/README.md is current.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "demos/suite/selection.h"
#include "demos/suite/suite.h"

TEST_CASE("the table of promises in tests/README.md is what the program prints", "[demos]") {
    std::ostringstream readme;
    readme << std::ifstream(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/README.md").rdbuf();
    const std::string table = scree::demos::promises_as_markdown(scree::demos::select_demos({}));
    REQUIRE(table.find("| stack |") != std::string::npos);
    INFO("write the output of `scree check --list --markdown` into tests/README.md, behind the line <!-- promises -->");
    const std::string mark = "<!-- promises -->\n";
    const std::string text = readme.str();
    REQUIRE(text.find(mark) != std::string::npos);
    REQUIRE(text.substr(text.find(mark) + mark.size()) == "\n" + table);
}
