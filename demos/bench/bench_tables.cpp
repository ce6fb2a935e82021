// Benchmark results as tables for people and rows for programs.
#include <fmt/format.h>

#include <algorithm>

#include "demos/bench/bench.h"

namespace scree::demos {

namespace {

constexpr double smallest_share = 0.005;  // of a step: stages below this are summed in one row

std::string percent(double part, double whole) {
    return whole > 0 ? fmt::format("{:.1f}", 100 * part / whole) : std::string();
}

Cells stage_row(const StageCost& stage, const Measurement& m, double sum) {
    return {stage.name,
            fmt::format("{:.3f}", stage.ms.median),
            fmt::format("{:.3f}", stage.ms.low),
            fmt::format("{:.3f}", stage.ms.high),
            percent(stage.ms.median, sum),
            fmt::format("{:.2f}", stage.bytes / 1e6),
            fmt::format("{:.2f}", stage.bytes_per_second() / 1e9),
            percent(stage.bytes_per_second(), m.copy_speed)};
}

}  // namespace

std::vector<Cells> overview(const std::vector<Measurement>& all) {
    std::vector<Cells> rows = {{"demo", "bodies", "ms/step", "25%", "75%", "p95", "min", "us/body", "manifolds", "points",
                                "asleep", "buffers MB", "bytes/body"}};
    for (const Measurement& m : all) {
        const auto bodies = static_cast<double>(std::max<std::size_t>(1, m.statistics.bodies));
        rows.push_back({m.name, std::to_string(m.statistics.bodies), fmt::format("{:.3f}", m.step.ms.median),
                        fmt::format("{:.3f}", m.step.ms.low), fmt::format("{:.3f}", m.step.ms.high), fmt::format("{:.3f}", m.p95),
                        fmt::format("{:.3f}", m.min), fmt::format("{:.3f}", m.microseconds_per_body()),
                        std::to_string(m.statistics.manifolds), std::to_string(m.statistics.points),
                        std::to_string(m.statistics.asleep), fmt::format("{:.1f}", static_cast<double>(m.buffer_bytes) / 1e6),
                        fmt::format("{:.0f}", static_cast<double>(m.buffer_bytes) / bodies)});
    }
    return rows;
}

std::vector<Cells> stage_rows(const Measurement& m) {
    std::vector<Cells> rows = {{"stage", "ms/step", "25%", "75%", "% of stages", "moves MB", "GB/s", "% of copying"}};
    double sum = 0;
    for (const StageCost& stage : m.stages) sum += stage.ms.median;
    StageCost rest{"others", {}};
    for (const StageCost& stage : m.stages) {
        if (stage.ms.median >= smallest_share * sum) {
            rows.push_back(stage_row(stage, m, sum));
            continue;
        }
        rest.ms.median += stage.ms.median;
        rest.bytes += stage.bytes;
    }
    if (rest.ms.median > 0) {
        rows.push_back(stage_row(rest, m, sum));
        rows.back()[2] = rows.back()[3] = "";  // sums of medians have no quartiles
    }
    rows.push_back(stage_row(m.step, m, sum));
    rows.back()[4] = "";
    return rows;
}

std::vector<Cells> pipeline_rows(const Measurement& m) {
    std::vector<Cells> rows = {{"stage"}};
    Cells& names = rows.front();
    for (const PipelineFigures& pipeline : m.pipelines) {
        for (const auto& [name, value] : pipeline.figures)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    const Cells columns = names;
    for (const PipelineFigures& pipeline : m.pipelines) {
        Cells row(columns.size());
        row[0] = pipeline.stage;
        for (const auto& [name, value] : pipeline.figures)
            row[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())] =
                fmt::format("{:g}", value);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<Cells> long_form(const std::vector<Measurement>& all) {
    std::vector<Cells> rows = {{"demo", "backend", "device", "bodies", "manifolds", "points", "asleep", "buffer_bytes", "stage",
                                "ms_median", "ms_25", "ms_75", "ms_mean", "bytes", "copy_bytes_per_s", "share_of_copy"}};
    for (const Measurement& m : all) {
        const auto add = [&](const StageCost& stage) {
            rows.push_back({m.name, m.backend, m.device, std::to_string(m.statistics.bodies),
                            std::to_string(m.statistics.manifolds), std::to_string(m.statistics.points),
                            std::to_string(m.statistics.asleep), std::to_string(m.buffer_bytes), stage.name,
                            fmt::format("{:.6f}", stage.ms.median), fmt::format("{:.6f}", stage.ms.low),
                            fmt::format("{:.6f}", stage.ms.high), fmt::format("{:.6f}", stage.ms.mean),
                            fmt::format("{:.0f}", stage.bytes), fmt::format("{:.0f}", m.copy_speed),
                            m.copy_speed > 0 ? fmt::format("{:.5f}", stage.bytes_per_second() / m.copy_speed) : ""});
        };
        add(m.step);
        for (const StageCost& stage : m.stages) add(stage);
    }
    return rows;
}

}  // namespace scree::demos
