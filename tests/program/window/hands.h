// A virtual display (Xvfb), the program in a window on it, and mouse and keys by xdotool.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/program/program.h"

namespace scree::program {

using nlohmann::json;

inline void wait_for(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}
inline bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// A child process, ended by the destructor.
class Process {
public:
    explicit Process(const std::function<void()>& become) : id_(::fork()) {
        if (id_ != 0) return;
        become();  // returns only on failure
        ::_exit(127);
    }
    ~Process() {
        if (id_ <= 0) return;
        ::kill(id_, SIGKILL);
        ::waitpid(id_, nullptr, 0);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    void signal(int number) const { ::kill(id_, number); }
    bool runs() const { return ::kill(id_, 0) == 0 && ::waitpid(id_, nullptr, WNOHANG) == 0; }
    // Waits for the exit status; -1 if the process does not end within `seconds`.
    int end(double seconds) {
        for (double waited = 0; waited < seconds; waited += 0.05) {
            int code = 0;
            if (::waitpid(id_, &code, WNOHANG) == id_) {
                id_ = -1;
                return WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
            }
            wait_for(0.05);
        }
        return -1;
    }

private:
    pid_t id_;
};

// An X server on a free display number.
class Screen {
public:
    Screen() {
        int ends[2];
        if (::pipe(ends) != 0) return;
        server_.emplace([&] {
            const int nowhere = ::open("/dev/null", O_WRONLY);
            ::dup2(nowhere, 2);
            const std::string to = std::to_string(ends[1]);
            ::execlp("Xvfb", "Xvfb", "-displayfd", to.c_str(), "-screen", "0", "1280x800x24", "-nolisten", "tcp", nullptr);
        });
        ::close(ends[1]);
        char text[16] = {};
        if (::read(ends[0], text, sizeof text - 1) > 0) name_ = ":" + std::to_string(std::atoi(text));
        ::close(ends[0]);
    }
    const std::string& name() const { return name_; }

private:
    std::optional<Process> server_;
    std::string name_;
};

// The program in a window, and user input to it.
class Viewer {
public:
    Viewer(const Screen& screen, const Place& place, const std::string& shots, std::vector<std::string> arguments)
        : screen_(screen), place_(place), shots_(shots) {
        arguments.insert(arguments.begin(), {SCREE_PROGRAM_PATH, "view"});
        arguments.insert(arguments.end(), {"--report", (place / "report.json").string()});
        process_.emplace([&] {
            ::setenv("DISPLAY", screen.name().c_str(), 1);
            const int errors = ::open((place / "errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            ::dup2(errors, 2);
            std::vector<char*> words;
            for (std::string& argument : arguments) words.push_back(argument.data());
            words.push_back(nullptr);
            ::execv(words[0], words.data());
        });
    }
    Process& process() { return *process_; }
    json report() const { return json::parse(place_.read("report.json"), nullptr, false); }
    std::string errors() const { return place_.read("errors"); }

    // Waits until the report satisfies `says_so`; false on a generous timeout.
    bool until(const std::function<bool(const json&)>& says_so) const {
        for (double waited = 0; waited < 60; waited += 0.1) {
            const json now = report();
            if (now.is_object() && says_so(now)) return true;
            if (!process_->runs()) return false;
            wait_for(0.1);
        }
        return false;
    }
    // The next report.
    json next() const {
        const json before = report();
        until([&](const json& now) { return now.at("seconds") > before.at("seconds"); });
        return report();
    }
    void find_window() {
        REQUIRE(until([](const json& now) { return now.at("pictures") >= 2; }));
        hand("search --sync --onlyvisible --name ^scree > '" + (place_ / "window").string() + "'");
        window_ = place_.read("window");
        window_ = window_.substr(0, window_.find('\n'));
        REQUIRE_FALSE(window_.empty());
        hand("windowfocus --sync " + window_);
    }
    void hand(const std::string& does) const {
        const std::string command = "DISPLAY=" + screen_.name() + " xdotool " + does;
        INFO(command);
        REQUIRE(std::system(command.c_str()) == 0);
    }
    void point(int x, int y) const { hand("mousemove --window " + window_ + " " + std::to_string(x) + " " + std::to_string(y)); }
    void strike(const std::string& key) const { hand("key " + key); }
    const std::string& window() const { return window_; }

    void shoot(const std::string& name) const {
        if (!is_installed("ffmpeg")) return;
        const std::string file = std::string(SCREE_SCREENSHOTS) + "/" + shots_ + "_" + name + ".png";
        const std::string command = "mkdir -p '" SCREE_SCREENSHOTS
                                    "' && ffmpeg -loglevel error -y -f x11grab -video_size 1280x800 -i " +
                                    screen_.name() + " -frames:v 1 '" + file + "' </dev/null";
        CHECK(std::system(command.c_str()) == 0);
    }

private:
    const Screen& screen_;
    const Place& place_;
    std::string shots_, window_;
    std::optional<Process> process_;
};

}  // namespace scree::program
