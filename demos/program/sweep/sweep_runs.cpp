// Runs of a sweep as processes.
#include "demos/program/sweep/sweep_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "host/system/files.h"
#include "host/system/processes.h"

namespace scree::demos {

namespace {

namespace fs = std::filesystem;

std::string first_line_of(const fs::path& path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line))
        if (!line.empty() && line.find(": note: ") == line.npos) return line;
    return "";
}

host::ProcessId start(const SweepRuns& runs, std::size_t run) {
    std::vector<std::string> words = runs.arguments(run);
    words.insert(words.begin(), "scree");
    words.insert(words.end(), {"--quiet", "--report", runs.report(run).string()});
    const int errors = host::open_to_replace(runs.message(run));
    if (errors < 0) throw WorkFailed(fmt::format("cannot write {}: {}", runs.message(run).string(), std::strerror(errno)));
    const host::ProcessId child = host::start_self(std::move(words), {-1, errors, {}});
    const int error = errno;
    host::close_file(errors);
    if (child < 0) throw WorkFailed(fmt::format("cannot start a run: {}", std::strerror(error)));
    return child;
}

}  // namespace

fs::path SweepRuns::report(std::size_t run) const {
    return folder / fmt::format("run-{:06}.json", run);
}
fs::path SweepRuns::message(std::size_t run) const {
    return folder / fmt::format("run-{:06}.txt", run);
}

bool SweepRuns::is_done(std::size_t run) const {
    std::ifstream file(report(run));
    if (!file) return false;
    const auto json = nlohmann::json::parse(file, nullptr, false);
    return json.is_object() && !json.value("interrupted", true);
}

SweepOutcome run_all(const SweepRuns& runs, const std::vector<std::size_t>& wanted,
                     const std::function<void(std::size_t)>& progress,
                     const std::function<void(std::size_t, const std::string&)>& failed) {
    SweepOutcome outcome;
    std::map<host::ProcessId, std::size_t> running;
    std::error_code ignored;
    const auto end = [&](host::ProcessId child, const host::ChildEnd& how) {
        const std::size_t run = running.at(child);
        running.erase(child);
        const bool whole = !how.by_signal && (how.status == done || how.status == promise_missed);
        if (whole && runs.is_done(run)) {
            fs::remove(runs.message(run), ignored);
            ++outcome.done;
            return;
        }
        fs::remove(runs.report(run), ignored);
        if (outcome.interrupted) {
            fs::remove(runs.message(run), ignored);
            return;
        }
        std::string why = first_line_of(runs.message(run));
        if (why.empty()) why = fmt::format("{} {}", how.by_signal ? "ended by signal" : "exit status", how.status);
        ++outcome.failed;
        failed(run, why);
    };
    const auto end_all = [&] {
        outcome.interrupted = true;
        for (const auto& [child, run] : running) host::end_process(child);
    };
    std::size_t next = 0;
    try {
        while (next < wanted.size() || !running.empty()) {
            if (is_interrupted() && !outcome.interrupted) end_all();
            if (outcome.interrupted) next = wanted.size();
            while (next < wanted.size() && running.size() < runs.jobs) {
                const std::size_t run = wanted[next++];
                running.emplace(start(runs, run), run);
            }
            bool one_ended = false;
            for (auto at = running.begin(); at != running.end();) {
                const host::ProcessId child = at++->first;
                const auto how = host::end_of_child(child);
                if (how) end(child, *how);
                one_ended = one_ended || how;
            }
            progress(outcome.done + outcome.failed);
            if (!one_ended) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    } catch (...) {
        end_all();
        for (const auto& [child, run] : running) {
            host::wait_for_child(child);
            fs::remove(runs.report(run), ignored), fs::remove(runs.message(run), ignored);
        }
        throw;
    }
    return outcome;
}

}  // namespace scree::demos
