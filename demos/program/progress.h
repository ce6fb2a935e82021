// How far long work has come: a bar on a terminal, a plain line every ten seconds elsewhere, nothing when it shall be quiet.
#pragma once

#include <chrono>
#include <string>

namespace scree::demos {

class Progress {
public:
    Progress(std::string what, long total, const char* unit, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void done(long count);  // so far

private:
    using Clock = std::chrono::steady_clock;
    void show(long count, double seconds);

    std::string what_;
    long total_;
    const char* unit_;
    bool quiet_, terminal_, shown_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

// For people: "412 us", "3.1 ms", "2 min 5 s".
std::string duration(double seconds);

}  // namespace scree::demos
