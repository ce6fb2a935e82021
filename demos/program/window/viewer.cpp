// The window with its session, interaction, drawing and panel.
#include "demos/program/window/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "demos/film/pictures.h"
#include "demos/film/style.h"
#include "demos/program/console.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/option_parsing.h"
#include "host/files/file.h"
#include "host/pictures/image.h"
#include "host/vulkan/device.h"

namespace scree::demos {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double report_every = 0.5;                   // s
constexpr float least_text = 0.6f, greatest_text = 4;  // as the options of scree view allow

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

// An event rate, averaged over about a second.
class Meter {
public:
    void count(std::uint64_t events, double seconds) {
        events_ += static_cast<double>(events);
        seconds_ += seconds;
        if (seconds_ < 0.5) return;
        rate_ = events_ / seconds_;
        events_ = seconds_ = 0;
    }
    double rate() const { return rate_; }

private:
    double events_ = 0, seconds_ = 0, rate_ = 0;
};

std::array<float, 3> light_of(const PictureStyle& style) {
    return {static_cast<float>(style.sky), style.sun_azimuth, style.sun_elevation};
}

host::Camera camera_of(const OrbitCamera& eye) {
    host::Camera camera;
    const Viewpoint view = eye.viewpoint();
    camera.eye = view.eye;
    camera.target = view.target;
    camera.vertical_fov = view.vertical_fov;
    return camera;
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, const host::Display& display, Backend machine)
    : options_(options),
      machine_(std::move(machine)),
      session_(
          options.scene, [this] { return machine_.make_runner(); }, [this](World& world) { limit_memory(world, machine_); }),
      interaction_(session_, options.extent),
      window_(display, machine_.screen, "scree", options.extent.width, options.extent.height),
      detail_(machine_.screen->report().is_processor) {
    panel_.text_scale = options.text_scale;
    if (options.scene.steps || options.scene.seconds)
        last_step_ =
            static_cast<std::uint64_t>(options.scene.step_count(session_.subject().seconds, session_.world().settings().rate));
}

bool Viewer::is_over() {
    const bool all_steps = last_step_ && session_.world().steps() >= *last_step_;
    return all_steps || window_.wants_to_close() || interaction_.wants_to_close() || is_interrupted();
}

void Viewer::take_events(double wait) {
    for (const host::Event& event : window_.poll(wait)) {
        if (event.kind != host::EventKind::key_pressed) {
            interaction_.on(event);
            continue;
        }
        if (event.key == host::Key::escape && panel_.closes_something(host::Window::edits_text())) continue;
        if (!panel_.chooser.shown()) press_key(event);  // what is typed there is no command
    }
}

void Viewer::press_key(const host::Event& event) {
    interaction_.on(event);
    const auto is = [&](char character) { return event.key == host::key_of(character); };
    if (event.control) {
        if (is('+')) panel_.text_scale = std::min(panel_.text_scale * 1.15f, greatest_text);
        if (is('-')) panel_.text_scale = std::max(panel_.text_scale / 1.15f, least_text);
        if (is('0')) panel_.text_scale = 1;
        return;
    }
    if (is('O')) {
        window_.forget_text(event);
        panel_.chooser.show();
    }
    if (event.key == host::Key::f1 || (is('/') && event.shift)) panel_.help_shown = !panel_.help_shown;
    if (is('H')) panel_.shown = !panel_.shown;
    const int overlay = static_cast<int>(event.key) - '4';
    if (overlay >= 0 && overlay < static_cast<int>(overlay_words().size()))
        set_shown(style_, static_cast<Overlay>(overlay), !shows(style_, static_cast<Overlay>(overlay)));
}

// The scene's style for each scene that is opened.
void Viewer::choose_style() {
    if (styled_ == session_.subject().name) return;
    styled_ = session_.subject().name;
    style_ = style_of(options_.pictures, session_.subject().style);
    scale_.reset();
}

// Recreates the drawing for another world, size or choice of overlays; returns whether it did.
bool Viewer::make_drawing() {
    const auto side = [&](int pixels) { return std::max(16, static_cast<int>(static_cast<float>(pixels) / detail_.divisor())); };
    const Extent extent{side(window_.width()), side(window_.height())};
    const bool same = drawing_ && drawn_beginning_ == session_.beginnings() && drawn_extent_.width == extent.width &&
                      drawn_extent_.height == extent.height && drawn_overlays_ == style_.show && drawn_light_ == light_of(style_);
    if (same) return false;
    host::CanvasOptions canvas;
    canvas.width = extent.width;
    canvas.height = extent.height;
    canvas.stays = true;
    canvas.smooth = detail_.divisor() == 1;
    canvas.legend = false;  // the panel has it, at the window's size
    show_overlays(style_, session_.world(), canvas);
    show_light(style_, canvas);
    drawing_.reset();
    drawing_ = std::make_unique<Drawing>("vulkan", machine_, session_.world(), canvas);
    if (drawn_beginning_ != session_.beginnings()) window_.set_title("scree: " + session_.subject().title());
    drawn_beginning_ = session_.beginnings();
    drawn_extent_ = extent;
    drawn_overlays_ = style_.show;
    drawn_light_ = light_of(style_);
    return true;
}

// The range of the scene, and without one of its own what is measured.
void Viewer::measure_range(double seconds) {
    constexpr double every = 0.5;  // s
    const World& world = session_.world();
    if (!scale_ || !(scaled_ == style_)) {
        scale_ = scale_of(style_, session_.subject(), world.settings(), false);
        scaled_ = style_;
        range_ = MeasuredRange(scale_->high);
        least_of_range_ = 1e-3 * static_cast<double>(scale_->high);
        measured_ = 0;
    }
    measured_ += seconds;
    if (style_.range.x < style_.range.y || measured_ < every) return;
    const std::vector<double> values = values_now(world, word_of(style_.color));
    if (values.empty()) return;
    const double seen = std::max(nearly_greatest(values), least_of_range_);
    if (range_.update(seen, std::exchange(measured_, 0.0))) scale_->high = range_.high();
}

void Viewer::draw() {
    if (window_.width() < 16 || window_.height() < 16) return;  // minimised
    choose_style();
    const LoadedScene& subject = session_.subject();
    const World& world = session_.world();
    window_.set_text_scale(panel_.text_scale);
    window_.begin_panel(panel_.chooser.takes_keys());
    const Wishes wishes = panel_.lay_out(session_, interaction_, rates_, style_);
    const std::string caption =
        panel_.shown ? ""
                     : fmt::format("{}\n{}, {:.2f} s{}", subject.title(), counted(world.bodies_there(), "body", "bodies"),
                                   world.time(), interaction_.paused ? ", paused" : "");
    panel_.lay_out_legend(*scale_, caption);
    window_.end_panel();
    choose_style();
    measure_range(0);
    view_ = {camera_of(interaction_.eye()), *scale_, "", subject.low, subject.high};
    // While nothing moves, only the panel is drawn.
    const Shown now{view_.camera, view_.scale, world.steps(), session_.beginnings(), session_.acts()};
    const bool moves = drawn_ != now, anew = make_drawing() || moves;
    if (anew) drawing_->update();
    drawn_.reset();
    const Clock::time_point start = Clock::now();
    if (!window_.show(drawing_->canvas(), view_, anew)) return;
    drawn_ = now;
    ++pictures_;
    detail_.drawn(seconds_between(start, Clock::now()), moves || !interaction_.paused);
    view_.caption = caption;
    draw_film();
    grant(wishes);
}

void Viewer::draw_film() {
    if (film_ && !film_->is_of(session_.beginnings())) end_film();
    if (!film_) return;
    try {
        film_->look(session_.world(), view_);
    } catch (const std::exception& error) {
        film_.reset();
        panel_.filming = false;
        panel_.tell(error.what());
    }
}

void Viewer::begin_or_end_film() {
    if (film_) {
        end_film();
        return;
    }
    const std::string file = host::unused_name(session_.subject().title(), ".mp4");
    film_ = std::make_unique<Film>(file, Extent{window_.width(), window_.height()}, style_, machine_, session_.world(),
                                   session_.beginnings());
    panel_.filming = true;
    panel_.tell("filming to " + file);
}

// Also where the world is another one.
void Viewer::end_film() {
    panel_.filming = false;
    const std::unique_ptr<Film> film = std::move(film_);
    if (!film) return;
    try {
        film->finish();
        panel_.tell(fmt::format("video of {} in {}", counted(static_cast<std::size_t>(film->pictures()), "picture", "pictures"),
                                film->file()));
    } catch (const std::exception& error) {
        panel_.tell(error.what());
    }
}

void Viewer::grant(const Wishes& wishes) {
    try {
        if (wishes.picture) write_picture();
        if (wishes.film) begin_or_end_film();
        if (wishes.recording) {
            const std::string file = host::unused_name(session_.subject().title() + "-played", ".json");
            host::write_atomically(file, json_of(session_.input()));
            panel_.tell("recording in " + file);
        }
    } catch (const std::exception& error) {
        panel_.tell(error.what());
    }
}

// The picture without the panel, at full size.
void Viewer::write_picture() {
    host::CanvasOptions canvas;
    canvas.width = window_.width();
    canvas.height = window_.height();
    show_overlays(style_, session_.world(), canvas);
    show_light(style_, canvas);
    Drawing drawing("vulkan", machine_, session_.world(), canvas);
    const host::Image image = drawing.canvas().draw(view_.camera, view_.scale, view_.caption, view_.low, view_.high);
    const std::string file = host::unused_name(session_.subject().title(), ".png");
    host::write_png(file, image);
    panel_.tell("picture in " + file);
}

void Viewer::run() {
    Meter steps, pictures;
    Clock::time_point before = Clock::now(), reported = before;
    while (!is_over()) {
        const bool minimised = window_.width() == 0;
        take_events(minimised ? 0.05 : interaction_.paused ? 0.02 : 0);  // poll slowly while paused
        const Clock::time_point now = Clock::now();
        const double seconds = seconds_between(std::exchange(before, now), now);
        const std::uint64_t step = session_.world().steps(), picture = pictures_, beginning = session_.beginnings();
        interaction_.advance(seconds);
        write_earlier();
        choose_style();
        measure_range(interaction_.paused ? 0 : seconds);
        draw();
        steps.count(beginning == session_.beginnings() ? session_.world().steps() - std::min(step, session_.world().steps()) : 0,
                    seconds);
        pictures.count(pictures_ - picture, seconds);
        rates_ = {steps.rate(), pictures.rate(), interaction_.milliseconds_a_step()};
        if (seconds_between(reported, now) < report_every) continue;
        write_report();
        reported = now;
    }
}

void Viewer::write_report() {
    if (options_.report.empty()) return;
    World& world = session_.world();
    nlohmann::ordered_json holds = nlohmann::ordered_json::array();
    const auto numbers = [](vec3 v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    for (const Handled& hold : interaction_.handled())
        holds.push_back({{"body", hold.body}, {"from", numbers(hold.from)}, {"to", numbers(hold.to)}});
    nlohmann::ordered_json json = {{"demo", session_.subject().name},
                                   {"backend", world.runner().backend()},
                                   {"device", world.runner().device()},
                                   {"bodies", world.scene().bodies.size()},
                                   {"steps", world.steps()},
                                   {"state_hash", hash_text(world.state_hash())},
                                   {"paused", interaction_.paused},
                                   {"grabbed", holds},
                                   {"thrown", interaction_.thrown()},
                                   {"width", window_.width()},
                                   {"height", window_.height()},
                                   {"pictures", pictures_},
                                   {"steps_per_second", rates_.steps},
                                   {"pictures_per_second", rates_.pictures},
                                   {"seconds", seconds_between(started_, Clock::now())}};
    if (interaction_.vehicle()) {
        const VehicleState vehicle = world.vehicle(*interaction_.vehicle());
        json["vehicle"] = {{"speed", vehicle.speed}, {"by_route", vehicle.by_route}, {"steer", vehicle.controls.steer}};
    }
    if (interaction_.selected()) {
        json["selected"] = *interaction_.selected();
        json["selected_position"] = numbers(world.body(*interaction_.selected()).position);
    }
    host::write_atomically(options_.report, json.dump(1) + "\n");
}

// The first to the file that was named, the others to files beside it; what is no file, such as a pipe, gets them all.
void Viewer::write_recording(const Input& input) {
    const std::filesystem::path first = options_.record;
    std::string file = first.string();
    if (!recordings_.empty() && (!std::filesystem::exists(first) || std::filesystem::is_regular_file(first)))
        file = host::unused_name((first.parent_path() / first.stem()).string(), first.extension().string());
    host::write_atomically(file, json_of(input));
    recordings_.push_back(file);
    panel_.tell(fmt::format("recording of {} in {}", input.scene, file));
}

void Viewer::write_earlier() {
    if (options_.record.empty()) return;
    for (; earlier_ < session_.earlier().size(); ++earlier_) write_recording(session_.earlier()[earlier_]);
}

void Viewer::write_recordings() {
    if (options_.record.empty()) return;
    write_earlier();
    if (recordings_.empty() || session_.acts() > 0) write_recording(session_.input());
    if (recordings_.size() < 2) return;
    say("scree: recordings, one of each scene and restart: {}\n", fmt::join(recordings_, ", "));
}

}  // namespace scree::demos
