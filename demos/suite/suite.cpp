// The stability suite: running and reporting.
#include "demos/suite/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "demos/program/outputs/report.h"
#include "demos/program/outputs/table.h"
#include "demos/program/progress.h"
#include "demos/suite/recorder.h"

namespace scree::demos {

namespace {

constexpr std::size_t small = 500;  // bodies; with more, the gallery's demos would take most of the suite's time

nlohmann::ordered_json json_of(const Row& row) {
    const auto limit = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr; };
    return {{"promise", row.what}, {"limit", row.promised},        {"low", limit(row.low)}, {"high", limit(row.high)},
            {"unit", row.unit},    {"measured", limit(row.value)}, {"pass", row.pass},      {"reason", row.reason}};
}

}  // namespace

DemoOptions suite_size(const Demo& demo) {
    DemoOptions options;
    options.bodies = demo.takes_bodies && !demo.trial ? std::min(demo.bodies, small) : demo.bodies;
    return options;
}

Outcome run_trial(const Demo& demo, DemoOptions options, std::unique_ptr<Runner> runner,
                  const std::function<bool(long, long)>& progress, Settings settings,
                  const std::function<void(World&)>& prepare) {
    const auto start = std::chrono::steady_clock::now();
    const DemoScene scene = build(demo, options);
    settings.sleeping = scene.sleeping;
    World world(scene.scene, settings, std::move(runner));
    if (prepare) prepare(world);
    Recorder recorder(world, scene.promise, static_cast<double>(scene.seconds), scene.before_step);
    const long steps = std::max(1L, std::lround(static_cast<double>(scene.seconds) * static_cast<double>(settings.rate)));
    bool whole = true;
    for (long i = 0; i < steps && whole; ++i) {
        recorder.step();
        whole = !progress || progress(i + 1, steps);
    }
    Outcome outcome{demo.name, scene.scene.bodies.size(), world.steps(), world.time(), 0, world.state_hash(), {}};
    if (whole) outcome.rows = scene.promise.judge(recorder.finish());
    outcome.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

Kept count_kept(const std::vector<Outcome>& outcomes) {
    Kept count;
    for (const Outcome& outcome : outcomes) {
        count.of += outcome.rows.size();
        count.kept += static_cast<std::size_t>(
            std::count_if(outcome.rows.begin(), outcome.rows.end(), [](const Row& row) { return row.pass; }));
    }
    return count;
}

std::string table_of(const std::vector<Outcome>& outcomes) {
    std::vector<Cells> rows = {verdict_heading({"scene"})};
    for (const char* word : {"wall time", "state hash"}) rows[0].emplace_back(word);
    for (const Outcome& outcome : outcomes) {
        bool first = true;
        for (const Row& row : outcome.rows) {
            Cells cells = verdict(row, {outcome.scene});
            cells.push_back(first ? duration(outcome.wall) : "");
            cells.push_back(first ? hash_text(outcome.state_hash) : "");
            rows.push_back(std::move(cells));
            first = false;
        }
    }
    return table(rows);
}

std::string json_of(const std::vector<Outcome>& outcomes, const std::string& backend, const std::string& device) {
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    for (const Outcome& outcome : outcomes) {
        nlohmann::ordered_json promises = nlohmann::ordered_json::array();
        for (const Row& row : outcome.rows) promises.push_back(json_of(row));
        scenes.push_back({{"scene", outcome.scene},
                          {"bodies", outcome.bodies},
                          {"steps", outcome.steps},
                          {"seconds", outcome.simulated},
                          {"wall_seconds", outcome.wall},
                          {"state_hash", hash_text(outcome.state_hash)},
                          {"pass", all_pass(outcome.rows)},
                          {"promises", promises}});
    }
    const Kept count = count_kept(outcomes);
    const nlohmann::ordered_json json = {
        {"backend", backend}, {"device", device}, {"kept", count.kept}, {"of", count.of}, {"scenes", scenes}};
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

namespace {

std::vector<Cells> promise_rows(const std::vector<const Demo*>& demos) {
    std::vector<Cells> rows = {{"scene", "promise", "limit", "how it is measured", "why more than twice the measured"}};
    for (const Demo* demo : demos) {
        const DemoScene scene = build(*demo, suite_size(*demo));
        for (const Claim& claim : scene.promise.claims())
            rows.push_back({demo->name, claim.what, claim.promised, claim.how, claim.reason});
    }
    for (const Claim& claim : soundness()) rows.push_back({"(every)", claim.what, claim.promised, claim.how, claim.reason});
    return rows;
}

}  // namespace

std::string promises_of(const std::vector<const Demo*>& demos) {
    return table(promise_rows(demos));
}

std::string promises_as_markdown(const std::vector<const Demo*>& demos) {
    return markdown(promise_rows(demos));
}

}  // namespace scree::demos
