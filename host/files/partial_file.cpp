// Files being written: names, the registry for a signal handler, left-overs.
#include "host/files/partial_file.h"

#include <array>
#include <atomic>
#include <charconv>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "host/system/files.h"

namespace scree::host {
namespace {

// Fixed-size and lock-free, since a signal handler may neither block nor allocate.
struct Entry {
    enum State { free, being_filled, filled };
    std::atomic<int> state{free};
    ProcessId writer = 0;
    char path[4096] = {};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait");

std::array<Entry, 32> entries;  // more than the files written concurrently

constexpr std::string_view mark = ".part-scree-";

// The process in the name of a partial file; 0: it is none.
ProcessId process_in(std::string_view name) {
    const std::size_t at = name.rfind(mark);
    if (at == name.npos || at == 0) return 0;
    const char *const begin = name.data() + at + mark.size(), *const end = name.data() + name.size();
    ProcessId process = 0;
    unsigned number = 0;
    const auto [dash, wrong] = std::from_chars(begin, end, process);
    if (wrong != std::errc() || dash == end || *dash != '-') return 0;
    const auto [last, bad] = std::from_chars(dash + 1, end, number);
    return bad == std::errc() && last == end && process > 0 ? process : 0;
}

// On a folder that machines share, the process may be another machine's: then the file is held.
void remove_if_left(const std::filesystem::path& path, ProcessId process) {
    if (process != own_process() && is_gone(process)) remove_unless_held(path);
}

}  // namespace

namespace {
std::atomic<int> waits{0};
}

Waiting::Waiting() {
    ++waits;
}
Waiting::~Waiting() {
    --waits;
}
bool is_waiting() noexcept {
    return waits > 0;
}

std::filesystem::path target_of_links(const std::filesystem::path& path) {
    std::error_code wrong;
    std::filesystem::path target = std::filesystem::canonical(path, wrong);
    if (!wrong) return target;
    target = path;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(std::filesystem::symlink_status(target, wrong)); ++links) {
        const std::filesystem::path next = std::filesystem::read_symlink(target, wrong);
        if (wrong) break;
        target = target.parent_path() / next;
    }
    return target;
}

std::filesystem::path partial_name(const std::filesystem::path& target) {
    static std::atomic<unsigned> serial{0};
    remove_left_overs(target.has_parent_path() ? target.parent_path() : ".");
    std::filesystem::path partial = target;
    partial += std::string(mark) + std::to_string(own_process()) + "-" + std::to_string(serial++);
    return partial;
}

void remove_left_overs(const std::filesystem::path& folder) {
    static std::mutex guard;
    static std::set<std::filesystem::path> looked;
    std::error_code wrong;
    const std::filesystem::path place = std::filesystem::canonical(folder, wrong);
    {
        const std::lock_guard lock(guard);
        if (wrong || !looked.insert(place).second) return;
    }
    for (std::filesystem::directory_iterator entry(place, wrong), end; !wrong && entry != end; entry.increment(wrong))
        if (const ProcessId process = process_in(entry->path().filename().string())) remove_if_left(entry->path(), process);
}

Unfinished::Unfinished(const std::filesystem::path& path, ProcessId writer) {
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
        if (entry.writer > 0) end_process(entry.writer);
        remove_file_in_signal(entry.path);
    }
}

}  // namespace scree::host
