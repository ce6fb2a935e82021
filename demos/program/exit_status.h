// How the program ends, and the errors that are the user's to mend.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace scree::demos {

constexpr int done = 0;
constexpr int promise_missed = 1;  // or the work itself failed
constexpr int wrong_usage = 2;
constexpr int interrupted = 130;  // as a shell reports a program that Ctrl-C ended

// Wrong usage or input: the message names the place, the reason and the cure.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The command was right and its work failed: the device, the encoder, the disk.
struct WorkFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What goes wrong from here on is no fault of the command line.
template <class Work>
decltype(auto) at_work(Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (const UsageError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw WorkFailed("memory ended during the work; ask for fewer --bodies");
    } catch (const std::exception& error) {
        throw WorkFailed(error.what());
    }
}

}  // namespace scree::demos
