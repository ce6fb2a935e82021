// A scene: what bodies there are, where, of what shape and material. Plain data, in SI units, y up; World simulates it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "compute/shapes.h"

namespace scree {

// Rubber: a wheel's friction with slip (shaders/physics/extra/tyre.h). The friction of a Body is that at the best slip.
struct Tyre {
    float best_slip = 0.1f;  // at which it holds best, 0.01 to 0.9; sideways the tangent of the slip angle
    float sliding = 0.75f;   // part of the friction that is left when it slides, 0 to 1
    bool operator==(const Tyre& o) const { return best_slip == o.best_slip && sliding == o.sliding; }
};

enum class Motion {
    dynamic,    // moved by forces and contacts
    fixed,      // never moves
    kinematic,  // moves with its velocity, whatever it meets
};

constexpr std::size_t no_body = static_cast<std::size_t>(-1);

enum class Cutting {
    voronoi,    // any shape but a plane: pieces of about one size, cells about points (voro++)
    boxes,      // a box into boxes
    splinters,  // the same across the thinnest of a body's extents, right through it, and finer towards its middle: panes
};
struct Cut;  // compute/scene/fracture.h
// How a dynamic body comes apart, and what breaks it. It breaks at the end of the step in which one contact has carried more than
// the threshold (shaders/physics/extra/fracture.h says exactly what counts, and what becomes of the blow); its pieces go on from
// there. One of the two thresholds is positive.
struct Fracture {
    float impulse = 0;   // N s, normal, of one contact in this step and the one before; a load of F at rest counts 2 F / rate
    float momentum = 0;  // N s, of the body itself as the step begins, when something stops a tenth of it
    Cutting cutting = Cutting::voronoi;
    std::size_t pieces = 8;  // 2 to 256
    std::size_t depth = 1;   // how many times over: the pieces of a body of depth 2 break in their turn, 1 to 4. The threshold of
                             // a piece is smaller as its cross-section is, by the part of the mass to the power of 2/3
    std::uint32_t seed = 1;  // of how the cuts lie. Equal bodies with equal fractures share their pieces' shapes

    // Made when the scene is checked.
    std::shared_ptr<const Cut> cut{};
    std::size_t first_piece = no_body;  // its pieces are the bodies of the scene from here on
};

struct Body {
    std::string name;  // for messages; may be empty
    Motion motion = Motion::dynamic;
    Shape shape = Box{};
    // Of the centre of mass, m; of a hull or compound where its points' or parts' origin lies, until the scene is checked; of a
    // mesh or height field always so.
    vec3 position{0};
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w; normalised when the scene is checked
    vec3 velocity{0};              // m/s, at most Settings::max_speed
    vec3 angular_velocity{0};      // rad/s, world axes
    float density = 1000;          // kg/m^3
    float friction = 0.6f;         // Coulomb coefficient, >= 0; a pair takes sqrt(a b)
    float restitution = 0;         // 0 to 1; a pair takes the larger
    float rolling_resistance = 0;  // m, lever arm of the normal force that resists rolling, >= 0; a pair takes the larger
    float linear_damping = 0;      // 1/s, >= 0
    float angular_damping = 0;     // 1/s, >= 0
    float gravity_scale = 1;
    std::optional<Tyre> tyre{};  // of a sphere, capsule or cylinder, or of a compound's parts that are; none: plain friction
    std::optional<Fracture> fracture{};  // none: it never breaks
    // Of which body of the scene this is a piece, not there until that one breaks: its place is the one that it would have at the
    // start. Pieces are added behind the other bodies when the scene is checked; no scene says it.
    std::size_t piece_of = no_body;
};

// ---- joints
// A joint holds a frame of axes in body A and one in body B; at rest, with nothing moved along or about any axis, they lie on
// each other. x is the axis of a hinge, of a slider, and the middle of a cone.
constexpr float unlimited = 1e30f;

struct Limits {       // of how far B is from A along an axis (m) or about it (rad, within pi of 0)
    float lower = 0;  // -unlimited to unlimited, not above `upper`
    float upper = 0;
};
struct Spring {                   // pulls towards a place; with stiffness 0 a damper
    float stiffness = 0;          // N/m or N m/rad, 0 to 1e12
    float damping = 0;            // N s/m or N m s/rad, 0 to 1e12
    float rest = 0;               // m or rad
    float max_force = unlimited;  // N or N m
};
struct Motor {            // drives B against A
    float speed = 0;      // m/s or rad/s
    float max_force = 0;  // N or N m
};
// What may happen along or about one axis. One of spring, motor and friction.
struct Axis {
    bool locked = false;  // nothing
    std::optional<Limits> limits;
    std::optional<Spring> spring;
    std::optional<Motor> motor;
    float friction = 0;  // N or N m, with which it resists
};

struct Ball {            // the anchors stay together; all turns are free
    float friction = 0;  // N m about each axis
};
struct Hinge {  // B turns about x
    Axis turn;
};
struct Slider {  // B slides along x and does not turn
    Axis slide;
};
struct Fixed {};                   // B does not move against A
struct Distance {                  // between the anchors: a rope from 0 to its length, a rod with both alike, or with a spring
    float least = 0;               // m
    float greatest = unlimited;    // m
    std::optional<Spring> spring;  // `rest` is its length
};
struct ConeTwist {       // the anchors stay together; B's x axis stays within a cone about A's
    float swing = 0;     // half the cone's angle, rad, 0 to pi
    Limits twist;        // about x
    float friction = 0;  // N m, against the twist
};
struct SixDof {    // every axis as it says; they are free unless they say more
    Axis x, y, z;  // along A's axes
    Axis twist;    // about x, of B against where the swing has brought it
    Axis swing_y, swing_z;
};
using JointKind = std::variant<Ball, Hinge, Slider, Fixed, Distance, ConeTwist, SixDof>;

constexpr std::size_t the_world = static_cast<std::size_t>(-1);  // in place of a body: what never moves

struct Joint {
    std::string name;  // for messages; may be empty
    JointKind kind = Ball{};
    std::size_t a = the_world, b = the_world;  // bodies; not the same, and at least one that moves
    vec3 anchor_a{0}, anchor_b{0};             // in the body's frame, from its centre of mass (the world's: from its origin), m
    vec4 frame_a{0, 0, 0, 1}, frame_b{0, 0, 0, 1};  // of the joint's axes in the body's, quaternions; normalised when checked
    bool collide = false;                           // whether the two bodies may touch
    float break_force = unlimited;                  // N, mean over a step; above it the joint tears
    float break_torque = unlimited;                 // N m
    bool broken = false;                            // it has torn already
};

// ---- vehicles
// A chassis and wheels, each a body held to it by a joint from the chassis (a) to the wheel (b), whose x axis is the axle and
// points to the left, and whose y axis points up: a Hinge, or SixDegrees whose twist is free, with a spring along y for a
// suspension, and whose swing_y has equal limits if the wheel is steered. The step drives these joints' motors.
// compute/vehicle_presets.h makes such bodies and joints.
struct Controls {
    float throttle = 0;    // -1 to 1, < 0: backwards
    float brake = 0;       // 0 to 1. A wheel that is braked is not driven
    float steer = 0;       // -1 to 1, 1: to the left
    float hand_brake = 0;  // 0 to 1
    bool operator==(const Controls& o) const {
        return throttle == o.throttle && brake == o.brake && steer == o.steer && hand_brake == o.hand_brake;
    }
};
struct Wheel {
    std::size_t joint = 0;  // of the scene
    float radius = 0.3f;    // m, 1e-3 to 1e3
    float drive = 0;        // its share of the engine, >= 0; the shares of all wheels are brought to a sum of 1
    float brake = 0;        // N m, of the brake fully trodden
    float hand_brake = 0;   // N m
    bool steers = false;    // turns about the joint's y axis, as the curve asks (Ackermann)
    float skid = 0;         // what steering adds to its throttle, -1 to 1: vehicles without steered wheels turn like tanks
};
struct Engine {
    float torque = 1500;       // N m, at full throttle, of all driven wheels together
    float power = 75000;       // W; above power / torque the torque falls as 1 / speed
    float top_speed = 50;      // m/s
    float reverse_speed = 10;  // m/s, backwards
    float drag = 40;           // N m, of all driven wheels together without throttle
};
struct Steering {
    float angle = 0.6f;  // rad, of a wheel in the middle at full lock, 0.01 to 1.2
    float time = 0.4f;   // s, from straight ahead to full lock, 0.01 to 100
    float lateral = 8;   // m/s^2: no curve is asked for that needs more at the present speed, 0.1 to 1e4
};
struct WayPoint {
    vec3 position{0};  // m
    float speed = 10;  // m/s, 0.1 to 1e3; on the way to the next it changes evenly
};
struct Vehicle {
    std::string name;  // for messages; may be empty
    std::size_t chassis = 0;
    std::vector<Wheel> wheels;  // 1 to 8
    Engine engine{};
    Steering steering{};
    Controls controls{};  // until World::drive says otherwise
    // Points to drive past one after the other, from the first (where it begins) to the last, where it stops; at least 2, or
    // none. A vehicle with a route follows it by itself, on the device, until World::drive takes it over.
    std::vector<WayPoint> route{};
    bool loops = false;  // behind the last point it goes on to the first
    // State, for a scene that goes on.
    bool by_route = true;  // whether the route drives, if there is one
    std::size_t next = 1;  // way point that it drives to
};

struct Scene {
    vec3 gravity{0, -9.81f, 0};  // m/s^2
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    std::vector<Vehicle> vehicles{};
};

// A joint of two bodies of the scene (or the world) as they lie now, with its anchor and its x axis where they are in the world.
// Throws SceneError for an axis without a length.
Joint joint_at(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis = vec3(1, 0, 0));
// The same between an anchor in A and one in B, for a Distance.
Joint joint_between(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor_a, vec3 anchor_b);

// A scene that cannot be simulated. `pointer` is the place as a JSON pointer ("/bodies/17/shape/sphere/radius").
struct SceneError : std::runtime_error {
    SceneError(std::string place, const std::string& reason);
    std::string pointer;
};

// The scene with quaternions and normals of unit length. Throws SceneError, naming the body, for what is not finite, out of range
// (sizes 1e-3 to 1e5 m, positions to 1e6 m, density 1e-3 to 1e6 kg/m^3, velocities to 1e4), or contradictory (a plane that
// moves).
// A hull is brought to its centre of mass and its principal axes of inertia: its points are moved, and the body's position and
// orientation with them, so that every point stays where it is in the world; a compound and its parts likewise. `notes`, if
// given, is told of hulls that had more than 64 corners and were simplified, and of what is odd about meshes.
// Bodies that may break are cut: their pieces, and the pieces of those, become bodies behind all others, in the order of the
// bodies that they are pieces of.
Scene checked(Scene scene, std::vector<std::string>* notes = nullptr);

// kg and kg m^2 (principal, body frame) of a shape of a given density. Planes, meshes and height fields have neither: 0.
struct MassProperties {
    float mass = 0;
    vec3 inertia{0};
};
MassProperties mass_properties(const Shape& shape, float density);

}  // namespace scree
