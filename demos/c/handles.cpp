// The table of handles of the C interface.
#include "demos/c/handles.h"

#include <array>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "demos/c/call.h"

namespace scree::c {

namespace {

// A handle is the place in the table, from 1, with the number of handles that the place had before in the upper half.
constexpr int place_bits = std::numeric_limits<std::uintptr_t>::digits / 2;
constexpr std::uintptr_t most_places = (std::uintptr_t{1} << place_bits) - 1;

struct Entry {
    HandleKind kind = HandleKind::scene;
    std::uintptr_t generation = 0;
    std::shared_ptr<void> object;
};

struct Table {
    std::mutex mutex;
    std::vector<Entry> entries;
    std::vector<std::size_t> free;

    Entry* find(HandleKind kind, const void* handle) {
        const auto number = reinterpret_cast<std::uintptr_t>(handle);
        const std::uintptr_t place = number & most_places, generation = number >> place_bits;
        if (place == 0 || place > entries.size()) return nullptr;
        Entry& entry = entries[place - 1];
        return entry.object && entry.generation == generation && entry.kind == kind ? &entry : nullptr;
    }
};

Table& table() {
    static auto* made = new Table;  // other statics may release worlds after it would have ended
    return *made;
}

}  // namespace

const void* issue(HandleKind kind, std::shared_ptr<void> object) {
    Table& all = table();
    const std::lock_guard lock(all.mutex);
    std::size_t place = all.entries.size();
    if (!all.free.empty()) {
        place = all.free.back();
        all.free.pop_back();
    } else {
        if (place == most_places) throw Failure(SCREE_NO_MEMORY, "there are too many handles");
        all.entries.emplace_back();
    }
    Entry& entry = all.entries[place];
    entry.kind = kind;
    entry.object = std::move(object);
    return reinterpret_cast<const void*>((entry.generation << place_bits) | (place + 1));
}

std::shared_ptr<void> held(HandleKind kind, const void* handle) {
    static constexpr std::array names{"scene", "world", "view", "export", "recording"};
    const std::string name = names[static_cast<std::size_t>(kind)];
    if (handle == nullptr) throw Failure(SCREE_BAD_HANDLE, "the handle of a " + name + " is null");
    Table& all = table();
    const std::lock_guard lock(all.mutex);
    const Entry* entry = all.find(kind, handle);
    if (!entry) throw Failure(SCREE_BAD_HANDLE, "the handle is no " + name + "'s, or it was released");
    return entry->object;
}

std::shared_ptr<void> ended(HandleKind kind, const void* handle) noexcept {
    Table& all = table();
    const std::lock_guard lock(all.mutex);
    Entry* entry = all.find(kind, handle);
    if (!entry) return nullptr;
    // A place whose numbers are used up is not given again.
    entry->generation = (entry->generation + 1) & most_places;
    const std::shared_ptr<void> object = std::exchange(entry->object, nullptr);
    try {
        if (entry->generation != 0) all.free.push_back(static_cast<std::size_t>(entry - all.entries.data()));
    } catch (const std::bad_alloc&) {  // the place stays empty
    }
    return object;
}

}  // namespace scree::c
