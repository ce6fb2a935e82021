// Runs the program as a user does: exit status and output.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/temporary_folder.h"

namespace scree::program {

struct Outcome {
    int status = -1;
    std::string output, errors;
};

using Place = tests::TemporaryFolder;

// Runs `scree ARGUMENTS` in a shell; `before` is prepended (a limit, a variable).
inline Outcome run_scree(const std::string& arguments, const std::string& before = "") {
    const Place place;
    const std::string command = before + " '" + SCREE_PROGRAM_PATH + "' " + arguments + " >'" + (place / "output").string() +
                                "' 2>'" + (place / "errors").string() + "'";
    const int code = std::system(command.c_str());
    Outcome outcome;
    outcome.status = WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
    outcome.output = place.read("output");
    outcome.errors = place.read("errors");
    return outcome;
}

// Empty where a report has none.
inline std::string state_hash_in(const std::string& report) {
    const std::string key = "\"state_hash\": \"";
    const auto at = report.find(key);
    return at == report.npos ? "" : report.substr(at + key.size(), 16);
}

inline bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace scree::program
