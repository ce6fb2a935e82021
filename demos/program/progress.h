// Progress display: a bar on a terminal, a line every ten seconds elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <string>

namespace scree::demos {

class Progress {
public:
    // `begun`: done before
    Progress(std::string what, long total, const char* unit, bool quiet, long begun = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void done(long count);  // total so far

private:
    using Clock = std::chrono::steady_clock;
    void show(long count, double seconds);

    std::string what_;
    long total_, begun_;
    const char* unit_;
    bool quiet_, terminal_, shown_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

// Formats a duration: "412 us", "3.1 ms", "2 min 5 s".
std::string duration(double seconds);

}  // namespace scree::demos
