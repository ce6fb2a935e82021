// The suite itself: claims, recorder, scripts, selection of scenes, the table and the JSON report.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/program/exit_status.h"
#include "demos/suite/common_checks.h"
#include "demos/suite/recorder.h"
#include "demos/suite/selection.h"
#include "demos/suite/suite.h"

using namespace scree;
using demos::Claim;
using demos::Promise;
using demos::Trace;

namespace {

const double no_number = std::numeric_limits<double>::quiet_NaN();

demos::Measure value(double measured) {
    return [measured](const Trace&) { return measured; };
}

bool passes(const Claim& claim) {
    return claim(Trace()).pass;
}

Scene falling_ball() {
    Scene scene;
    Body ball;
    ball.shape = Sphere{0.5f};
    ball.position = {0, 100, 0};
    scene.bodies.push_back(ball);
    return scene;
}

std::vector<std::string> names_of(const std::vector<const demos::Demo*>& chosen) {
    std::vector<std::string> names;
    for (const demos::Demo* demo : chosen) names.emplace_back(demo->name);
    return names;
}

demos::DemoScene doomed(const demos::DemoOptions&) {
    const Claim hovers = demos::at_most("height lost", 0.1, "m", "at the end",
                                        [](const Trace& trace) { return trace.start[0].position.y - trace.end[0].position.y; });
    return {falling_ball(), {}, vec3(-1), vec3(1), 1, Promise(hovers, demos::drift_below(1000))};
}

const demos::Demo doomed_demo = {"doomed", "a ball that shall hover falls", 1, false, doomed, true};

Trace with_energies(const std::vector<double>& energies) {
    Trace trace;
    for (const double energy : energies) {
        trace.samples.emplace_back();
        trace.samples.back().statistics.potential_energy = energy;
    }
    return trace;
}

}  // namespace

TEST_CASE("suite: a claim holds within its limits and at them, and a value that is no number misses") {
    CHECK(passes(demos::at_most("a", 2, "m", "", value(2))));
    CHECK_FALSE(passes(demos::at_most("a", 2, "m", "", value(2.001))));
    CHECK(passes(demos::at_least("a", 2, "m", "", value(2))));
    CHECK_FALSE(passes(demos::at_least("a", 2, "m", "", value(1.999))));
    CHECK(passes(demos::between("a", 5, 25, "degrees", "", value(16))));
    CHECK_FALSE(passes(demos::between("a", 5, 25, "degrees", "", value(4.9))));
    CHECK_FALSE(passes(demos::between("a", 5, 25, "degrees", "", value(25.1))));
    CHECK(passes(demos::close_to("a", 10, 0.1, "", "", value(9.95))));
    CHECK_FALSE(passes(demos::close_to("a", 10, 0.1, "", "", value(10.2))));
    for (const Claim& claim :
         {demos::at_most("a", 2, "", "", value(no_number)), demos::at_least("a", 2, "", "", value(no_number)),
          demos::close_to("a", 2, 1, "", "", value(no_number))})
        CHECK_FALSE(passes(claim));
    const demos::Row row = demos::between("slant", 5, 25, "degrees", "", value(16.25))(Trace());
    CHECK(row.promised == "5 to 25 degrees");
    CHECK(row.measured == "16.25 degrees");
    CHECK(row.value == 16.25);
}

TEST_CASE("suite: energy that rises misses, however much was lost before") {
    CHECK(demos::energy_never_rises(0.01)(with_energies({100, 60, 40, 40.5, 0})).pass);
    CHECK_FALSE(demos::energy_never_rises(0.01)(with_energies({100, 60, 40, 42, 0})).pass);
    CHECK_FALSE(demos::energy_never_rises(0.01)(with_energies({100, 40, 40.6, 41.2, 0})).pass);  // rises in small steps
    CHECK_FALSE(demos::energy_never_rises(0.01)(with_energies({100, no_number, 0})).pass);
    CHECK_FALSE(demos::energy_never_rises(0.01)(Trace()).pass);  // no samples
}

TEST_CASE("suite: the cost of a span is its middle step's, and times are found among the samples") {
    Trace trace;
    trace.rate = 10;
    for (int i = 0; i < 40; ++i) trace.step_seconds.push_back(i < 20 ? 1.0f : 0.1f);
    trace.step_seconds[5] = 1000;  // one slow step does not change the median
    CHECK(demos::median_step(trace, 0, 2) == Approx(1));
    CHECK(demos::median_step(trace, 2, 4) == Approx(0.1));
    CHECK(std::isnan(demos::median_step(trace, 9, 10)));
    for (int i = 0; i <= 40; ++i) {
        trace.samples.push_back({0.1 * i, {}});
        trace.samples.back().statistics.max_speed = 4 - 0.1 * i;
    }
    const auto slow = [](const Statistics& now) { return now.max_speed < 2.05; };
    CHECK(demos::first_time(trace, 0, slow) == Approx(2));
    CHECK(demos::first_time(trace, 3, slow) == Approx(3));
    CHECK(std::isnan(demos::first_time(trace, 0, [](const Statistics& now) { return now.max_speed > 9; })));
    CHECK(demos::sample_at(trace, 1.234).time == Approx(1.2));
}

TEST_CASE("suite: a recorder looks when the promise asks, and no more often") {
    World world(falling_ball(), {}, 1);
    const Promise promise = Promise(demos::drift_below(1000))
                                .watching({0}, {30, 0.5})
                                .sampling(2)
                                .sampling({demos::every_step, 0.9, 1})
                                .keeping({0.25, 0.75});
    demos::Recorder recorder(world, promise, 1);
    for (int i = 0; i < 60; ++i) CHECK(recorder.step() > 0);
    const Trace trace = recorder.finish();
    CHECK(trace.step_seconds.size() == 60);
    CHECK(trace.moments.size() == 16);  // every other step from 30 to 60
    CHECK(trace.moments.front().time == Approx(0.5));
    CHECK(trace.samples.size() == 2 + 7);  // steps 0, 30; 54 to 60
    REQUIRE(trace.snapshots.size() == 2);
    CHECK(demos::snapshot_at(trace, 0.7).time == Approx(0.75));
    const double fallen = 0.5 * 9.81 * (0.75 * 0.75 - 0.25 * 0.25);
    CHECK(demos::greatest_way(trace, trace.snapshots[0], trace.snapshots[1]) == Approx(fallen).epsilon(0.01));
    CHECK(trace.start[0].position.y == 100);
    CHECK(trace.end[0].position.y < 96);
}

TEST_CASE("suite: a script strikes once, at its time, whatever the rate") {
    for (const float rate : {60.0f, 50.0f}) {
        Settings settings;
        settings.rate = rate;
        World world(falling_ball(), settings, 1);
        int strikes = 0;
        const Promise promise(demos::drift_below(1000));
        demos::Recorder recorder(world, promise, 1, [&strikes](World& struck) {
            if (!demos::is_due(struck, 0.5)) return;
            ++strikes;
            struck.set_velocity(0, {7, 0, 0}, vec3(0));
        });
        const int half = static_cast<int>(rate) / 2;
        for (int i = 0; i < half; ++i) recorder.step();
        CHECK(strikes == 0);
        for (int i = 0; i < half; ++i) recorder.step();
        CHECK(strikes == 1);
        CHECK(world.bodies()[0].position.x == Approx(3.5).epsilon(0.01));
    }
}

TEST_CASE("suite: scenes are chosen by name, beginning and pattern, each once") {
    CHECK(names_of(demos::select_demos({"stack"})) == std::vector<std::string>{"stack"});
    CHECK(names_of(demos::select_demos({"stack?0", "tower"})) == std::vector<std::string>{"stack20", "stack80", "tower"});
    CHECK(names_of(demos::select_demos({"pyr", "pyramid"})) == std::vector<std::string>{"pyramid", "pyramid100"});
    CHECK(names_of(demos::select_demos({"*1m"})) == std::vector<std::string>{"pile1m", "mix1m", "hulls1m"});
    CHECK(demos::select_demos({}).size() == demos::all_demos().size());
    CHECK_THROWS_AS(demos::select_demos({"nosuch*"}), demos::UsageError);
    CHECK_THROWS_AS(demos::select_demos({"rest", ""}), demos::UsageError);
    CHECK_THROWS_WITH(demos::select_demos({"pyramit"}), Catch::Contains("nearest: \"pyramid\""));
    CHECK_THROWS_WITH(demos::select_demos({"scene.json"}), Catch::Contains("no promise"));
}

TEST_CASE("suite: a broken promise is counted, marked and reported, with the hash of the state") {
    const demos::Outcome fell = run_trial(doomed_demo, {}, make_reference_runner(1));
    const demos::Outcome rested = run_trial(*demos::find_demo("rest"), {}, make_reference_runner(1));
    REQUIRE(fell.rows.size() == 4);
    CHECK_FALSE(fell.rows[0].pass);
    CHECK(fell.rows[0].value == Approx(0.5 * 9.81).epsilon(0.02));
    CHECK(fell.rows[1].pass);
    const std::vector<demos::Outcome> outcomes = {rested, fell};
    const demos::Kept count = demos::count_kept(outcomes);
    CHECK(count.of == rested.rows.size() + 4);
    CHECK(count.kept == count.of - 1);

    World world(falling_ball(), {}, 1);
    world.step(60);
    CHECK(fell.state_hash == world.state_hash());
    CHECK(fell.steps == 60);
    const std::string table = demos::table_of(outcomes);
    CHECK(table.find("MISS") != table.npos);
    CHECK(table.find("at most 0.1 m") != table.npos);

    const auto json = nlohmann::json::parse(demos::json_of(outcomes, "cpu", "1 thread"));
    CHECK(json["kept"] == count.kept);
    CHECK(json["of"] == count.of);
    CHECK(json["backend"] == "cpu");
    const auto& scene = json["scenes"][1];
    CHECK(scene["scene"] == "doomed");
    CHECK(scene["pass"] == false);
    CHECK(json["scenes"][0]["pass"] == true);
    CHECK(scene["state_hash"].get<std::string>().size() == 16);
    CHECK(scene["wall_seconds"].get<double>() > 0);
    const auto& promise = scene["promises"][0];
    CHECK(promise["promise"] == "height lost");
    CHECK(promise["high"] == 0.1);
    CHECK(promise["low"].is_null());
    CHECK(promise["measured"].get<double>() == Approx(fell.rows[0].value));
    CHECK(promise["pass"] == false);
}

TEST_CASE("suite: a run that shall end has no verdict") {
    long seen = 0;
    const demos::Outcome cut = run_trial(doomed_demo, {}, make_reference_runner(1), [&seen](long steps, long all) {
        CHECK(all == 60);
        seen = steps;
        return steps < 10;
    });
    CHECK(seen == 10);
    CHECK(cut.steps == 10);
    CHECK(cut.rows.empty());
}

TEST_CASE("suite: every promise says what it limits and how that is measured") {
    for (const demos::Demo& demo : demos::all_demos()) {
        const demos::DemoScene scene = demos::build(demo, {demo.takes_bodies ? std::size_t{50} : std::size_t{0}, 1});
        for (const Claim& claim : scene.promise.claims()) {
            INFO(demo.name << ": " << claim.what);
            CHECK_FALSE(claim.what.empty());
            CHECK_FALSE(claim.promised.empty());
            CHECK_FALSE(claim.how.empty());
            CHECK(claim.low <= claim.high);
        }
    }
    CHECK(demos::suite_size(*demos::find_demo("pile")).bodies == 500);
    CHECK(demos::suite_size(*demos::find_demo("pile1m")).bodies == 10000);
}

TEST_CASE("demos of any number of bodies have as many dynamic ones as they are asked for") {
    for (const char* name : {"pile", "mix", "assortment", "avalanche", "terrain", "mesh", "calm", "mix1m", "hulls1m", "overlap",
                             "hopper", "ballast", "drum"}) {
        const demos::DemoScene built = demos::build(*demos::find_demo(name), {.bodies = 23});
        INFO(name);
        CHECK(std::ranges::count_if(built.scene.bodies, [](const Body& b) { return b.motion == Motion::dynamic; }) == 23);
    }
}
