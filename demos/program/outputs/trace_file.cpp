// Timelines of scree run. The format: "Trace Event Format", D. Nduca and others, as chrome://tracing and Perfetto read it.
#include "demos/program/outputs/trace_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "compute/scene_file/json_text.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/output_check.h"

namespace scree::demos {

void add_options(CLI::App& command, TraceOptions& options) {
    const char* group = "Timeline";
    command
        .add_option("--trace", options.file,
                    "Timeline FILE.json for ui.perfetto.dev and chrome://tracing: what ran when on each thread and on the "
                    "device's queue (steps, stages, transfers, pictures, files), pairs and contacts, and when buffers grew, "
                    "bodies were reordered or broke. 20 kB a step; timing every stage of a device costs time, on lavapipe 10 us "
                    "each.")
        ->group(group);
    command
        .add_option("--trace-every", options.every, "Steps from one whose stages are in the timeline to the next. Default: 1.")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
}

void require_sense(const CLI::App& command, const TraceOptions& options) {
    if (options.file.empty()) {
        if (command.count("--trace") != 0) throw UsageError("--trace: the name is empty; name a file");
        if (command.count("--trace-every") != 0)
            throw UsageError("--trace-every: no timeline is asked for; add --trace FILE.json");
        return;
    }
    if (!options.file.ends_with(".json"))
        throw UsageError(fmt::format("--trace {}: a timeline is a .json; name a file such as trace.json", options.file));
    require_writable_file("--trace", options.file);
}

TraceFile::TraceFile(const std::string& path, const std::string& process) : file_(path) {
    file_.append(std::string_view("{\"displayTimeUnit\":\"ms\",\"otherData\":{\"generator\":\"scree\"},\"traceEvents\":["));
    for (int id = 0; id < 2; ++id)
        put(fmt::format(R"({{"ph":"M","pid":{},"tid":0,"name":"process_name","args":{{"name":{}}}}})", id,
                        quoted(id == 0 ? process : process + ": device")));
}

std::string TraceFile::quoted(std::string_view words) {
    Text text;
    text.quoted(words);
    return text.take();
}

std::string TraceFile::list_of(Values values) {
    std::string list;
    for (const Value& value : values)
        list +=
            fmt::format("{}\"{}\":{:.10g}", list.empty() ? "" : ",", value.name, std::isfinite(value.value) ? value.value : 0);
    return list;
}

std::string TraceFile::moment(Time time) const {
    return fmt::format("{:.3f}", std::chrono::duration<double, std::micro>(time - start_).count());
}

// Slices end in destructors, which must not throw: finish() does.
void TraceFile::put(const std::string& event) {
    if (failure_) return;
    try {
        file_.append(std::string_view(first_ ? "\n" : ",\n"));
        file_.append(std::string_view(event));
    } catch (const host::FileError&) {
        failure_ = std::current_exception();
    }
    first_ = false;
}

void TraceFile::meet(Track track) {
    if (!met_.insert(track).second) return;
    const std::string name = track == queue    ? "queue of " + device_
                             : track == caller ? "thread 0: steps and outputs"
                                               : fmt::format("thread {}", track);
    put(fmt::format(R"({{"ph":"M","pid":{},"tid":{},"name":"thread_name","args":{{"name":{}}}}})", track == queue ? 1 : 0, track,
                    quoted(name)));
}

void TraceFile::slice(Track track, std::string_view name, Time begin, Time end, Values values) {
    meet(track);
    const auto duration = std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count();
    put(fmt::format(R"({{"ph":"X","pid":{},"tid":{},"name":{},"ts":{},"dur":{}.{:03},"args":{{{}}}}})", track == queue ? 1 : 0,
                    track, quoted(name), moment(begin), duration / 1000, duration % 1000, list_of(values)));
}

void TraceFile::instant(std::string_view name, Time at, Values values) {
    put(fmt::format(R"({{"ph":"i","s":"p","pid":0,"tid":0,"name":{},"ts":{},"args":{{{}}}}})", quoted(name), moment(at),
                    list_of(values)));
}

void TraceFile::counter(std::string_view name, Time at, double value) {
    put(fmt::format(R"({{"ph":"C","pid":0,"tid":0,"name":{},"ts":{},"args":{{"count":{}}}}})", quoted(name), moment(at), value));
}

void TraceFile::finish() {
    if (failure_) std::rethrow_exception(failure_);
    file_.append(std::string_view("\n]}\n"));
    file_.commit();
}

}  // namespace scree::demos
