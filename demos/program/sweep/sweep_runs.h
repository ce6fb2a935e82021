// Runs of a sweep: processes of their own, each with a report in a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scree::demos {

struct SweepRuns {
    std::filesystem::path folder;
    std::size_t jobs = 1;
    std::function<std::vector<std::string>(std::size_t)> arguments;  // of a run, without those for its report

    std::filesystem::path report(std::size_t run) const;   // of a run that is done
    std::filesystem::path message(std::size_t run) const;  // what a failed run said
    bool is_done(std::size_t run) const;                   // it has a report of a whole run
};

struct SweepOutcome {
    std::size_t done = 0, failed = 0;
    bool interrupted = false;
};

// Runs what has no report yet, `jobs` at a time. A run that fails leaves a message in place of a report, and `failed` is told of
// it. Ends early when the user interrupts: running processes are ended, and leave nothing. `progress`: number done of these.
SweepOutcome run_all(const SweepRuns& runs, const std::vector<std::size_t>& wanted,
                     const std::function<void(std::size_t)>& progress,
                     const std::function<void(std::size_t, const std::string&)>& failed);

}  // namespace scree::demos
