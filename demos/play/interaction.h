// User interaction, independent of the window: pointer, buttons and keys move the camera, grab and throw bodies,
// drive vehicles and control the clock.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "demos/film/orbit_camera.h"
#include "demos/play/session.h"
#include "host/window/events.h"

namespace scree::demos {

// Help on the keys, for --help and the window.
struct KeyHelp {
    const char* keys;
    const char* meaning;
};
const std::vector<KeyHelp>& key_help();
std::string key_help_text();  // in lines, for --help

enum class Kind { sphere, capsule, box };

// Whether the index is one of a body that exists. World::body throws for one that was removed.
bool has_body(const World& world, std::size_t body);

// Joints that the pointer makes between two points. Ball, hinge, slider and fixed joints are in the middle between them;
// rope, rod and spring go from one to the other and have their distance.
enum class JoinKind { ball, hinge, slider, fixed, rope, rod, spring };
const std::vector<std::string>& join_words();
enum class JoinAxis { x, y, z, between };  // of hinges and sliders: of the world, or from the first point to the second
const std::vector<std::string>& join_axis_words();

// A point on a body, in its frame.
struct PickedPoint {
    std::size_t body = 0;
    vec3 anchor{0};  // m
};

// The grab spring as drawn: from the body's anchor to the pointer.
struct Pull {
    std::size_t body = 0;
    vec3 from{0}, to{0};  // m
    float strength = 0;   // fraction of the maximum force, 0..1
    float force = 0;      // N, estimated
};

// A finished grab, for the report.
struct Handled {
    std::size_t body = 0;
    vec3 from{0}, to{0};  // the body's centre at begin and end, m
};

class Interaction {
public:
    explicit Interaction(Session& session, Extent extent = {});

    void on(const host::Event& event);
    void advance(double seconds);  // `seconds` of wall clock: makes the steps that are due, at most a few

    // State that the panel shows and sets.
    bool paused = false;
    bool follows = false;  // camera follows the selected body
    bool chases = false;   // camera chases the vehicle from behind
    float pace = 1;        // simulated seconds per second
    void step_once() { ++single_steps_; }
    void reset();
    void go_to(std::uint64_t step);      // of the session's time line
    void undo();                         // the last command
    void open(const std::string& name);  // errors go to message()
    void open(const SceneOptions& options);
    void return_to(const Session::Moment& moment);  // errors go to message()
    void open_next(int direction);                  // next or previous demo of the gallery
    void add(Kind kind);                            // above the centre of the view
    void throw_body(Kind kind);                     // from the eye towards the pointer
    void explode();                                 // at the pointer
    void reset_upright();                           // the vehicle, at its position
    void perform(const UserCommand& act);           // errors go to message()

    // Edits of the selected body; errors go to message().
    void remove_selected();
    void duplicate_selected();  // above what is highest where it is
    // Joining: the next two points that the left button picks on bodies are joined.
    JoinKind join_kind = JoinKind::ball;
    JoinAxis join_axis = JoinAxis::z;
    void begin_joining();
    void end_joining();
    bool joining() const { return joining_; }
    const std::optional<PickedPoint>& first_point() const { return first_point_; }
    std::size_t joined() const { return joined_; }  // joints made so far

    bool wants_to_close() const { return wants_to_close_; }
    Extent extent() const { return extent_; }
    const OrbitCamera& eye() const { return eye_; }
    void look_from(const Viewpoint& view, Extent extent);  // of a picture elsewhere, which the pointer then points at
    std::optional<std::size_t> selected() const;           // that exists
    std::optional<std::size_t> held() const { return hold_ ? std::optional(hold_->body) : std::nullopt; }
    // The body under the pointer while no button is pressed; casts a ray at all bodies.
    std::optional<RayHit> hovered();
    void select(std::optional<std::size_t> body) { selected_ = body; }
    // Grabs this body where the pointer is, or by its centre where it has left the pointer meanwhile.
    void grab_body(std::size_t body);
    void let_all_go();                           // body and keys, as when the user leaves
    std::optional<std::size_t> vehicle() const;  // the vehicle driven by keys: the selected body's, or the first
    std::optional<Pull> pull();
    std::vector<Handled> handled();  // grabs so far, including the current one
    const std::string& message() const { return message_; }
    std::size_t thrown() const { return thrown_; }
    double milliseconds_a_step() const { return step_ms_; }  // smoothed

private:
    struct Hold {
        std::size_t grip = 0, body = 0;
        vec3 anchor{0}, target{0}, start{0};
        float depth = 0;  // m, distance of the target along the view direction
    };
    enum class Motion { none, orbits, pans, holds };

    void press(const host::Event& event);
    void release_button();
    void move(const host::Event& event);
    void scroll(double clicks);
    void press_key(const host::Event& event);
    void begin_again();
    void open(const std::function<void()>& work);
    void travel(const std::function<void()>& work);
    void forget_removed();
    void pick(const RayHit& hit);
    void join(const PickedPoint& a, const PickedPoint& b);
    void grab(const RayHit& hit);
    void let_go();
    void drag();
    void push_selected();
    void drive();                // drives by keys once one was pressed
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
    std::optional<std::size_t> pressed_;  // a body that cannot be grabbed; selected by a click without motion
    double pressed_x_ = 0, pressed_y_ = 0;
    bool joining_ = false;
    std::optional<PickedPoint> first_point_;
    std::size_t joined_ = 0;
    std::optional<std::size_t> selected_;
    std::vector<Handled> handled_;
    std::set<host::Key> held_keys_;
    std::optional<Controls> told_;  // last controls sent to the vehicle; none: it follows its route
    std::size_t told_vehicle_ = 0;
    double backlog_ = 0;  // steps due by the wall clock
    int single_steps_ = 0;
    std::size_t thrown_ = 0;
    double step_ms_ = 0;
    bool wants_to_close_ = false;
    std::string message_;
    std::optional<float> ground_;  // m, height of the highest level plane
};

}  // namespace scree::demos
