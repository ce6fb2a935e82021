// User interaction: events, scenes and the clock.
#include "demos/play/interaction.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

// Seconds of steps per picture: half of what passes between pictures, so that the clock is true while steps are cheap,
// however few pictures are drawn; a slow machine falls behind it rather than freeze the window.
constexpr double least_time = 0.05, most_time = 0.25;
constexpr double longest_backlog = 1;  // s of the simulated clock
constexpr double longest_click = 3;    // pixels that the pointer may move
constexpr double slowest = 1.0 / 16;
constexpr std::size_t few_vehicles = 4;  // vehicles up to which a scene is taken to be about driving

host::Key key(char character) {
    return host::key_of(character);
}

// Height of the highest level plane, m.
std::optional<float> ground_of(const Scene& scene) {
    std::optional<float> ground;
    for (const Body& body : scene.bodies) {
        const auto* plane = std::get_if<Plane>(&body.shape);
        if (!plane || plane->normal.y < 0.999f * glm::length(plane->normal)) continue;
        const float height = plane->offset / plane->normal.y;
        ground = std::max(ground.value_or(height), height);
    }
    return ground;
}

}  // namespace

const std::vector<KeyHelp>& key_help() {
    static const std::vector<KeyHelp> lines = {
        {"left button", "grab and drag a body (wheel: nearer or farther); beside bodies: orbit"},
        {"right button", "orbit; with Shift, or the middle button: pan; wheel: zoom"},
        {"Space, B", "throw a ball, a box through the pointer"},
        {"arrows, Page Up/Down", "push the selected body"},
        {"X", "explosion at the pointer"},
        {"click", "select a body that is not dynamic"},
        {"Delete, V", "delete, duplicate the selected body"},
        {"J", "join two bodies: click a point of each"},
        {"Ctrl+Z", "take the last command back"},
        {"O, or drop a file", "open a scene"},
        {"1, 2, 3", "add a sphere, a capsule, a box"},
        {"4, 5, 6", "show contacts, velocities, joints"},
        {"7, 8, 9", "show bounding boxes, cells, sleep"},
        {"F, Home", "follow the selected body, first view"},
        {"P, .", "pause, single step"},
        {"L", "slow motion (1/2 to 1/16), then full speed"},
        {"R, Tab", "restart, next demo (Shift: previous)"},
        {"F1, ?", "these keys"},
        {"Ctrl +, Ctrl -", "larger, smaller text"},
        {"H, Q", "hide the panel, quit"},
        {"Esc", "close what is open, end joining, deselect"},
        {"with a vehicle:", ""},
        {"W, S, A, D or arrows", "throttle, brake (then reverse), left, right"},
        {"Space, Backspace, C", "hand brake, reset upright, chase camera"},
    };
    return lines;
}

std::string key_help_text() {
    std::string text;
    for (const KeyHelp& line : key_help()) {
        std::string keys = std::string("  ") + line.keys;
        keys.resize(std::max<std::size_t>(keys.size() + 2, 25), ' ');
        text += (text.empty() ? "" : "\n") + (*line.meaning ? keys + line.meaning : std::string("  ") + line.keys);
    }
    return text;
}

bool has_body(const World& world, std::size_t body) {
    try {
        return world.body(body).exists;
    } catch (const std::out_of_range&) {
        return false;
    }
}

std::optional<std::size_t> Interaction::selected() const {
    return selected_ && has_body(session_.world(), *selected_) ? selected_ : std::nullopt;
}

// Bodies that were removed or have broken, by a script, say.
void Interaction::forget_removed() {
    const World& world = session_.world();
    if (selected_ && !has_body(world, *selected_)) selected_.reset();
    if (first_point_ && !has_body(world, first_point_->body)) first_point_.reset();
    if (!hold_ || has_body(world, hold_->body)) return;
    perform(Release{hold_->grip});  // of a body that has broken; one that was removed is no longer held
    message_.clear();
    hold_.reset();
    motion_ = Motion::none;
}

Interaction::Interaction(Session& session, Extent extent)
    : session_(session), extent_(extent), eye_(session.subject().viewpoint) {
    begin_again();
}

void Interaction::perform(const UserCommand& act) {
    try {
        session_.perform(act);
        message_.clear();
    } catch (const std::logic_error& error) {
        message_ = error.what();
    } catch (const SceneError& error) {
        message_ = error.what();
    }
}

// ---- events
void Interaction::on(const host::Event& event) {
    using enum host::EventKind;
    switch (event.kind) {
        case dropped:
            open(event.file);
            break;
        case resized:
            extent_ = {static_cast<int>(event.x), static_cast<int>(event.y)};
            break;
        case moved:
            move(event);
            break;
        case pressed:
            x_ = event.x;
            y_ = event.y;
            press(event);
            break;
        case released:
            release_button();
            break;
        case scrolled:
            scroll(event.amount);
            break;
        case key_pressed:
            if (!event.control) held_keys_.insert(event.key);
            press_key(event);
            break;
        case key_released:
            held_keys_.erase(event.key);
            break;
    }
}

void Interaction::press(const host::Event& event) {
    if (motion_ != Motion::none) return;
    if (event.button == host::Button::middle || event.shift) {
        motion_ = Motion::pans;
        return;
    }
    motion_ = Motion::orbits;
    if (event.button == host::Button::right) return;
    const std::optional<RayHit> hit = hit_under_pointer();
    if (hit && joining_) {
        motion_ = Motion::none;
        pick(*hit);
        return;
    }
    const bool dynamic = hit && session_.world().scene().bodies[hit->body].motion == scree::Motion::dynamic;
    if (dynamic) {
        selected_ = hit->body;
        grab(*hit);
    } else if (hit) {
        pressed_ = hit->body;
        pressed_x_ = x_;
        pressed_y_ = y_;
    }
}

void Interaction::release_button() {
    if (pressed_ && std::hypot(x_ - pressed_x_, y_ - pressed_y_) <= longest_click) selected_ = pressed_;
    pressed_.reset();
    if (motion_ == Motion::holds) let_go();
    motion_ = Motion::none;
}

void Interaction::move(const host::Event& event) {
    const double dx = event.x - x_, dy = event.y - y_;
    x_ = event.x;
    y_ = event.y;
    if (motion_ == Motion::orbits) eye_.orbit(dx, dy);
    if (motion_ == Motion::pans) {
        follows = false;
        eye_.pan(dx, dy, extent_);
    }
    if (ground_ && (motion_ == Motion::orbits || motion_ == Motion::pans)) eye_.stay_above(*ground_);
    if (motion_ == Motion::holds) drag();
}

void Interaction::scroll(double clicks) {
    if (!hold_) {
        eye_.zoom(clicks);
        if (ground_) eye_.stay_above(*ground_);
        return;
    }
    hold_->depth *= std::pow(1.1f, static_cast<float>(clicks));
    drag();
}

void Interaction::press_key(const host::Event& event) {
    using enum host::Key;
    const host::Key pressed = event.key;
    if (event.control) {
        if (pressed == key('Z')) undo();
        return;
    }
    if (is_driving_key(pressed)) {
        if (!told_) told_ = Controls{};
        return;
    }
    if (pressed == backspace) reset_upright();
    if (pressed == key('C') && vehicle()) chases = !chases;
    if (pressed == space) throw_body(Kind::sphere);
    if (pressed == key('B')) throw_body(Kind::box);
    if (pressed == key('X')) explode();
    if (pressed == key('1')) add(Kind::sphere);
    if (pressed == key('2')) add(Kind::capsule);
    if (pressed == key('3')) add(Kind::box);
    if (pressed == key('P')) paused = !paused;
    if (pressed == key('.')) step_once();
    if (pressed == key('L')) pace = static_cast<double>(pace) > slowest ? pace / 2 : 1;
    if (pressed == key('F')) follows = !follows && selected_;
    if (pressed == home) eye_ = OrbitCamera(session_.subject().viewpoint);
    if (pressed == key('R')) reset();
    if (pressed == tab) open_next(event.shift ? -1 : 1);
    if (pressed == del) remove_selected();
    if (pressed == key('V')) duplicate_selected();
    if (pressed == key('J')) joining_ ? end_joining() : begin_joining();
    if (pressed == escape) {
        if (joining_)
            end_joining();
        else
            selected_.reset();
    }
    if (pressed == key('Q')) wants_to_close_ = true;
}

std::optional<RayHit> Interaction::hovered() {
    if (motion_ != Motion::none) return std::nullopt;
    return hit_under_pointer();
}

// ---- scenes
void Interaction::begin_again() {
    hold_.reset();
    motion_ = Motion::none;
    selected_.reset();
    pressed_.reset();
    end_joining();
    handled_.clear();
    thrown_ = 0;
    follows = false;
    told_.reset();
    chases = !session_.subject().scene.vehicles.empty() && session_.subject().scene.vehicles.size() <= few_vehicles;
    backlog_ = 0;
    single_steps_ = 0;
    ground_ = ground_of(session_.subject().scene);
}

void Interaction::reset() {
    begin_again();
    session_.reset();
}

void Interaction::go_to(std::uint64_t step) {
    travel([&] { session_.go_to(step); });
}

void Interaction::undo() {
    begin_again();
    try {
        message_ = session_.undo() ? "" : "nothing to take back";
    } catch (const std::exception& error) {
        message_ = error.what();
    }
}

void Interaction::open(const std::string& name) {
    open([&] { session_.open(name); });
}

void Interaction::open(const SceneOptions& options) {
    open([&] { session_.open(options); });
}

void Interaction::open(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        message_ = error.what();
        return;
    }
    message_.clear();
    begin_again();
    eye_ = OrbitCamera(session_.subject().viewpoint);
}

void Interaction::return_to(const Session::Moment& moment) {
    travel([&] { session_.return_to(moment); });
}

// To another time of the scene, with what is selected.
void Interaction::travel(const std::function<void()>& work) {
    const std::optional<std::size_t> selected = selected_;
    begin_again();
    try {
        work();
        message_.clear();
    } catch (const std::exception& error) {
        message_ = error.what();
    }
    selected_ = selected;
    forget_removed();
}

void Interaction::look_from(const Viewpoint& view, Extent extent) {
    eye_ = OrbitCamera(view);
    extent_ = extent;
}

void Interaction::let_all_go() {
    pressed_.reset();
    if (hold_) let_go();
    motion_ = Motion::none;
    held_keys_.clear();
    if (told_) drive();
    told_.reset();
}

void Interaction::open_next(int direction) {
    std::vector<std::string> names;
    for (const Demo& demo : all_demos()) {
        if (!demo.trial) names.emplace_back(demo.name);
    }
    const auto now = std::find(names.begin(), names.end(), session_.options().name);
    const auto count = static_cast<std::ptrdiff_t>(names.size());
    const std::ptrdiff_t at = now == names.end() ? (direction > 0 ? -1 : 0) : now - names.begin();
    open(names[static_cast<std::size_t>((at + direction + count) % count)]);
}

// ---- the clock
void Interaction::make_step() {
    push_selected();
    drive();
    const auto start = std::chrono::steady_clock::now();
    session_.step();
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    step_ms_ += (ms - step_ms_) * (step_ms_ > 0 ? 0.1 : 1);
}

void Interaction::advance(double seconds) {
    if (paused) {
        backlog_ = 0;
    } else {
        backlog_ += seconds * static_cast<double>(pace * session_.world().settings().rate);
        backlog_ = std::min(backlog_, std::max(1.0, longest_backlog * static_cast<double>(session_.world().settings().rate)));
        const double budget = std::clamp(seconds / 2, least_time, most_time);
        const auto start = std::chrono::steady_clock::now();
        for (; backlog_ >= 1; backlog_ -= 1) {
            make_step();
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
            if (taken.count() > budget) backlog_ = std::min(backlog_, 1.0);
        }
    }
    for (; single_steps_ > 0; --single_steps_) make_step();
    forget_removed();
    if (chases) chase(seconds);
    if (follows && selected_) eye_.look_at(session_.world().body(*selected_).position);
}

}  // namespace scree::demos
