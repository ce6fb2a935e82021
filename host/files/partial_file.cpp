// A registry of files being written, for removal by a signal handler.
#include "host/files/partial_file.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <string>

namespace scree::host {
namespace {

// Fixed-size and lock-free, since a signal handler may neither block nor allocate.
struct Entry {
    enum State { free, being_filled, filled };
    std::atomic<int> state{free};
    pid_t writer = 0;
    char path[4096] = {};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait");

std::array<Entry, 32> entries;  // more than the files written concurrently

}  // namespace

Unfinished::Unfinished(const std::filesystem::path& path, pid_t writer) {
    std::error_code ignored;
    const std::string name = std::filesystem::absolute(path, ignored).string();
    if (name.empty() || name.size() >= sizeof Entry::path) return;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        int state = Entry::free;
        if (!entries[i].state.compare_exchange_strong(state, Entry::being_filled)) continue;
        std::memcpy(entries[i].path, name.c_str(), name.size() + 1);
        entries[i].writer = writer;
        entries[i].state = Entry::filled;
        place_ = static_cast<int>(i);
        return;
    }
}

Unfinished::~Unfinished() {
    if (place_ >= 0) entries[static_cast<std::size_t>(place_)].state = Entry::free;
}

void remove_unfinished() noexcept {
    for (Entry& entry : entries) {
        if (entry.state != Entry::filled) continue;
        if (entry.writer > 0) ::kill(entry.writer, SIGKILL);
        ::unlink(entry.path);
    }
}

}  // namespace scree::host
