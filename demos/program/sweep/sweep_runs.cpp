// Runs of a sweep as processes.
#include "demos/program/sweep/sweep_runs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"

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

// In the child: only what is safe after fork().
[[noreturn]] void become(char* const* words, int errors) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive the sweep
    ::setpgid(0, 0);                     // the terminal's Ctrl-C reaches the sweep alone, which ends its runs
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, 0), ::dup2(nothing, 1), ::dup2(errors, 2);
    ::execv("/proc/self/exe", words);
    _exit(127);
}

pid_t start(const SweepRuns& runs, std::size_t run) {
    std::vector<std::string> arguments = runs.arguments(run);
    arguments.insert(arguments.begin(), "scree");
    arguments.insert(arguments.end(), {"--quiet", "--report", runs.report(run).string()});
    std::vector<char*> words;
    for (std::string& one : arguments) words.push_back(one.data());
    words.push_back(nullptr);
    const int errors = ::open(runs.message(run).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (errors < 0) throw WorkFailed(fmt::format("cannot write {}: {}", runs.message(run).string(), std::strerror(errno)));
    const pid_t child = ::fork();
    if (child == 0) become(words.data(), errors);
    ::close(errors);
    if (child < 0) throw WorkFailed(fmt::format("cannot start a run: {}", std::strerror(errno)));
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
    std::map<pid_t, std::size_t> running;
    std::error_code ignored;
    const auto end = [&](pid_t child, int status) {
        const std::size_t run = running.at(child);
        running.erase(child);
        const bool whole = WIFEXITED(status) && (WEXITSTATUS(status) == done || WEXITSTATUS(status) == promise_missed);
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
        if (why.empty() && WIFSIGNALED(status)) why = fmt::format("ended by signal {}", WTERMSIG(status));
        if (why.empty()) why = fmt::format("exit status {}", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
        ++outcome.failed;
        failed(run, why);
    };
    const auto end_all = [&] {
        outcome.interrupted = true;
        for (const auto& [child, run] : running) ::kill(child, SIGKILL);
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
            int status = 0;
            const pid_t child = ::waitpid(-1, &status, WNOHANG);
            if (child > 0 && running.contains(child)) end(child, status);
            progress(outcome.done + outcome.failed);
            if (child <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    } catch (...) {
        end_all();
        for (const auto& [child, run] : running) {
            ::waitpid(child, nullptr, 0);
            fs::remove(runs.report(run), ignored), fs::remove(runs.message(run), ignored);
        }
        throw;
    }
    return outcome;
}

}  // namespace scree::demos
