// Exit statuses, and the errors that map to them.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace scree::demos {

constexpr int done = 0;
constexpr int promise_missed = 1;  // or the work failed
constexpr int wrong_usage = 2;
constexpr int interrupted = 130;  // as shells report SIGINT

// Wrong usage or input: the message names place, reason and remedy.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// A valid command whose work failed: device, encoder, disk.
struct WorkFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Converts exceptions of the work to WorkFailed.
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
