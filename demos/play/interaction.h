// What a person's hands mean: pointer, buttons and keys become looks, forces and the clock. It knows no window.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "demos/film/orbit_camera.h"
#include "demos/play/session.h"
#include "host/window/events.h"

namespace scree::demos {

// The keys, a line each, for --help and the window.
extern const char* const key_help;

enum class Kind { sphere, capsule, box };

// A hold and its line: from the body to where the pointer draws it.
struct Pull {
    std::size_t body = 0;
    vec3 from{0}, to{0};  // m
    float strength = 0;   // of the greatest force, 0 to 1
    float force = 0;      // N, about
};

// A hold from its beginning to its end, for the report.
struct Handled {
    std::size_t body = 0;
    vec3 from{0}, to{0};  // the body's centre, m
};

class Interaction {
public:
    explicit Interaction(Session& session, Extent extent = {});

    void on(const host::Event& event);
    void advance(double seconds);  // of the wall clock: makes the steps that are due, at most a few

    // What the panel sets and shows.
    bool paused = false;
    bool follows = false;  // the selected body
    bool chases = false;   // the vehicle, from behind
    float pace = 1;        // simulated seconds in a second
    void step_once() { ++single_steps_; }
    void reset();
    void open(const std::string& name);    // says what is wrong in message()
    void open_next(int direction);         // of the demos made to be looked at
    void add(Kind kind);                   // falls onto the middle of the view
    void throw_body(Kind kind);            // from the eye through the pointer
    void explode();                        // where the pointer points
    void reset_upright();                  // the vehicle, where it is
    void perform(const UserCommand& act);  // says what is wrong in message()

    bool wants_to_close() const { return wants_to_close_; }
    Extent extent() const { return extent_; }
    const OrbitCamera& eye() const { return eye_; }
    std::optional<std::size_t> selected() const { return selected_; }
    std::optional<std::size_t> vehicle() const;  // that the keys drive: the selected body's, or the first
    std::optional<Pull> pull();
    std::vector<Handled> handled();  // the present one included
    const std::string& message() const { return message_; }
    std::size_t thrown() const { return thrown_; }

private:
    struct Hold {
        std::size_t grip = 0, body = 0;
        vec3 anchor{0}, target{0}, start{0};
        float depth = 0;  // m, of the target before the eye
    };
    enum class Motion { none, orbits, pans, holds };

    void press(const host::Event& event);
    void release_button();
    void move(const host::Event& event);
    void scroll(double clicks);
    void press_key(const host::Event& event);
    void begin_again();
    void grab(const RayHit& hit);
    void let_go();
    void drag();
    void push_selected();
    void drive();                // as the keys say, from the first of them on
    void chase(double seconds);  // of the wall clock
    bool is_driving_key(host::Key key) const;
    void make_step();
    std::optional<RayHit> hit_under_pointer();
    float size_of_a_new_body() const;

    Session& session_;
    Extent extent_;
    OrbitCamera eye_;
    double x_ = 0, y_ = 0;  // pixels
    Motion motion_ = Motion::none;
    std::optional<Hold> hold_;
    std::optional<std::size_t> selected_;
    std::vector<Handled> handled_;
    std::set<host::Key> held_keys_;
    std::optional<Controls> told_;  // to the vehicle last; none: it drives by itself
    std::size_t told_vehicle_ = 0;
    double backlog_ = 0;  // steps that the wall clock is ahead
    int single_steps_ = 0;
    std::size_t thrown_ = 0;
    bool wants_to_close_ = false;
    std::string message_;
};

}  // namespace scree::demos
