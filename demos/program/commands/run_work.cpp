// Simulates, records, measures and judges a run.
#include "demos/program/commands/run_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>

#include "compute/distributed/distributed.h"
#include "demos/program/advice/adviser.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/outputs/page_file.h"
#include "demos/program/progress.h"
#include "demos/suite/recorder.h"
#include "host/files/file.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

// Whether any rank has been interrupted.
bool is_run_interrupted(const RunOptions& options) {
    if (!options.exchange) return demos::is_interrupted();
    std::uint32_t any[1] = {demos::is_interrupted() ? 1u : 0u};
    options.exchange->unite(any);
    return any[0] != 0;
}

// Reads the world on all ranks, so that the outputs of the first find it there.
void gather(const RunOptions& options, const World& world) {
    if (options.exchange && options.is_watched) (void)world.state();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Short steps are submitted in batches when no step is recorded or drawn, so that the device does not wait for the
// host. The report then has the batch's mean for each of its steps.
constexpr int most_at_once = 8;  // timed steps are at multiples of this
constexpr double longest_waiting_ms = 10;

double steps_alone(World& world, const Script& before_step, int count) {
    if (before_step) before_step(world);
    const auto start = std::chrono::steady_clock::now();
    world.step(count);
    return seconds_since(start);
}

void steps_timed(const LoadedScene& subject, World& world, Recorder* recorder, int count, RunReport& report) {
    const double seconds = recorder ? recorder->step() : steps_alone(world, subject.before_step, count);
    if (world.steps() == report.resumed_at + 1) report.first_step_seconds = seconds_since(report.started);
    if (world.steps() == report.resumed_at + 2) report.step_ms.clear();  // the first step is not representative
    report.step_ms.insert(report.step_ms.end(), static_cast<std::size_t>(count), seconds * 1e3 / count);
    report.seconds_simulating += seconds;
}

// Whether the promise can be judged by then.
bool is_promise_due(const LoadedScene& subject, const World& world, double time) {
    return subject.promise && time >= subject.seconds - 0.5 / static_cast<double>(world.settings().rate);
}

// Judges the promise once its duration has passed; longer runs do not change the verdict.
void hold_to_promise(const LoadedScene& subject, const World& world, std::optional<Recorder>& recorder, RunReport& report) {
    if (!recorder || !is_promise_due(subject, world, world.time())) return;
    report.rows = subject.promise->judge(recorder->finish());
    report.judged = true;
    recorder.reset();
}

// One step in this many has stage timestamps, which cost up to a third of a small step on lavapipe.
constexpr int steps_a_timed_one = 16;

// Files of motion that are written while the run steps.
class Records {
public:
    Records(const RunOptions& options, const LoadedScene& subject, World& world)
        : animation_(make_animation(options.animation, world)) {
        if (!options.trajectory.file.empty()) trajectory_.emplace(options.trajectory, world);
        if (!options.measures.table.empty() || !options.measures.vtk.empty())
            measures_.emplace(options.measures, options.measured, options.copies.copy.value_or(0), options.pictures.fps);
        if (!options.pictures.html.empty()) page_ = make_page(options.pictures, options.shown, subject, world);
    }
    int steps_until_due(const World& world) const {
        int steps = std::numeric_limits<int>::max();
        if (trajectory_) steps = std::min(steps, trajectory_->steps_until_due(world));
        if (animation_) steps = std::min(steps, animation_.steps_until_due(world));
        if (measures_) steps = std::min(steps, measures_->steps_until_due(world));
        if (page_) steps = std::min(steps, page_->steps_until_due());
        return steps;
    }
    void after_step(const World& world) {
        if (trajectory_) trajectory_->after_step(world);
        if (animation_) animation_.after_step(world);
        if (measures_) measures_->after_step(world);
        if (page_) page_->after_step();
    }
    void finish() {
        if (trajectory_) trajectory_->finish();
        if (animation_) animation_.write();
        if (measures_) measures_->finish();
        if (page_) page_->finish();
    }
    int vtk_moments() const { return measures_ ? measures_->vtk_moments() : 0; }
    std::optional<PageFigures> page() const { return page_ ? std::optional(page_->figures()) : std::nullopt; }

private:
    std::optional<Trajectory> trajectory_;
    Animation animation_;
    std::optional<MeasuresFile> measures_;
    std::unique_ptr<PageRecording> page_;
};

// Returns false if interrupted.
bool simulate(const RunOptions& options, const LoadedScene& subject, World& world, Pictures* pictures, Records& records,
              Adviser* adviser, RunReport& report) {
    const int steps = options.scene.step_count(subject.seconds, world.settings().rate);
    std::optional<Recorder> recorder;
    if (is_promise_due(subject, world, steps / static_cast<double>(world.settings().rate)))
        recorder.emplace(world, *subject.promise, subject.seconds, subject.before_step);
    Progress progress(subject.title(), steps, "steps", options.quiet, static_cast<long>(world.steps()));
    SceneOptions simulated = options.scene;  // with the settings of the scene's file
    simulated.rate = world.settings().rate;
    simulated.substeps = world.settings().substeps;
    Checkpoints checkpoints(options.checkpoints, simulated, steps, options.input);
    TraceFile* const timeline = options.timeline.get();
    const auto record = [&] {
        gather(options, world);
        if (pictures) {
            const TimedSlice slice(timeline, "draw");
            pictures->after_step();
        }
        const TimedSlice slice(timeline, "record");
        records.after_step(world);
    };
    record();
    const bool reports = !options.report.empty();
    for (int done = static_cast<int>(world.steps()); done < steps;) {
        if (is_run_interrupted(options)) {
            complete_outputs();
            checkpoints.write(world);
            return false;
        }
        const bool traced = timeline && done % options.trace.every == 0;
        const bool timed = (reports && (done % steps_a_timed_one == steps_a_timed_one / 2 || done + 1 == steps)) ||
                           (traced && options.trace.every > 1);
        if (timeline) timeline->set_stages(traced);
        world.set_profiling(timed || traced);
        const bool watched = timed || recorder || pictures || subject.before_step || world.steps() < report.resumed_at + 2;
        const bool waits = world.runner().backend() != "cpu" && !world.runner().ranks() && !report.step_ms.empty() &&
                           report.step_ms.back() < longest_waiting_ms;
        int unwatched = std::min(steps - done - (reports ? 1 : 0), most_at_once - done % most_at_once);
        unwatched = std::min(unwatched, checkpoints.steps_until_due(world));
        if (adviser) unwatched = std::min(unwatched, adviser->steps_to_next(world));
        unwatched = std::min(unwatched, records.steps_until_due(world));
        if (timeline && options.trace.every > 1)
            unwatched = std::min(unwatched, options.trace.every - done % options.trace.every);
        const int count = watched || !waits ? 1 : unwatched;
        {
            const TimedSlice slice(timeline, "advance");
            steps_timed(subject, world, recorder ? &*recorder : nullptr, count, report);
        }
        done += count;
        hold_to_promise(subject, world, recorder, report);
        record();
        const TimedSlice slice(timeline, "checkpoint, advice");
        if (done < steps) checkpoints.after_step(world);
        if (adviser) adviser->after_step(world);
        progress.done(done);
    }
    checkpoints.write(world);
    // Commands after the last recorded step belong to the recording's final state.
    if (options.played && options.played->steps == world.steps()) subject.before_step(world);
    return !is_run_interrupted(options);
}

// Judges soundness of runs without or beyond a promise. In replays bodies may be below the ground, thrown by the
// user.
void hold_to_soundness(bool played, World& world, RunReport& report) {
    report.statistics = world.statistics();
    Trace trace;
    trace.statistics = report.statistics;
    for (Row& row : judge(played ? std::vector<Claim>{finite()} : soundness(), trace)) {
        if (!report.judged || !row.pass) report.rows.push_back(std::move(row));
    }
}

// A recording that was played to its end must end as it did.
void hold_to_recording(const RunOptions& options, RunReport& report) {
    if (!options.played || !options.played->end_hash || options.played->steps != report.steps) return;
    const std::uint64_t hash = *options.played->end_hash;
    report.rows.push_back(
        {"state hash at the end", hash_text(hash) + ", as recorded", hash_text(report.state_hash), hash == report.state_hash});
}

void conclude(const RunOptions& options, const LoadedScene& subject, const RunReport& report) {
    if (!options.report.empty() && options.report != "-") host::write_atomically(options.report, json_of(report));
    if (options.report == "-") {
        fmt::print("{}", json_of(report));
    } else if (!options.quiet) {
        std::string text = summary_of(report);
        if (subject.promise && !report.judged) {
            text += fmt::format("The promise was not judged: it takes {:g} s, and this run had {:g} s.\n", subject.seconds,
                                static_cast<double>(report.steps) / static_cast<double>(report.rate));
        }
        if (options.pictures.takes_output()) {
            say("{}", printable(text));
        } else {
            fmt::print("{}", printable(text));
        }
    }
    if (all_pass(report.rows) || !options.quiet || !options.speaks()) return;
    for (const Row& row : report.rows) {
        if (!row.pass) say("scree: {}: {}: promised {}, measured {}\n", subject.name, row.what, row.promised, row.measured);
    }
}

void measure(World& world, RunReport& report) {
    report.backend = world.runner().backend();
    report.device = world.runner().device();
    report.steps = world.steps();
    report.settings = world.settings();
    report.rate = world.settings().rate;
    report.substeps = world.settings().substeps;
    report.stages = world.stage_times();
    report.buffer_growths = world.buffer_growths();
    report.buffer_bytes = world.buffer_bytes();
    report.state_hash = world.state_hash();
    if (report.copies == 0) return;
    std::vector<std::uint64_t> hashes = world.state_hashes();
    std::sort(hashes.begin(), hashes.end());
    report.distinct = static_cast<std::size_t>(std::unique(hashes.begin(), hashes.end()) - hashes.begin());
    if (report.distinct == 1) report.copy_hash = hashes[0];
}

// Completes the frames and the video, which an interrupted run has, too.
void finish_pictures(Pictures* pictures, RunReport& report) {
    if (!pictures) return;
    try {
        pictures->finish();
    } catch (const std::exception& error) {
        if (!report.interrupted) throw;
        say("scree: {}\n", error.what());
    }
    report.frames = pictures->count();
    report.seconds_drawing = pictures->times().draw;
    report.seconds_waiting = pictures->times().encode_wait;
}

std::vector<RunReport::RankCost> costs_of(Exchange& exchange, const RunReport& report) {
    const double steps = static_cast<double>(std::max<std::uint64_t>(1, report.steps - report.resumed_at));
    const RunReport::RankCost own{static_cast<double>(exchange.bytes_sent()) / steps,
                                  static_cast<double>(exchange.messages_sent()) / steps, exchange.seconds_waiting() * 1e3 / steps,
                                  report.peak_memory_bytes};
    Bytes said(sizeof own);
    std::memcpy(said.data(), &own, sizeof own);
    std::vector<RunReport::RankCost> all;
    for (const Bytes& told : exchange.all_gather(said)) std::memcpy(&all.emplace_back(), told.data(), sizeof own);
    return all;
}

}  // namespace

int work(const RunOptions& options, const LoadedScene& subject, const Backend& machine, World& world, Pictures* pictures,
         RunReport& report) {
    const auto start = std::chrono::steady_clock::now();
    std::optional<Adviser> adviser;
    const bool commanded = subject.before_step != nullptr || options.played.has_value();
    const bool sees_contacts = !options.exchange || options.exchange->ranks() == 1;
    if (options.advises && subject.others)
        adviser.emplace(world, subject.streamed(), commanded, sees_contacts);
    else if (options.advises)
        adviser.emplace(world, commanded, sees_contacts);
    Records records(options, subject, world);
    report.interrupted = !simulate(options, subject, world, pictures, records, adviser ? &*adviser : nullptr, report);
    complete_outputs();
    std::optional<TimedSlice> finishing(std::in_place, options.timeline.get(), "finish outputs");
    finish_pictures(pictures, report);
    records.finish();  // an interrupted run has them, too
    if (const std::optional<PageFigures> page = records.page()) {
        report.page_frames = page->frames;
        report.page_bytes = page->bytes;
        report.seconds_encoding_page = page->seconds_encoding;
    }
    report.vtk_moments = records.vtk_moments();
    finishing.reset();
    if (options.timeline) world.set_timeline(nullptr);
    if (options.timeline) options.timeline->finish();
    report.seconds_running = seconds_since(start);
    report.name = subject.name;
    report.promised = subject.promise.has_value();
    measure(world, report);
    if (!options.exchange && (options.measured || options.measures.any())) {
        Measuring at_the_end(MeasureRequest{}, world, options.copies.copy.value_or(0));
        report.grains = at_the_end.take(world).all;
    }
    hold_to_soundness(options.played.has_value(), world, report);
    hold_to_recording(options, report);
    if (adviser) report.advice = adviser->advice(world, report.statistics);
    report.seconds_total = seconds_since(report.started);
    report.peak_memory_bytes = host::peak_memory();
    if (options.exchange) report.ranks = costs_of(*options.exchange, report);
    if (!report.interrupted) machine.require_valid();
    conclude(options, subject, report);
    if (options.exchange && options.saves) (void)world.state();  // for the first rank
    if (!options.save.empty())
        host::write_atomically(options.save, scene_to_json(document_of(subject, world, options.copies.copy)));
    if (!report.interrupted) return all_pass(report.rows) ? done : promise_missed;
    if (options.speaks())
        say("scree: interrupted after {} steps{}\n", world.steps(),
            report.frames ? fmt::format(", {} pictures", report.frames) : "");
    return interrupted;
}

}  // namespace scree::demos
