// scree validate granular: small cases agree with theory, verdicts and spreads are right, reports hold what was measured.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compute/runner.h"
#include "demos/validate/granular/granular.h"
#include "tests/house/pages.h"

using namespace scree;
using namespace scree::demos;

namespace {

GranularLab lab_of(std::size_t bodies, std::uint64_t seeds, std::function<bool()> go_on = {}) {
    GranularOptions options;
    options.bodies = bodies;
    options.seeds = seeds;
    return GranularLab([] { return make_reference_runner(1); }, options, std::move(go_on));
}

const GranularCase& case_called(const std::vector<GranularCase>& all, const std::string& name) {
    return *std::find_if(all.begin(), all.end(), [&](const GranularCase& granular) { return granular.name == name; });
}

GranularCase measured_as(std::vector<double> values) {
    GranularCase made{.name = "made", .title = "a < b", .source = "", .setup = "", .figures = {{"length, m", "2", 1.9, 2.1}}};
    made.measure = [values](const GranularLab&, std::uint64_t seed) {
        const double value = values.at(seed - 1);
        return GranularMeasured{{value}, {{"measured", {{1, value}, {2, 2 * value}}}}};
    };
    return made;
}

// The cells of a row of a Markdown table.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line.substr(1));
    for (std::string cell; std::getline(text, cell, '|');) {
        cell.erase(0, cell.find_first_not_of(' '));
        cell.erase(cell.find_last_not_of(' ') + 1);
        cells.push_back(cell);
    }
    return cells;
}

}  // namespace

TEST_CASE("a small column of grains bears its weight, with every seed", "[demos]") {
    const std::vector<GranularCase> all = all_granular_cases();
    const GranularResult result = validate(case_called(all, "column"), lab_of(200, 2));
    INFO(granular_table({result}, false));
    REQUIRE(result.seeds.size() == 2);
    CHECK(result.seeds[0].figures != result.seeds[1].figures);
    CHECK(std::abs(result.mean(0) - 1) < 0.04);  // a layer at the floor and one on top count in so low a column
    CHECK(result.pass(1));
    CHECK(result.pass(2));
}

TEST_CASE("the walls of a small silo bear most of its grains", "[demos]") {
    const std::vector<GranularCase> all = all_granular_cases();
    const GranularResult result = validate(case_called(all, "janssen"), lab_of(300, 1));
    INFO(granular_table({result}, false));
    CHECK(std::abs(result.mean(0) - 1) < 0.2);
    const PlotSeries& stress = result.seeds[0].points[0];
    REQUIRE(stress.points.size() > 10);
    // Ten layers down it is less than half of what it would be without friction.
    for (const PlotPoint& point : stress.points)
        if (point.x > 10) CHECK(point.y < 0.5 * point.x);
}

TEST_CASE("a small triaxial cell holds its stress, and stones bear more than balls", "[demos]") {
    const std::vector<GranularCase> all = all_granular_cases();
    const GranularResult result = validate(case_called(all, "triaxial"), lab_of(64, 1));
    INFO(granular_table({result}, false));
    CHECK(result.mean(0) < 2);
    CHECK(result.mean(2) > result.mean(1) + 4);
}

TEST_CASE("a figure's mean over seeds must lie in its range, and must be a number", "[demos]") {
    const auto result_of = [](const GranularCase& made, std::uint64_t seeds) { return validate(made, lab_of(0, seeds)); };
    const GranularCase near = measured_as({1.8, 2.0, 2.2}), far = measured_as({2.0, 2.3}), none = measured_as({2.0, NAN});
    const GranularResult three = result_of(near, 3);
    CHECK(three.pass());
    CHECK(three.mean(0) == Approx(2));
    CHECK(three.spread(0) == Approx(0.2));
    CHECK(three.plot().points.at(0).points.at(1).y == Approx(4));
    CHECK(three.plot().points.at(0).points.at(1).bar == Approx(0.4));
    CHECK(result_of(near, 1).spread(0) == 0);
    CHECK_FALSE(result_of(near, 1).pass());
    CHECK_FALSE(result_of(far, 2).pass());
    CHECK_FALSE(result_of(none, 2).pass());
}

TEST_CASE("a granular case stops when it is told to", "[demos]") {
    const std::vector<GranularCase> all = all_granular_cases();
    int steps = 0;
    CHECK_THROWS_AS(validate(case_called(all, "column"), lab_of(100, 1, [&] { return ++steps < 4; })), Stopped);
    CHECK(steps == 4);
}

TEST_CASE("reports of granular validations hold figures, spreads and verdicts", "[demos]") {
    const GranularCase made = measured_as({NAN, 1});
    const std::vector<GranularResult> all = {validate(made, lab_of(0, 2))};
    const auto json = nlohmann::json::parse(granular_json(all, "cpu", "test"));
    const auto& figure = json.at("cases").at(0).at("figures").at(0);
    CHECK(figure.at("seeds").at(0).is_null());
    CHECK(figure.at("seeds").at(1) == 1);
    CHECK(figure.at("pass") == false);
    const std::string page = granular_page(all, "a & b");
    CHECK(page.find("a &amp; b") != std::string::npos);
    CHECK(page.find("a &lt; b") != std::string::npos);
    CHECK(page.find("class='miss'") != std::string::npos);
    const std::string svg = page.substr(page.find("<svg"), page.find("</svg>") - page.find("<svg"));
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(granular_table(all, true).find("| made | length, m | 2 | 1.9 to 2.1 |") != std::string::npos);
}

TEST_CASE("the granular tables in the book are what the program prints, and their verdicts are right", "[demos]") {
    const std::string text = house::text_of("demos/docs/evidence/granular.md");
    const std::vector<GranularCase> all = all_granular_cases();
    INFO(
        "write the output of `scree validate granular --list --markdown` into demos/docs/evidence/granular.md, behind the line "
        "<!-- cases -->, and that of `scree validate granular --markdown` behind <!-- figures -->");
    CHECK(text.find("<!-- cases -->\n\n" + granular_list(all, true) + "\n<!-- end of cases -->\n") != std::string::npos);
    const std::string mark = "<!-- figures -->\n\n";
    REQUIRE(text.find(mark) != std::string::npos);
    std::istringstream lines(text.substr(text.find(mark) + mark.size()));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    for (const GranularCase& granular : all) {
        CHECK(text.find("granular/" + granular.name + ".svg") != std::string::npos);
        for (const GranularFigure& figure : granular.figures) {
            REQUIRE(std::getline(lines, line));
            INFO(line);
            const std::vector<std::string> cells = cells_of(line);
            REQUIRE(cells.size() == 6);
            // What is published and accepted is as the program has it.
            const GranularCase one{.name = granular.name, .title = "", .source = "", .setup = "", .figures = {figure}};
            const double mean = std::stod(cells[4]);
            const GranularResult result{&one, {{{mean}}}};
            const std::string row = granular_table({result}, true);
            const std::vector<std::string> now = cells_of(row.substr(row.rfind("\n|") + 1));
            for (std::size_t k : {0u, 1u, 2u, 3u, 5u}) CHECK(cells[k] == now[k]);
        }
    }
    std::getline(lines, line);
    CHECK(line.empty());
}
