// Runs the program as a user does: exit status and output.
#pragma once

#include <sys/wait.h>

#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace scree::program {

struct Outcome {
    int status = -1;
    std::string output, errors;
};

// A temporary folder, removed by the destructor.
class Place {
public:
    Place() {
        std::string name = (std::filesystem::temp_directory_path() / "scree-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Place() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return (path_ / name).string();
    }
    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
        return text.str();
    }

private:
    std::filesystem::path path_;
};

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

inline bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace scree::program
