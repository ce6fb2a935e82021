// scree run --trace: slices nest, stages have the names of the report, and all together last as long as the run.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

struct Slice {
    std::string name;
    double begin, end;  // us
};
using Tracks = std::map<std::pair<int, int>, std::vector<Slice>>;  // by process and thread, in the order of time

Tracks tracks_of(const json& trace) {
    Tracks tracks;
    for (const json& event : trace.at("traceEvents"))
        if (event.at("ph") == "X") {
            REQUIRE(event.at("dur") >= 0);
            const double begin = event.at("ts");
            tracks[{event.at("pid"), event.at("tid")}].push_back(
                {event.at("name"), begin, begin + event.at("dur").get<double>()});
        }
    for (auto& [track, slices] : tracks)
        std::stable_sort(slices.begin(), slices.end(),
                         [](const Slice& a, const Slice& b) { return a.begin != b.begin ? a.begin < b.begin : a.end > b.end; });
    return tracks;
}

// Requires that slices nest or follow one another; returns the sum of the outermost, us.
double outermost(const std::vector<Slice>& slices) {
    constexpr double rounding = 0.0021;  // us: of begin and duration
    std::vector<Slice> open;
    double sum = 0;
    for (const Slice& slice : slices) {
        while (!open.empty() && open.back().end <= slice.begin + rounding) open.pop_back();
        INFO(slice.name << " in " << (open.empty() ? "nothing" : open.back().name));
        if (open.empty())
            sum += slice.end - slice.begin;
        else
            REQUIRE(slice.end <= open.back().end + rounding);
        open.push_back(slice);
    }
    return sum;
}

double sum_of(const std::vector<Slice>& slices, const std::string& name) {
    double sum = 0;
    for (const Slice& slice : slices) sum += slice.name == name ? slice.end - slice.begin : 0;
    return sum;
}

std::size_t count_of(const std::vector<Slice>& slices, const std::string& name) {
    return static_cast<std::size_t>(
        std::count_if(slices.begin(), slices.end(), [&](const Slice& slice) { return slice.name == name; }));
}

json traced(const Place& place, const std::string& options) {
    const Outcome run = run_scree("run " + options + " --trace " + (place / "trace.json").string() + " --report " +
                                  (place / "report.json").string());
    INFO(run.errors);
    REQUIRE(run.status == 0);
    return json::parse(place.read("trace.json"));
}

}  // namespace

TEST_CASE("program: a timeline's slices nest, have the stages' names and last as long as the run", "[program]") {
    const Place place;
    const json trace = traced(place, "pile --bodies 600 --steps 40 --backend cpu --threads 2");
    const json report = json::parse(place.read("report.json"));
    const Tracks tracks = tracks_of(trace);
    const std::vector<Slice>& main = tracks.at({0, 0});
    const double wall = 1e6 * report.at("seconds_total").get<double>(), slices = outermost(main);
    CHECK(slices < 1.001 * wall);
    CHECK(slices > 0.9 * wall);
    CHECK(count_of(main, "step") == 40);
    for (const auto& [stage, ms] : report.at("stages").items()) {
        INFO(stage);
        CHECK(count_of(main, stage) >= 40);
        CHECK(sum_of(main, stage) / 40e3 >= 0.99 * ms.get<double>() - 1e-3);  // with the slices of thread 0 in it
    }
    REQUIRE(tracks.contains({0, 1}));  // the second thread
    outermost(tracks.at({0, 1}));
    std::set<std::string> counters;
    for (const json& event : trace.at("traceEvents"))
        if (event.at("ph") == "C") counters.insert(event.at("name").get<std::string>());
    CHECK(counters == std::set<std::string>{"contacts", "pairs"});
}

TEST_CASE("program: a timeline tells of buffers that grow, and has the stages of some steps alone if asked", "[program]") {
    const Place place;
    const json trace = traced(place, "glass --steps 120 --backend cpu --threads 1 --trace-every 50");
    const Tracks tracks = tracks_of(trace);
    const std::vector<Slice>& main = tracks.at({0, 0});
    outermost(main);
    CHECK(count_of(main, "step") == 120);
    const auto grown = count_of(main, "grow buffers");
    CHECK(grown > 0);
    CHECK(count_of(main, "end_step") >= 3);  // one that is redone is there twice
    CHECK(count_of(main, "end_step") <= 3 + grown);
    const std::string text = trace.dump();
    CHECK(says(text, "bodies broke"));
}

TEST_CASE("program: a device's queue has its stages within the steps that waited for them", "[program][vulkan]") {
    const Place place;
    REQUIRE(run_scree("export pile --bodies 200 -o " + (place / "scene.json").string()).status == 0);
    // A scene without a promise: steps are submitted two at a time.
    const Tracks tracks = tracks_of(traced(place, (place / "scene.json").string() + " --steps 20 --backend vulkan"));
    REQUIRE(tracks.contains({1, 1 << 16}));
    const std::vector<Slice>&queue = tracks.at({1, 1 << 16}), &main = tracks.at({0, 0});
    outermost(main);
    const double busy = outermost(queue);
    CHECK(count_of(queue, "step") >= 20);  // one that is redone is there twice
    CHECK(count_of(queue, "end_step") >= 20);
    CHECK(busy <= sum_of(main, "step"));
    CHECK(busy >= 0.3 * sum_of(main, "step"));
    CHECK(count_of(main, "wait for the device") >= 20);
}

TEST_CASE("program: timelines that mean nothing are refused", "[program]") {
    const Place place;
    for (const std::string options : {"--trace ''", "--trace-every 3", "--trace trace.txt"}) {
        INFO(options);
        const Outcome run = run_scree("run rest --steps 1 --backend cpu " + options);
        CHECK(run.status == 2);
        CHECK(says(run.errors, "--trace"));
    }
    CHECK(run_scree("run rest --steps 1 --backend cpu --trace " + (place / "no" / "t.json").string()).status == 2);
}
