// The simulation behind scree serve.
#include "demos/program/serve/live_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "demos/film/pages/page_parts.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/outputs/page_file.h"
#include "demos/scenes/demos.h"
#include "host/device_error.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_underway = 8;               // frames that a viewer has not seen
constexpr std::size_t most_bytes_underway = 3u << 20;  // unless it is one frame
constexpr auto longest_silence = std::chrono::seconds(20);
constexpr auto longest_trial = std::chrono::seconds(300);
constexpr double longest_debt = 0.1;                     // s of simulated time at full speed: a slow machine falls behind
constexpr double longest_work = 0.03;                    // s, until viewers are heard again
constexpr double state_every = 0.1, report_every = 0.5;  // s
constexpr std::size_t most_with_events = 20000;          // bodies

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

std::chrono::steady_clock::duration duration_of(double seconds) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

WebServer::Message message_of(const ordered_json& json) {
    return std::make_shared<const std::string>(json.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

host::Key key_named(const std::string& word) {
    if (word == "space") return host::Key::space;
    return host::key_of(static_cast<char>(word[0] - 'a' + 'A'));
}

ordered_json numbers(vec3 v) {
    return {v.x, v.y, v.z};
}

}  // namespace

bool LiveSession::Viewer::is_ready() const {
    return watches && (underway.empty() || (underway.size() < most_underway && bytes_underway < most_bytes_underway));
}

LiveSession::LiveSession(const ServeOptions& options, Backend machine, WebServer& server)
    : options_(options),
      machine_(std::move(machine)),
      server_(server),
      session_(
          options.scene, [this] { return machine_.make_runner(); },
          [this](World& world) {
              limit_memory(world, machine_);
              if (world.scene().bodies.size() <= most_with_events) ask_for_events(world);
          }),
      interaction_(session_) {
    interaction_.pace = static_cast<float>(options.speed);
    if (options.scene.steps || options.scene.seconds)
        last_step_ =
            static_cast<std::uint64_t>(options.scene.step_count(session_.subject().seconds, session_.world().settings().rate));
}

bool LiveSession::is_over() const {
    return is_interrupted() || (last_step_ && session_.world().steps() >= *last_step_);
}

// ---- viewers
void LiveSession::hear(const Heard& heard) {
    state_is_urgent_ = true;
    switch (heard.kind) {
        case Heard::Kind::came: {
            Viewer& viewer = viewers_[heard.viewer];
            viewer.progress = viewer.fluent = Clock::now();
            if (driver_ == 0 && viewers_.size() == 1) driver_ = heard.viewer;
            server_.send(heard.viewer, std::make_shared<const std::string>(welcome(heard.viewer)), false);
            told_state_.clear();
            break;
        }
        case Heard::Kind::left:
            leave(heard.viewer);
            break;
        case Heard::Kind::said:
            if (viewers_.count(heard.viewer) == 0) break;
            try {
                obey(heard.viewer, viewer_message(heard.text));
            } catch (const std::invalid_argument& error) {
                dismiss(heard.viewer, std::string("this message is not understood: ") + error.what());
            }
            break;
    }
}

void LiveSession::dismiss(std::uint64_t viewer, const std::string& reason) {
    server_.dismiss(viewer, reason);
    leave(viewer);
}

void LiveSession::leave(std::uint64_t viewer) {
    viewers_.erase(viewer);
    if (driver_ == viewer) leave_wheel();
}

void LiveSession::obey(std::uint64_t number, const ViewerMessage& message) {
    Viewer& viewer = viewers_.at(number);
    switch (message.deed) {
        case Deed::seen: {
            count_sent();
            const auto seen = static_cast<std::uint64_t>(message.number);
            if (seen > viewer.sent || seen < viewer.seen) throw std::invalid_argument("frames: none were sent like this");
            for (; viewer.seen < seen; ++viewer.seen) {
                viewer.bytes_underway -= viewer.underway.front();
                viewer.underway.pop_front();
            }
            viewer.progress = Clock::now();
            return;
        }
        case Deed::watch:
            viewer.watches = message.on;
            viewer.progress = viewer.fluent = Clock::now();
            return;
        case Deed::pace: {
            const double full = 1 / (static_cast<double>(every_) * step_seconds()) * static_cast<double>(interaction_.pace);
            viewer.slowest_asked = 0;
            while (viewer.slowest_asked + 1 < LiveStream::lanes &&
                   full / static_cast<double>(std::size_t{1} << viewer.slowest_asked) > 1.05 * message.number)
                ++viewer.slowest_asked;
            if (viewer.lane < viewer.slowest_asked) {
                viewer.lane = viewer.slowest_asked;
                viewer.in_step = false;
            }
            return;
        }
        case Deed::take:
            if (driver_ == 0) driver_ = number;
            return;
        default:
            if (number == driver_) obey_driver(message);  // else it has just lost the wheel
    }
}

// ---- the driver
void LiveSession::point(const PointerAt& at) {
    interaction_.look_from(at.view, at.extent);
    host::Event event;
    event.kind = host::EventKind::moved;
    event.x = at.x;
    event.y = at.y;
    interaction_.on(event);
}

void LiveSession::obey_driver(const ViewerMessage& message) {
    trouble_.clear();
    if (message.at) point(*message.at);
    host::Event event;
    switch (message.deed) {
        case Deed::yield:
            leave_wheel();
            break;
        case Deed::pause:
            interaction_.paused = message.on;
            break;
        case Deed::step:
            interaction_.paused = true;
            interaction_.step_once();
            break;
        case Deed::restart:
            interaction_.reset();
            break;
        case Deed::keep:
            kept_ = session_.moment();
            kept_scene_ = session_.options().name;
            break;
        case Deed::restore:
            if (kept_) interaction_.return_to(*kept_);
            break;
        case Deed::go:
            interaction_.go_to(static_cast<std::uint64_t>(message.number));
            break;
        case Deed::speed:
            interaction_.pace = static_cast<float>(message.number);
            break;
        case Deed::open:
            open(message);
            break;
        case Deed::set:
            if (message.gravity || message.substeps) {
                Turn turn;
                turn.gravity = message.gravity;
                turn.substeps = message.substeps;
                interaction_.perform(turn);
            }
            break;
        case Deed::press:
            interaction_.grab_body(*message.body);
            break;
        case Deed::release:
            event.kind = host::EventKind::released;
            interaction_.on(event);
            break;
        case Deed::wheel:
            if (!interaction_.held()) break;
            event.kind = host::EventKind::scrolled;
            event.amount = message.number;
            interaction_.on(event);
            break;
        case Deed::key:
            if (!interaction_.vehicle()) break;
            event.kind = message.on ? host::EventKind::key_pressed : host::EventKind::key_released;
            event.key = key_named(message.word);
            interaction_.on(event);
            break;
        case Deed::ball:
            interaction_.throw_body(Kind::sphere);
            break;
        case Deed::box:
            interaction_.throw_body(Kind::box);
            break;
        case Deed::explode:
            interaction_.explode();
            break;
        case Deed::undo:
            interaction_.undo();
            break;
        case Deed::remove:
            interaction_.remove_selected();
            break;
        case Deed::duplicate:
            interaction_.duplicate_selected();
            break;
        case Deed::righten:
            interaction_.reset_upright();
            break;
        case Deed::select:
            interaction_.select(message.body && has_body(session_.world(), *message.body) ? message.body : std::nullopt);
            break;
        default:
            break;
    }
}

void LiveSession::leave_wheel() {
    driver_ = 0;
    interaction_.let_all_go();
}

std::string LiveSession::shown_name() const {
    const std::string& name = session_.options().name;
    return find_demo(name) ? name : std::filesystem::path(name).filename().string();
}

// A demo, or the scene that serve was started with; no other file.
void LiveSession::open(const ViewerMessage& message) {
    const std::string& own = options_.scene.name;
    SceneOptions scene = options_.scene;
    const Demo* const demo = find_demo(message.word);
    if (!find_demo(own) && message.word == std::filesystem::path(own).filename().string()) {
        scene.name = own;
    } else if (demo) {
        scene.name = demo->name;
        if (scene.name != own) scene.edits.clear();
        if (scene.name != own && !message.bodies) scene.bodies = 0;
    } else {
        trouble_ = "there is no such demo";
        return;
    }
    if (message.bodies) scene.bodies = *message.bodies;
    if (demo && !demo->takes_bodies) scene.bodies = 0;
    const bool paused = interaction_.paused;
    interaction_.open(scene);
    interaction_.paused = paused;
    if (kept_ && kept_scene_ != session_.options().name) kept_.reset();
    last_step_.reset();
}

// ---- frames
// Another stream where the world began anew, or what frames depend on has changed.
void LiveSession::look_after_stream() {
    World& world = session_.world();
    const double fps = std::min(options_.pictures.fps, 30.0);
    const auto every = static_cast<std::uint64_t>(
        std::max(1L, std::lround(static_cast<double>(world.settings().rate * interaction_.pace) / fps)));
    const bool same = stream_ && streamed_beginning_ == session_.beginnings() && streamed_gravity_ == world.scene().gravity &&
                      streamed_substeps_ == world.settings().substeps && every_ == every;
    if (same) return;
    if (stream_) {
        stream_->wait();
        earlier_figures_ += stream_->figures();
    }
    stream_.reset();
    PageOptions page = page_options(options_.pictures, session_.subject(), world, false);
    page.events = world.scene().bodies.size() <= most_with_events;
    stream_ = std::make_unique<LiveStream>(world, std::move(page), static_cast<double>(every) * step_seconds(),
                                           [this](const std::vector<std::uint64_t>& viewers, LiveStream::Message frame) {
                                               {  // before a viewer can say that it has seen it
                                                   const std::lock_guard lock(sent_mutex_);
                                                   for (const std::uint64_t viewer : viewers)
                                                       sent_.emplace_back(viewer, frame->size());
                                               }
                                               for (const std::uint64_t viewer : viewers) server_.send(viewer, frame, true);
                                           });
    streamed_beginning_ = session_.beginnings();
    streamed_gravity_ = world.scene().gravity;
    streamed_substeps_ = world.settings().substeps;
    every_ = every;
    ticks_ = 0;
    for (auto& [number, viewer] : viewers_) viewer.begun = viewer.in_step = false;
    frame_is_due_ = true;
}

// What the encoder has sent since.
void LiveSession::count_sent() {
    std::vector<std::pair<std::uint64_t, std::size_t>> sent;
    {
        const std::lock_guard lock(sent_mutex_);
        sent.swap(sent_);
    }
    for (const auto& [number, bytes] : sent) {
        const auto found = viewers_.find(number);
        if (found == viewers_.end()) continue;
        Viewer& viewer = found->second;
        if (viewer.underway.empty()) viewer.progress = Clock::now();
        ++viewer.sent;
        viewer.underway.push_back(bytes);
        viewer.bytes_underway += bytes;
    }
}

// Who keeps up for long gets more frames again.
void LiveSession::promote(Viewer& viewer, Clock::time_point now) {
    if (viewer.lane <= viewer.slowest_asked || now - viewer.fluent < viewer.trial) return;
    --viewer.lane;
    viewer.in_step = false;
    viewer.fluent = now;
}

void LiveSession::tick() {
    look_after_stream();
    World& world = session_.world();
    const std::uint64_t step = world.steps();
    const bool moved = step >= told_step_ + every_ || step < told_step_ || (interaction_.paused && step != told_step_);
    const bool edited = session_.acts() != told_acts_;
    const bool somebody_begins = std::any_of(viewers_.begin(), viewers_.end(),
                                             [](const auto& each) { return !each.second.in_step && each.second.is_ready(); });
    const Clock::time_point now = Clock::now();
    const bool soon = now - told_at_ < std::chrono::milliseconds(30);
    if (!moved && !frame_is_due_ && !((edited || somebody_begins) && !soon)) return;
    if (stream_->is_busy()) return;
    count_sent();
    frame_is_due_ = false;
    told_at_ = now;
    told_step_ = step;
    told_acts_ = session_.acts();
    if (const LiveStream::Message news = stream_->news(world))
        for (const auto& [number, viewer] : viewers_)
            if (viewer.begun) server_.send(number, news, true);
    std::array<std::vector<std::uint64_t>, LiveStream::lanes> follow, begin, lag;
    for (auto& [number, viewer] : viewers_) {
        promote(viewer, now);
        if (ticks_ % (std::uint64_t{1} << viewer.lane) != 0 && viewer.in_step) continue;
        if (!viewer.is_ready())
            lag[viewer.lane].push_back(number);
        else
            (viewer.in_step ? follow : begin)[viewer.lane].push_back(number);
    }
    ++ticks_;
    std::array<LiveStream::Message, LiveStream::lanes> beginnings, heads;
    std::vector<LiveStream::Audience> audiences;
    for (std::size_t lane = 0; lane < LiveStream::lanes; ++lane) {
        if (follow[lane].empty() && begin[lane].empty()) continue;  // who lags misses nothing
        for (const std::uint64_t number : begin[lane]) {
            Viewer& viewer = viewers_.at(number);
            if (!viewer.begun) {
                if (!beginnings[lane]) beginnings[lane] = stream_->beginning(lane);
                server_.send(number, message_of({{"type", "begin"}, {"scene", shown_name()}, {"beginning", streamed_beginning_}}),
                             false);
                server_.send(number, beginnings[lane], true);
            } else {
                if (!heads[lane]) heads[lane] = stream_->head(lane);
                server_.send(number, heads[lane], true);
            }
            viewer.begun = viewer.in_step = true;
        }
        // Who lags behind others moves to a slower lane.
        for (const std::uint64_t number : lag[lane]) {
            Viewer& viewer = viewers_.at(number);
            if (!viewer.in_step) continue;
            viewer.in_step = false;
            if (!viewer.watches) continue;
            if (viewer.lane + 1 < LiveStream::lanes) ++viewer.lane;
            viewer.trial = std::min<std::chrono::seconds>(2 * viewer.trial, longest_trial);
            viewer.fluent = now;
        }
        LiveStream::Audience audience;
        audience.lane = lane;
        audience.whole = !begin[lane].empty();
        audience.viewers = follow[lane];
        audience.viewers.insert(audience.viewers.end(), begin[lane].begin(), begin[lane].end());
        // Those in the midst of the lane's interval stay in step with it as well.
        for (auto& [number, viewer] : viewers_)
            if (viewer.lane == lane && viewer.in_step &&
                std::find(audience.viewers.begin(), audience.viewers.end(), number) == audience.viewers.end()) {
                if (viewer.is_ready())
                    audience.viewers.push_back(number);
                else
                    viewer.in_step = false;
            }
        audiences.push_back(std::move(audience));
    }
    stream_->tick(world, audiences);
    count_sent();
}

// Viewers that see nothing of what was sent to them.
void LiveSession::drop_the_stuck() {
    const Clock::time_point now = Clock::now();
    std::vector<std::uint64_t> stuck;
    for (const auto& [number, viewer] : viewers_)
        if (viewer.watches && !viewer.underway.empty() && now - viewer.progress > longest_silence) stuck.push_back(number);
    for (const std::uint64_t number : stuck) dismiss(number, "this viewer cannot keep up: it has seen no frame for 20 seconds");
}

// ---- what viewers are told
std::string LiveSession::welcome(std::uint64_t viewer) const {
    ordered_json demos = ordered_json::array();
    const std::string& own = options_.scene.name;
    if (!find_demo(own))
        demos.push_back(
            {{"name", std::filesystem::path(own).filename().string()}, {"line", "the scene of this server"}, {"bodies", 0}});
    for (const Demo& demo : all_demos()) {
        if (demo.trial && own != demo.name) continue;
        demos.push_back({{"name", demo.name}, {"line", demo.line}, {"bodies", demo.takes_bodies ? demo.bodies : 0}});
    }
    return *message_of({{"type", "hello"}, {"you", viewer}, {"demos", std::move(demos)}});
}

std::string LiveSession::state() const {
    const World& world = session_.world();
    ordered_json json = {{"type", "state"},
                         {"driver", driver_},
                         {"viewers", viewers_.size()},
                         {"scene", shown_name()},
                         {"bodies", session_.options().bodies},
                         {"there", world.bodies_there()},
                         {"paused", interaction_.paused},
                         {"speed", interaction_.pace},
                         {"real_speed", std::round(real_pace_ * 100) / 100},
                         {"step", world.steps()},
                         {"farthest", session_.farthest_step()},
                         {"seconds", world.time()},
                         {"rate", world.settings().rate},
                         {"substeps", world.settings().substeps},
                         {"gravity", numbers(world.scene().gravity)},
                         {"step_ms", std::round(interaction_.milliseconds_a_step() * 100) / 100},
                         {"held", nullptr},
                         {"kept", nullptr},
                         {"vehicle", nullptr},
                         {"message", trouble_.empty() ? interaction_.message() : trouble_}};
    if (interaction_.held()) json["held"] = *interaction_.held();
    if (kept_) json["kept"] = static_cast<double>(kept_->input.steps) * step_seconds();
    if (const std::optional<std::size_t> vehicle = interaction_.vehicle()) {
        const VehicleState driven = world.vehicle(*vehicle);
        json["vehicle"] = {{"body", world.scene().vehicles[*vehicle].chassis},
                           {"speed", std::round(driven.speed * 100) / 100},
                           {"by_route", driven.by_route}};
    }
    return *message_of(json);
}

void LiveSession::send_state() {
    const Clock::time_point now = Clock::now();
    if (viewers_.empty() || (!state_is_urgent_ && seconds_between(stated_at_, now) < state_every)) return;
    state_is_urgent_ = false;
    stated_at_ = now;
    std::string text = state();
    if (text == told_state_) return;
    told_state_ = std::move(text);
    const auto message = std::make_shared<const std::string>(told_state_);
    for (const auto& [number, viewer] : viewers_) server_.send(number, message, false);
}

void LiveSession::write_report() {
    if (options_.report.empty()) return;
    World& world = session_.world();
    StreamFigures all = earlier_figures_;
    if (stream_) all += stream_->figures();
    const double frames = static_cast<double>(std::max<std::uint64_t>(all.frames, 1));
    const ordered_json json = {{"demo", session_.subject().name},
                               {"backend", world.runner().backend()},
                               {"device", world.runner().device()},
                               {"bodies", world.bodies_there()},
                               {"steps", world.steps()},
                               {"state_hash", hash_text(world.state_hash())},
                               {"paused", interaction_.paused},
                               {"viewers", viewers_.size()},
                               {"frames", all.frames},
                               {"bytes_of_frames", all.bytes},
                               {"ms_looking", 1000 * all.seconds_looking / frames},
                               {"ms_encoding", 1000 * all.seconds_encoding / frames},
                               {"ms_packing", 1000 * all.seconds_packing / frames},
                               {"milliseconds_a_step", interaction_.milliseconds_a_step()},
                               {"speed", real_pace_},
                               {"seconds", seconds_between(started_, Clock::now())}};
    host::write_atomically(options_.report, json.dump(1) + "\n");
}

// ---- the clock
void LiveSession::advance(double seconds) {
    const double pace = static_cast<double>(interaction_.pace), step = step_seconds();
    if (interaction_.paused) {
        debt_ = 0;
        interaction_.advance(0);  // single steps
        return;
    }
    debt_ = std::min(debt_ + seconds * pace, std::max(longest_debt * pace, 1.5 * step));
    const Clock::time_point begun = Clock::now();
    while (debt_ >= step && !is_over() && seconds_between(begun, Clock::now()) < longest_work) {
        debt_ -= step;
        interaction_.advance(step / pace);  // one step
        tick();
    }
}

// What fails, such as for memory that a step or a frame lacks, pauses the world and is told; viewers then begin anew.
template <typename Work>
void LiveSession::attempt(const Work& work) {
    try {
        work();
    } catch (const host::DeviceError&) {
        throw;
    } catch (const UsageError&) {
        throw;
    } catch (const std::exception& error) {
        interaction_.paused = true;
        trouble_ = error.what();
        state_is_urgent_ = true;
        stream_.reset();
    }
}

void LiveSession::run() {
    Clock::time_point before = Clock::now(), reported = before;
    while (!is_over()) {
        const bool rests = interaction_.paused || viewers_.empty();
        const double pause = rests ? 0.05 : std::max(0.0, (step_seconds() - debt_) / static_cast<double>(interaction_.pace));
        for (const Heard& heard : server_.hear(Clock::now() + duration_of(std::min(pause, 0.05)))) attempt([&] { hear(heard); });
        const Clock::time_point now = Clock::now();
        const double seconds = seconds_between(std::exchange(before, now), now);
        if (!viewers_.empty()) {
            attempt([&] { advance(seconds); });
            attempt([&] { tick(); });
        }
        const double passed = seconds_between(paced_at_, now);
        if (passed > 1) {
            const double time = session_.world().time();
            real_pace_ = time >= paced_time_ ? (time - paced_time_) / passed : real_pace_;
            paced_time_ = time;
            paced_at_ = now;
        }
        drop_the_stuck();
        send_state();
        if (seconds_between(reported, now) < report_every) continue;
        write_report();
        reported = now;
    }
}

}  // namespace scree::demos
