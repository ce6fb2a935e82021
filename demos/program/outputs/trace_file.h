// Timelines of scree run: --trace FILE.json --trace-every N, in Chrome's trace event format.
#pragma once

#include <exception>
#include <set>
#include <string>

#include "compute/timeline.h"
#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct TraceOptions {
    std::string file;  // .json; empty: none
    int every = 1;     // steps from one whose stages are told to the next
};
void add_options(CLI::App& command, TraceOptions& options);
// Throws UsageError for an option that means nothing, and for a file of another kind or that cannot be written.
void require_sense(const CLI::App& command, const TraceOptions& options);

// Written while the run steps, through a buffer; the file appears when it is finished.
class TraceFile : public Timeline {
public:
    // `process`: the name of the whole. Throws host::FileError.
    TraceFile(const std::string& path, const std::string& process);

    void slice(Track track, std::string_view name, Time begin, Time end, Values values = {}) override;
    void instant(std::string_view name, Time at, Values values = {}) override;
    void counter(std::string_view name, Time at, double value) override;
    bool wants_stages() const override { return stages_; }
    void set_stages(bool wanted) { stages_ = wanted; }
    void name_queue(const std::string& device) { device_ = device; }
    void finish();  // throws host::FileError

private:
    void meet(Track track);
    void put(const std::string& event);
    std::string moment(Time time) const;  // microseconds since the beginning
    static std::string quoted(std::string_view words);
    static std::string list_of(Values values);

    Time start_ = Clock::now();
    host::GrowingFile file_;
    std::set<Track> met_;
    std::string device_ = "device";
    bool stages_ = true, first_ = true;
    std::exception_ptr failure_;  // of writing
};

}  // namespace scree::demos
