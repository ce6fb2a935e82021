// Reports of runs.
#include "demos/program/outputs/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "compute/parallel/threads.h"
#include "compute/schema/settings.h"
#include "demos/film/measure_columns.h"
#include "demos/program/outputs/table.h"
#include "demos/program/progress.h"
#include "host/processor.h"

namespace scree::demos {

Spread spread_of(std::vector<double> step_ms) {
    if (step_ms.empty()) return {};
    std::sort(step_ms.begin(), step_ms.end());
    const std::size_t n = step_ms.size();
    const double mean = std::accumulate(step_ms.begin(), step_ms.end(), 0.0) / static_cast<double>(n);
    return {mean, (step_ms[(n - 1) / 2] + step_ms[n / 2]) / 2, step_ms[(n * 95 + 99) / 100 - 1], step_ms.front()};
}

std::string program_version() {
    return SCREE_VERSION;
}
std::string program_compiler() {
#if defined(__clang__)
    return "Clang " __clang_version__;
#else
    return "GCC " __VERSION__;
#endif
}

std::string date_and_time() {
    using namespace std::chrono;
    const auto now = floor<seconds>(system_clock::now());
    const year_month_day day(floor<days>(now));
    const hh_mm_ss time(now - floor<days>(now));
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                       static_cast<unsigned>(day.day()), time.hours().count(), time.minutes().count(), time.seconds().count());
}

namespace {

nlohmann::ordered_json settings_of(const Settings& settings) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    schema::for_each_field<Settings>([&](const auto& field) { json[field.key] = settings.*field.member; });
    return json;
}

double per_body(const RunReport& r, std::size_t bytes) {
    return r.statistics.bodies ? static_cast<double>(bytes) / static_cast<double>(r.statistics.bodies) : 0.0;
}

// Simulated seconds of all copies in a second.
double pace_of(const RunReport& r) {
    const double mean = spread_of(r.step_ms).mean;
    return mean > 0 ? static_cast<double>(r.copies) * 1e3 / (mean * static_cast<double>(r.rate)) : 0;
}

nlohmann::ordered_json ranks_of(const RunReport& r) {
    if (r.ranks.empty()) return {};
    nlohmann::ordered_json sent, messages, waiting, memory;
    for (const RunReport::RankCost& one : r.ranks) {
        sent.push_back(std::llround(one.sent_bytes));
        messages.push_back(one.messages);
        waiting.push_back(one.waiting_ms);
        memory.push_back(one.peak_memory_bytes);
    }
    return {{"count", r.ranks.size()},
            {"sent_bytes_per_step", sent},
            {"messages_per_step", messages},
            {"waiting_ms_per_step", waiting},
            {"peak_memory_bytes", memory}};
}

nlohmann::ordered_json page_of(const RunReport& r) {
    if (r.page_frames == 0) return nullptr;
    return {{"frames", r.page_frames}, {"bytes", r.page_bytes}, {"seconds", r.seconds_encoding_page}};
}

nlohmann::ordered_json grains_of(const RunReport& r) {
    if (!r.grains) return nullptr;
    nlohmann::ordered_json json;
    for (const auto& column : region_columns()) {
        const std::vector<double> values = values_of(column, std::vector{*r.grains});
        json[column.name] = column.width == 1 ? nlohmann::ordered_json(values[0]) : nlohmann::ordered_json(values);
    }
    return json;
}

nlohmann::ordered_json copies_of(const RunReport& r) {
    if (r.copies == 0) return {};
    return {{"count", r.copies},
            {"vary", r.varied},
            {"distinct", r.distinct},
            {"hash", r.distinct == 1 ? nlohmann::ordered_json(hash_text(r.copy_hash)) : nlohmann::ordered_json()},
            {"seconds_a_second", pace_of(r)}};
}

}  // namespace

std::string json_of(const RunReport& r) {
    const Spread ms = spread_of(r.step_ms);
    const Statistics& s = r.statistics;
    nlohmann::ordered_json stages = nlohmann::ordered_json::object(), promise = nlohmann::ordered_json::array(), advice = promise;
    for (const auto& [stage, milliseconds] : r.stages) stages[stage] = milliseconds;
    for (const Advice& one : r.advice) advice.push_back({{"finding", one.finding}, {"remedy", one.remedy}});
    for (const Row& row : r.rows) {
        promise.push_back({{"what", row.what}, {"promised", row.promised}, {"measured", row.measured}, {"pass", row.pass}});
    }
    const nlohmann::ordered_json json = {
        {"version", program_version()},
        {"commit", program_commit()},
        {"compiler", program_compiler()},
        {"started_at", r.started_at},
        {"command_line", r.command_line},
        {"demo", r.name},
        {"seed", r.seed ? nlohmann::ordered_json(*r.seed) : nlohmann::ordered_json()},
        {"scene_hash", hash_text(r.scene_hash)},
        {"backend", r.backend},
        {"device", r.device},
        {"driver", r.driver},
        {"processor", host::processor()},
        {"lanes", widest_lanes()},
        {"arithmetic_fault", r.arithmetic_fault.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(r.arithmetic_fault)},
        {"canvas", r.canvas},
        {"bodies", s.bodies},
        {"broken", s.broken},
        {"pieces", s.pieces},
        {"steps", r.steps},
        {"resumed_at", r.resumed_at},
        {"dt", 1.0 / r.rate},
        {"substeps", r.substeps},
        {"settings", settings_of(r.settings)},
        {"interrupted", r.interrupted},
        {"ms_per_step", {{"mean", ms.mean}, {"median", ms.median}, {"p95", ms.p95}, {"min", ms.min}}},
        {"stages", stages},
        {"manifolds", s.manifolds},
        {"points", s.points},
        {"penetration", {{"mean", s.penetration_mean}, {"max", s.penetration_max}, {"resting", s.penetration_resting}}},
        {"max_speed", s.max_speed},
        {"max_spin", s.max_spin},
        {"spin_limited", s.spin_limited},
        {"kinetic_energy", s.kinetic_energy},
        {"potential_energy", s.potential_energy},
        {"momentum", s.momentum},
        {"angular_momentum", s.angular_momentum},
        {"drift_max", s.drift_max},
        {"joints",
         {{"count", s.joints},
          {"broken", s.joints_broken},
          {"greatest_force", s.joint_force_max},
          {"greatest_torque", s.joint_torque_max}}},
        {"bonds", {{"count", s.bonds}, {"broken", s.bonds_broken}}},
        {"asleep", s.asleep},
        {"not_finite", s.not_finite},
        {"below_ground", s.below_ground},
        {"buffer_growths", r.buffer_growths},
        {"buffer_bytes", r.buffer_bytes},
        {"bytes_per_body", per_body(r, r.buffer_bytes)},
        {"peak_memory_bytes", r.peak_memory_bytes},
        {"peak_memory_per_body", per_body(r, r.peak_memory_bytes)},
        {"first_step_seconds", r.first_step_seconds},
        {"seconds_total", r.seconds_total},
        {"frames", r.frames},
        {"frames_per_second", r.seconds_running > 0 ? r.frames / r.seconds_running : 0.0},
        {"page", page_of(r)},
        {"seconds",
         {{"running", r.seconds_running},
          {"simulate", r.seconds_simulating},
          {"draw", r.seconds_drawing},
          {"encode_wait", r.seconds_waiting}}},
        {"state_hash", hash_text(r.state_hash)},
        {"grains", grains_of(r)},
        {"vtk_moments", r.vtk_moments},
        {"copies", copies_of(r)},
        {"ranks", ranks_of(r)},
        {"advice", advice},
        {"promise",
         {{"judged", r.judged || !r.promised}, {"pass", (r.judged || !r.promised) && all_pass(r.rows)}, {"rows", promise}}},
    };
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string summary_of(const RunReport& r) {
    const Spread ms = spread_of(r.step_ms);
    const Statistics& s = r.statistics;
    const auto metres = [](double value) { return fmt::format("{:.3g} mm", value * 1000); };
    std::string text =
        fmt::format("{}: {} bodies, {} steps of 1/{:g} s on {} ({})\n", r.name, s.bodies, r.steps, r.rate, r.backend, r.device);
    const auto line = [&text](const char* what, const std::string& value) { text += fmt::format("  {:<16}{}\n", what, value); };
    if (r.resumed_at > 0) line("resumed", fmt::format("after {} steps, from a checkpoint", r.resumed_at));
    line("time per step",
         fmt::format("{} (median {}, 95% below {})", duration(ms.mean / 1e3), duration(ms.median / 1e3), duration(ms.p95 / 1e3)));
    line("first step", fmt::format("after {}", duration(r.first_step_seconds)));
    line("contacts", fmt::format("{} pairs touch, in {} points", s.manifolds, s.points));
    line("asleep", fmt::format("{} of {} bodies", s.asleep, s.bodies));
    if (s.broken || s.pieces) line("broken", fmt::format("{} bodies, into pieces of which {} are there", s.broken, s.pieces));
    line("penetration", fmt::format("{} at most, {} on average", metres(s.penetration_max), metres(s.penetration_mean)));
    line("greatest speed", fmt::format("{:.4g} m/s", s.max_speed));
    line("greatest drift", fmt::format("{:.4g} m", s.drift_max));
    if (s.joints > 0)
        line("joints", fmt::format("{}, {} torn; at most {:.4g} N and {:.4g} N m carried", s.joints, s.joints_broken,
                                   s.joint_force_max, s.joint_torque_max));
    if (s.bonds > 0) line("bonds", fmt::format("{}, {} broken", s.bonds, s.bonds_broken));
    line("buffers", fmt::format("{:.1f} MB, {:.0f} bytes per body, grown {} times", static_cast<double>(r.buffer_bytes) / 1e6,
                                per_body(r, r.buffer_bytes), r.buffer_growths));
    line("state hash",
         hash_text(r.state_hash) + (r.arithmetic_fault.empty() ? "" : ", of this device alone: its " + r.arithmetic_fault));
    if (!r.ranks.empty()) {
        double most = 0, messages = 0;
        for (const RunReport::RankCost& one : r.ranks) {
            most = std::max(most, one.sent_bytes);
            messages = std::max(messages, one.messages);
        }
        line("ranks",
             fmt::format("{}; at most {:.3g} kB in {:.0f} messages sent by one in a step", r.ranks.size(), most / 1e3, messages));
    }
    if (r.copies > 0)
        line("copies",
             r.distinct == 1
                 ? fmt::format("{}, each {}; {:.4g} s of them simulated a second", r.copies, hash_text(r.copy_hash), pace_of(r))
                 : fmt::format("{}, in {} states; {:.4g} s of them simulated a second", r.copies, r.distinct, pace_of(r)));
    if (r.page_frames > 0) {
        line("page",
             fmt::format("{} frames, {:.3g} MB, {:.2g} ms a frame", r.page_frames, static_cast<double>(r.page_bytes) / 1e6,
                         r.seconds_encoding_page * 1e3 / static_cast<double>(r.page_frames)));
    }
    if (r.frames > 0) {
        line("pictures",
             fmt::format("{}, {} in all: {} simulating, {} drawing, {} waiting for encoders; {:.3g} a second", r.frames,
                         duration(r.seconds_total), duration(r.seconds_simulating), duration(r.seconds_drawing),
                         duration(r.seconds_waiting), r.frames / std::max(r.seconds_running, 1e-9)));
    }
    if (r.grains) line("grains", remark_on(*r.grains));
    if (r.vtk_moments > 0) line("VTK files", fmt::format("of {} moments", r.vtk_moments));
    for (const Advice& one : r.advice) line("advice", one.finding + ": " + one.remedy);
    if (r.rows.empty()) return text;
    std::vector<Cells> rows = {verdict_heading()};
    for (const Row& row : r.rows) rows.push_back(verdict(row));
    return text + "\n" + table(rows);
}

}  // namespace scree::demos
