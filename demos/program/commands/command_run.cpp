// scree run: simulates a demo or a scene file, with pictures and a report, and judges its promise.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>

#include "compute/distributed/distributed.h"
#include "demos/film/annotations.h"
#include "demos/film/pictures.h"
#include "demos/play/replay.h"
#include "demos/program/advice/adviser.h"
#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/copies.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/output_check.h"
#include "demos/program/outputs/checkpoints.h"
#include "demos/program/outputs/export_file.h"
#include "demos/program/outputs/measures_file.h"
#include "demos/program/outputs/page_file.h"
#include "demos/program/outputs/report.h"
#include "demos/program/outputs/trace_file.h"
#include "demos/program/outputs/trajectory.h"
#include "demos/program/progress.h"
#include "demos/program/ranks.h"
#include "demos/scenes/demos.h"
#include "demos/suite/recorder.h"
#include "host/files/file.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

struct RunOptions {
    SceneOptions scene;
    MachineOptions machine;
    PictureOptions pictures;
    CopyOptions copies;
    CheckpointOptions checkpoints;
    TrajectoryOptions trajectory;
    ExportOptions animation;
    MeasureOptions measures;
    TraceOptions trace;
    std::shared_ptr<TraceFile> timeline = nullptr;  // what --trace asks for; may be null
    std::string report;
    std::string save;             // file for the final scene; may be empty
    std::string input;            // file of recorded input; may be empty
    std::optional<Input> played;  // the recorded input
    std::optional<ResumedRun> resumed;
    std::optional<MeasureRequest> measured;  // what the scene or --measures asks for
    bool quiet = false;
    std::string command_line;
    CopiesShown shown{};
    bool distributed = false;
    std::shared_ptr<Exchange> exchange = nullptr;  // with the other ranks; null: the run is not distributed
    // What all ranks do alike, though the first alone has outputs: see silent().
    bool advises = false, draws = false, is_watched = false, saves = false;
    bool speaks() const { return !exchange || exchange->rank() == 0; }
};

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

// What must be known before hours of work: that its result can be written.
void require_writable(const RunOptions& options) {
    if (options.pictures.takes_output() && options.report == "-") {
        throw UsageError("--raw - and --report -: the standard output is for one of them; name a file for the other");
    }
    if (options.save == "-") throw UsageError("--save -: name a file");
    require_writable_file("--report", options.report);
    require_writable_file("--save", options.save);
    require_sense(options.checkpoints);
    require_writable_file("--cameras", options.pictures.cameras);
    require_writable_file("--html", options.pictures.html);
}

void require_steps_for_pictures(const RunOptions& options, float rate) {
    if (!options.pictures.shown() || options.pictures.fps <= static_cast<double>(rate)) return;
    throw UsageError(
        fmt::format("--fps {:g}: more pictures than steps; at most --rate, which is {:g}", options.pictures.fps, rate));
}

// A picture that is asked for must be of the run.
void require_moments(const RunOptions& options, const LoadedScene& subject) {
    const Settings settings = subject.settings(options.scene);
    const double end = options.scene.step_count(subject.seconds, settings.rate) / static_cast<double>(settings.rate);
    if (options.pictures.from <= end + 0.5 / static_cast<double>(settings.rate)) return;
    throw UsageError(fmt::format("--frame-{} {:g}: the run ends at {:g} s; ask for more --seconds",
                                 options.pictures.until == options.pictures.from ? "at" : "range", options.pictures.from, end));
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

// The speed limit is a setting, so scene validation cannot check it.
void note_clamped_speeds(const LoadedScene& subject, const Settings& settings) {
    std::size_t count = 0;
    const auto look = [&](const Body& body) {
        const vec3 v = body.velocity;  // squares of large floats overflow
        count += body.motion == Motion::dynamic && std::hypot(static_cast<double>(v.x), static_cast<double>(v.y),
                                                              static_cast<double>(v.z)) > static_cast<double>(settings.max_speed);
    };
    std::ranges::for_each(subject.scene.bodies, look);
    if (subject.others) subject.others(look);
    if (count == 0) return;
    say("scree: note: {} faster than {:g} m/s and {} slowed to that\n",
        count == 1 ? "1 body starts" : fmt::format("{} bodies start", count), settings.max_speed, count == 1 ? "is" : "are");
}

// An event belongs to the step whose start is nearest (compute/scene_file/events.h).
void note_late_events(const LoadedScene& subject, const SceneOptions& options) {
    const float rate = subject.settings(options).rate;
    const int steps = options.step_count(subject.seconds, rate);
    for (std::size_t i = 0; i < subject.events.size(); ++i) {
        const double time = static_cast<double>(subject.events[i].time);
        if (std::llround(time * static_cast<double>(rate)) < steps) continue;
        say("scree: note: /events/{} at {:g} s does not happen: the run ends at {:g} s; ask for more --seconds\n", i, time,
            steps / static_cast<double>(rate));
    }
}

// Takes the scene, but for outputs that need it, too: of many bodies it is as large as their tables.
World world_of(LoadedScene& subject, const RunOptions& run, const Settings& settings, std::unique_ptr<Runner> runner,
               const VaryCopy& vary) {
    const std::size_t copies = run.copies.copies;
    if (subject.others) return {subject.streamed(), settings, std::move(runner)};
    if (copies == 0 && (run.draws || !run.pictures.html.empty())) return {subject.scene, settings, std::move(runner)};
    if (copies == 0) return {std::move(subject.scene), settings, std::move(runner)};
    try {
        return {subject.scene, settings, std::move(runner), copies, vary};
    } catch (const SceneError& error) {
        throw UsageError(std::string("--vary: ") + error.what());
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("--vary: ") + error.what());
    }
}

// Pictures of a world on ranks are drawn from tables of the host: a rank's device has the bodies near its own alone.
Backend drawing_from_host(Backend machine) {
    if (machine.device) machine.screen = std::exchange(machine.device, nullptr);
    return machine;
}

// Ranks read a scene one body after the other if no output needs the bodies of the start.
LoadedScene load(const RunOptions& options) {
    const bool needs_all = options.draws || options.saves || options.is_watched || options.resumed.has_value();
    if (!options.exchange || needs_all) return load_subject(options.scene);
    return load_streamed(options.scene, options.exchange->ranks());
}

int run(RunOptions options) {
    RunReport report;
    report.started_at = date_and_time();
    require_writable(options);
    if (!options.trace.file.empty())
        options.timeline = std::make_shared<TraceFile>(options.trace.file, "scree run " + options.scene.name);
    std::optional<TimedSlice> preparing(std::in_place, options.timeline.get(), "load the scene");
    LoadedScene subject = load(options);
    require_steps_for_pictures(options, subject.settings(options.scene).rate);
    require_sense(options.copies, subject);
    require_moments(options, subject);
    if (options.pictures.annotations == "bop" && subject.viewpoint.orthographic)
        throw UsageError("--annotations bop: its cameras have a focal length, and the scene's is orthographic");
    options.measured = measures_asked(options.measures, subject.measures, subject.scene);
    const VaryCopy vary = vary_of(options.copies, options.scene);
    if (options.copies.copies) subject.promise.reset();  // it is of the scene alone
    if (options.played) {                                // replay the commands; the demo's promise does not apply
        subject.before_step = script_of(*options.played, options.input, std::move(subject.before_step));
        subject.promise.reset();
    }
    preparing.emplace(options.timeline.get(), "choose the backend");
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    if (!machine.remark.empty() && !options.quiet) say("scree: {}\n", machine.remark);
    if (!options.quiet) note_clamped_speeds(subject, subject.settings(options.scene));
    if (!options.quiet) note_late_events(subject, options.scene);
    preparing.emplace(options.timeline.get(), "make the world");
    std::unique_ptr<Runner> runner = options.exchange ? machine.make_runner(options.exchange) : machine.make_runner();
    if (!options.report.empty()) report.scene_hash = subject.others ? hash_of(subject.streamed()) : hash_of(subject.scene);
    World world = world_of(subject, options, subject.settings(options.scene), std::move(runner), vary);
    limit_memory(world, machine);
    report.copies = options.copies.copies;
    report.varied = options.copies.vary;
    if (options.resumed) {
        resume(world, *options.resumed, options.checkpoints.resume);
        options.resumed->file = {};  // as large as the world's tables
        subject.promise.reset();     // it is judged over the whole run
        report.resumed_at = world.steps();
    }
    std::optional<Pictures> pictures;
    preparing.emplace(options.timeline.get(), "make the canvas");
    if (options.pictures.shown()) options.shown = shown_of(options.copies, subject);
    if (options.draws) {
        pictures.emplace(options.pictures, options.exchange ? drawing_from_host(machine) : machine, subject, world,
                         options.shown);
        if (options.exchange && !options.saves && options.pictures.html.empty()) subject.scene = {};  // as large as its tables
    }
    if (pictures) report.canvas = pictures->canvas();
    report.driver = machine.driver();
    report.arithmetic_fault = machine.arithmetic_fault();
    report.command_line = options.command_line;
    if (find_demo(options.scene.name)) report.seed = options.scene.seed;
    preparing.reset();
    if (options.timeline) {
        options.timeline->name_queue(world.runner().device());
        world.set_timeline(options.timeline);
    }
    return at_work([&] { return work(options, subject, machine, world, pictures ? &*pictures : nullptr, report); });
}

template <typename Value>
Value word_for(const Value& value) {
    return value;
}
template <typename Value>
Value word_for(const std::optional<Value>& value) {
    return value.value_or(Value{});
}
// The options of a recording or checkpoint, and its number of steps unless given. Throws UsageError if other options on the
// command line (scene, --bodies, --seed, ...) contradict it.
SceneOptions with_recorded(const CLI::App& command, SceneOptions options, const SceneOptions& recorded, const std::string& what) {
    const auto agree = [&](const char* option, auto& named, const auto& found) {
        if (command.count(option) != 0 && named != found)
            throw UsageError(fmt::format("{}: the {} says {}, the command line {}; leave the option out", option, what,
                                         word_for(found), word_for(named)));
        named = found;
    };
    agree("scene", options.name, recorded.name);
    agree("--bodies", options.bodies, recorded.bodies);
    agree("--seed", options.seed, recorded.seed);
    agree("--rate", options.rate, recorded.rate);
    agree("--substeps", options.substeps, recorded.substeps);
    agree("--no-sleep", options.sleeping, recorded.sleeping);
    if (!options.steps && !options.seconds) options.steps = recorded.steps;
    return options;
}

SceneOptions options_of(const Input& input) {
    SceneOptions options;
    options.name = input.scene;
    options.bodies = input.bodies;
    options.seed = input.seed;
    options.rate = input.rate;
    options.substeps = input.substeps;
    options.sleeping = input.sleeping;
    options.steps = static_cast<int>(std::max<std::uint64_t>(1, input.steps));
    return options;
}

void take_resumed(const CLI::App& command, RunOptions& options) {
    const std::string& path = options.checkpoints.resume;
    const ResumedRun& resumed = options.resumed.emplace(load_resumed(path));
    options.scene = with_recorded(command, options.scene, resumed.scene, "checkpoint " + path);
    if (options.input.empty()) options.input = resumed.input;
    const int steps = options.scene.step_count(0, *resumed.scene.rate);
    if (static_cast<std::uint64_t>(steps) >= resumed.info.steps) return;
    throw UsageError(fmt::format("--resume {}: it was saved after {} steps, and the run is to have {} in all; ask for more", path,
                                 resumed.info.steps, steps));
}

void require_distinct_outputs(const RunOptions& options) {
    require_distinct({{"--video", options.pictures.video},
                      {"--preview", options.pictures.preview},
                      {"--raw", options.pictures.raw},
                      {"--html", options.pictures.html},
                      {"--cameras", options.pictures.cameras},
                      {"--report", options.report},
                      {"--save", options.save},
                      {"--checkpoint", options.checkpoints.file},
                      {"--trajectory", options.trajectory.file},
                      {"--measures-out", options.measures.table},
                      {"--export", options.animation.file},
                      {"--trace", options.trace.file}});
}

// What does not work on several ranks.
void require_sense_on_ranks(const CLI::App& command, const RunOptions& options) {
    const bool on_devices = options.machine.backend == "vulkan";
    if (!on_devices && command.count("--device") + command.count("--validate") != 0)
        throw UsageError("--distributed: --device and --validate are for ranks on devices, with --backend vulkan");
    if (options.measures.any())
        throw UsageError("--distributed: --measures, --measures-out and --vtk are for runs of one process; leave them out");
    if (command.count("--copies") != 0) throw UsageError("--distributed: not together with --copies");
}

// Every rank does the same, and the first alone writes and speaks.
void make_silent(RunOptions& options) {
    options.quiet = true;
    for (std::string* file : {&options.report, &options.save, &options.trajectory.file, &options.animation.file,
                              &options.trace.file, &options.pictures.frames, &options.pictures.video, &options.pictures.preview,
                              &options.pictures.raw, &options.pictures.html})
        file->clear();
}

int run(const CLI::App& command, RunOptions options) {
    options.pictures.require_sense(command);
    if (!options.pictures.annotations.empty()) options.pictures.legend = options.pictures.caption = false;
    const OutputFolder frames(folder_of_frames(options.pictures)), vtk(options.measures.vtk);
    require_distinct_outputs(options);
    require_sense(command, options.copies);
    require_sense(command, options.trajectory);
    require_sense(command, options.animation);
    require_sense(command, options.measures);
    if (!options.measures.vtk.empty() && command.count("--copies") != 0)
        throw UsageError("--vtk: not together with --copies, which lie one on the other; run the scene alone");
    require_sense(command, options.trace);
    if (!options.checkpoints.resume.empty()) take_resumed(command, options);
    if (!options.input.empty()) {
        options.played = load_input(options.input);
        options.scene = with_recorded(command, options.scene, options_of(*options.played), "recording " + options.input);
    } else if (options.scene.name.empty()) {
        throw UsageError(
            "run: name a demo (scree list) or a scene file, or give a recording with --input or a checkpoint with --resume");
    }
    lay_over(options.animation, options.scene.name, options.scene.imported);
    options.advises = !options.quiet || !options.report.empty();
    options.draws = options.pictures.wanted();
    if (options.pictures.until && !options.scene.steps && !options.scene.seconds)
        options.scene.seconds = std::max(*options.pictures.until, 1e-3);
    if (!options.distributed) return run(options);
    require_sense_on_ranks(command, options);
    Neighbours neighbours;
    options.exchange = join_ranks(neighbours);
    const bool on_devices = options.machine.backend == "vulkan";
    if (!on_devices) options.machine.backend = "cpu";
    if (!on_devices && options.machine.threads == 0)
        options.machine.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / neighbours.count);
    if (on_devices && options.machine.device.empty()) options.machine.device = device_of_rank(neighbours.place);
    options.is_watched = !options.trajectory.file.empty() || !options.animation.file.empty() || !options.pictures.html.empty();
    options.saves = !options.save.empty();
    if (!options.speaks()) make_silent(options);
    const std::shared_ptr<Exchange> exchange = options.exchange;  // until the world is gone
    return on_a_rank(*exchange, [&] { return run(options); });
}

}  // namespace

void add_run(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("run", "Simulate a demo or a scene file headlessly");
    auto options = std::make_shared<RunOptions>();
    add_options(*command, options->scene);
    add_options(*command, options->machine);
    add_options(*command, options->pictures);
    add_options(*command, options->copies);
    add_options(*command, options->checkpoints);
    add_options(*command, options->trajectory);
    add_options(*command, options->animation);
    add_options(*command, options->measures);
    add_options(*command, options->trace);
    command->add_option("--report", options->report, "JSON report file; - is the standard output.");
    command->add_option("--save", options->save, "Scene file of the final state, to continue from in scree or elsewhere.");
    command->add_option(
        "--input", options->input,
        "Replay a recording of `scree view --record`: its scene, settings, steps and commands, to the same bits.");
    command
        ->add_flag(
            "--distributed", options->distributed,
            "One world on all processes that mpirun started, to the same bits; each moves a share of the bodies, on "
            "processors, or with --backend vulkan on a device each, and holds that share alone where the scene allows. The "
            "first one writes.")
        ->group("Backend");
    command->get_option("scene")->required(false);
    command->add_flag("--quiet,-q", options->quiet, "Print no progress and no summary.");
    command->footer(
        "Examples:\n  scree run tower\n  scree run --input played.json --video played.mp4\n  scree run avalanche --bodies 20k "
        "--seconds 10 --video avalanche.mp4\n"
        "  scree run wall --camera fit,orbit:10 --preview wall.gif\n"
        "  scree run dominoes --camera follow:7 --preview dominoes.gif\n"
        "  scree run scene.json --backend cpu --threads 4 --report -\n"
        "  scree run robot.urdf --base free --ground --seconds 5 --video robot.mp4\n"
        "  scree run quadruped.xml --keyframe home --report -\n"
        "  scree run pile --bodies 10k --no-sleep --seconds 15 --save settled.json\n"
        "  scree run settled.json --video later.mp4\n"
        "  scree run avalanche --bodies 100k --seconds 60 --checkpoint run.checkpoint --every 5\n"
        "  scree run --resume run.checkpoint --checkpoint run.checkpoint\n"
        "  scree run pile --frames out --channels depth,ids,normals,flow --size 640x480\n"
        "  scree run clutter.json --frames set --annotations coco --size 640x480\n"
        "  scree run dominoes --trajectory run.npz\n"
        "  scree run wrecking --export wrecking.glb\n"
        "  scree run glass --html glass.html\n"
        "  scree run avalanche --bodies 50k --export avalanche.usda --export-every 2\n"
        "  scree run pile --bodies 10k --seconds 2 --trace trace.json\n"
        "  scree run hopper.json --measures-out hopper.csv --vtk hopper\n"
        "  scree run bins --copies 1k --vary seed,friction=0.2:0.8 --video bins.mp4\n"
        "  mpirun -n 4 scree run pile --bodies 100k --distributed\n"
        "  mpirun -n 2 scree run pile --bodies 100k --distributed --backend vulkan");
    command->callback([command, options, &status] {
        options->command_line = words_of_this_program();
        status = run(*command, *options);
    });
}

}  // namespace scree::demos
