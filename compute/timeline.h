// What ran when: a listener of World::set_timeline, for timelines of a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace scree {

// Called from the thread that steps. Slices of one track nest or follow one another; an outer one may be told after those
// inside.
class Timeline {
public:
    using Clock = std::chrono::steady_clock;
    using Time = Clock::time_point;
    // Threads of the CPU by number, of which `caller` is the one that steps, and a device's queue.
    using Track = std::uint32_t;
    static constexpr Track caller = 0;
    static constexpr Track queue = 1u << 16;
    struct Value {
        const char* name;
        double value;
    };
    using Values = std::initializer_list<Value>;

    virtual ~Timeline() = default;
    virtual void slice(Track track, std::string_view name, Time begin, Time end, Values values = {}) = 0;
    virtual void instant(std::string_view name, Time at, Values values = {}) = 0;
    virtual void counter(std::string_view name, Time at, double value) = 0;
    // Whether stages, loops of threads and transfers are told, too. Asked at each step.
    virtual bool wants_stages() const { return true; }
};

// A slice of the caller's from its making to its end; without a timeline nothing.
class TimedSlice {
public:
    TimedSlice(Timeline* timeline, std::string_view name) : timeline_(timeline), name_(name) {
        if (timeline_) begin_ = Timeline::Clock::now();
    }
    ~TimedSlice() {
        if (timeline_) timeline_->slice(Timeline::caller, name_, begin_, Timeline::Clock::now());
    }
    TimedSlice(const TimedSlice&) = delete;
    TimedSlice& operator=(const TimedSlice&) = delete;

private:
    Timeline* timeline_;
    std::string_view name_;
    Timeline::Time begin_;
};

}  // namespace scree
