// How the program ends, and the errors that are the user's to mend.
#pragma once

#include <stdexcept>

namespace scree::demos {

constexpr int done = 0;
constexpr int promise_missed = 1;
constexpr int wrong_usage = 2;
constexpr int interrupted = 130;  // as a shell reports a program that Ctrl-C ended

// Wrong usage or input: the message names the place, the reason and the cure.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace scree::demos
