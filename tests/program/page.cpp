// scree run --html: a page beside other outputs, whole or not at all, and refusals.
#include <catch2/catch.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

const std::string brief = "run pile --bodies 20 --backend cpu --quiet ";

// Programs that were built without esbuild say so, and have nothing else to test here.
bool is_without_viewer(const Place& place) {
    const Outcome run = run_scree(brief + "--steps 1 --html " + (place / "try.html").string());
    if (run.status == 0) return false;
    INFO(run.errors);
    REQUIRE(run.status == 2);
    REQUIRE(says(run.errors, "install esbuild"));
    REQUIRE(std::filesystem::is_empty(place.path()));
    WARN("built without esbuild");
    return true;
}

std::string without_extremes(const std::string& report) {
    const std::size_t at = report.find("\"state_hash\"");
    return at == std::string::npos ? "" : report.substr(at, 40);
}

}  // namespace

TEST_CASE("program: a page is written beside other outputs, and changes no bit") {
    const Place place;
    if (is_without_viewer(place)) return;
    const std::string at = place.path().string();
    const Outcome alone = run_scree(brief + "--steps 60 --report -");
    const Outcome run = run_scree(brief + "--steps 60 --report - --html '" + at + "/a.html' --frames '" + at +
                                  "/f' --size 64x48 --trajectory '" + at + "/t.csv' --color speed --fps 20");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    CHECK(without_extremes(alone.output) == without_extremes(run.output));
    CHECK(!without_extremes(run.output).empty());
    const std::string page = place.read("a.html");
    CHECK(page.starts_with("<!doctype html>"));
    CHECK(page.ends_with("</html>\n"));
    CHECK(says(page, "<title>pile · scree</title>"));
    CHECK(says(page, "data-frames=\"21\""));
    CHECK(std::filesystem::exists(place / "f/frame_000020.png"));
    CHECK(!says(page, "://"));
}

TEST_CASE("program: pages are refused before a run where they cannot be") {
    const Place place;
    const std::string at = place.path().string();
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        const Outcome run = run_scree(brief + "--steps 1 " + arguments);
        INFO(arguments << "\n" << run.errors);
        CHECK(run.status == 2);
        CHECK(says(run.errors, words));
    };
    refused("--html ''", "--html: the name is empty");
    refused("--html '" + at + "/none/a.html'", "there is no folder");
    refused("--html '" + at + "'", "is a folder");
    refused("--html '" + at + "/a' --report '" + at + "/a'", "--html and --report");
    refused("--html '" + at + "/a' --size 64x48", "--size: no pictures are asked for");
    refused("--html '" + at + "/a' --fps 100", "more pictures than steps");
    refused("--color speed", "or --html");
    CHECK(std::filesystem::is_empty(place.path()));
}

TEST_CASE("program: a page that may not grow is a failure of the work, and nothing half written is left") {
    const Place place;
    if (is_without_viewer(place)) return;
    std::filesystem::remove(place / "try.html");
    const Outcome run = run_scree(brief + "--steps 60 --html '" + place.path().string() + "/a.html'", "ulimit -f 8;");
    INFO(run.errors);
    CHECK(run.status == 1);
    CHECK(says(run.errors, "File too large"));
    CHECK(std::filesystem::is_empty(place.path()));
}
