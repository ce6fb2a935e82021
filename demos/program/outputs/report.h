// The report of a run, as text and as a JSON object.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/measures.h"
#include "compute/world.h"
#include "demos/program/advice/adviser.h"
#include "demos/suite/promise.h"

namespace scree::demos {

struct RunReport {
    std::string name, backend, device;
    std::string driver;                 // of the device, with its version; empty: the CPU
    std::string arithmetic_fault;       // where the device's bits are not the CPU's; empty: nowhere
    std::string command_line;           // as given
    std::string started_at;             // date and time, UTC
    std::optional<std::uint64_t> seed;  // of a demo
    std::uint64_t scene_hash = 0;
    bool interrupted = false;  // by the user, before its end
    Settings settings;
    std::vector<Advice> advice;
    bool promised = false;  // by a demo; other runs are judged by soundness alone
    std::string canvas;     // API and device that drew the pictures; empty: no pictures
    std::uint64_t steps = 0;
    float rate = 60;  // Hz
    int substeps = 12;
    std::uint64_t resumed_at = 0;  // steps done before it was resumed from a checkpoint
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    double first_step_seconds = 0;  // until the end of the first step, with opening the device and creating pipelines
    double seconds_total = 0;       // with pictures and everything else
    std::vector<double> step_ms;    // each step after the first (or the only one), without pictures
    std::vector<std::pair<std::string, double>> stages;  // ms per step
    Statistics statistics;
    std::uint64_t buffer_growths = 0, state_hash = 0;
    std::size_t buffer_bytes = 0, peak_memory_bytes = 0;
    int frames = 0;
    std::size_t page_frames = 0;  // of --html; likewise below
    std::uint64_t page_bytes = 0;
    double seconds_encoding_page = 0;
    // Wall time of the run without set-up, s, and its parts:
    double seconds_running = 0;                                               // parts below, and recording, script, statistics
    double seconds_simulating = 0, seconds_drawing = 0, seconds_waiting = 0;  // the last one: waiting for the encoders
    bool judged = false;                                                      // the run was long enough for its promise
    std::size_t copies = 0;                                                   // of the scene; 0: the scene itself
    std::size_t distinct = 0;                                                 // different hashes of copies
    std::uint64_t copy_hash = 0;                                              // of every copy, if they are equal
    std::vector<std::string> varied;                                          // --vary
    // Of each rank of a distributed run; empty: it was not distributed.
    struct RankCost {
        double sent_bytes = 0, messages = 0;  // per step, to other ranks
        double waiting_ms = 0;                // per step, for other ranks and messages
        std::uint64_t peak_memory_bytes = 0;
    };
    std::vector<RankCost> ranks;
    std::optional<RegionMeasures> grains;  // at the end, if the run measures
    int vtk_moments = 0;
    std::vector<Row> rows;
};

struct Spread {
    double mean = 0, median = 0, p95 = 0, min = 0;  // ms
};
Spread spread_of(std::vector<double> step_ms);

// This program and machine, for reports: version, commit and compiler.
std::string program_version();
std::string program_commit();  // "unknown" outside a repository
std::string program_compiler();
std::string date_and_time();  // now, UTC, "2026-01-31T12:00:00Z"

std::string json_of(const RunReport& report);
std::string summary_of(const RunReport& report);

}  // namespace scree::demos
