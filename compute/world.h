// A world: a scene being simulated, on the CPU or on a Vulkan device, with the same bits on either.
//
//     scree::World world(scene);          // on the CPU, with all cores
//     for (int i = 0; i < 600; ++i) world.step();
//     for (const scree::BodyState& body : world.bodies()) ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/ray.h"
#include "compute/runner.h"
#include "compute/scene.h"
#include "compute/settings.h"

namespace scree {

struct BodyState {
    vec3 position;          // m
    vec4 orientation;       // unit quaternion x, y, z, w
    vec3 velocity;          // m/s
    vec3 angular_velocity;  // rad/s
    bool asleep = false;
    bool exists = true;  // false: it has broken, or is a piece of a body that has not; it is nowhere, and nothing acts on it
};

// What touches a body, as the last step left it: a record for each contact, of which two bodies have several where one of them is
// a compound, a mesh or a height field.
struct BodyContact {
    std::size_t body;  // the other one
    int points;        // 1 to 4
    float force;       // N, along the normal; 0 between bodies that are about to touch
};

// A joint as the last step left it.
enum class JointAxis { x, y, z, twist, swing_y, swing_z };  // along, then about the axes of its frame in A
struct JointState {
    vec3 force{0};         // on B, N, mean over the step; a sleeping joint's is that of its last step awake
    vec3 torque{0};        // on B, N m
    float max_force = 0;   // N, of any step so far
    float max_torque = 0;  // N m
    bool broken = false;
    float gap = 0;  // m, between the anchors
    // By JointAxis: how far B is from A, m and rad; of a Distance the first is the distance.
    std::array<float, 6> coordinates{};
};

// A vehicle as the last step left it.
struct VehicleState {
    Controls controls{};     // what it was told, or what its driver does
    float speed = 0;         // m/s, ahead
    float curvature = 0;     // of the curve that its wheels are steered to, 1/m, > 0: to the left
    bool by_route = false;   // the driver follows the route
    std::size_t passed = 0;  // way points so far
    std::size_t next = 0;    // way point that it drives to
    bool arrived = false;    // at the end of the route
};

// A hold on a body: a damped spring between a point of it and a place, solved implicitly and within every substep.
struct GripSpring {
    float hertz = 5;               // 0.1 to 30, of the body at the point where it is held. Below, it hangs far down
    float damping_ratio = 1;       // 0 to 10
    float max_acceleration = 300;  // m/s^2, 0 to 1e4: no greater force in proportion to the mass. More tears through stacks
    float spin_damping = 5;        // 1/s, 0 to 100: without, a held body swings for long
};
constexpr std::size_t most_grips = 4;  // at once

// Sums over the whole world, in double precision, and the extremes that a promise is made of.
struct Statistics {
    std::size_t bodies = 0;                  // of every motion, those that are there
    std::size_t broken = 0;                  // bodies that have broken, pieces that have included
    std::size_t pieces = 0;                  // that are there
    std::size_t manifolds = 0;               // pairs of bodies with contact points
    std::size_t points = 0;                  // contact points
    double penetration_mean = 0;             // m, over the points that penetrate; 0 if none does
    double penetration_max = 0;              // m
    double max_speed = 0;                    // m/s, of a dynamic body
    double kinetic_energy = 0;               // J
    double potential_energy = 0;             // J, -m g.x
    double momentum[3] = {0, 0, 0};          // kg m/s
    double angular_momentum[3] = {0, 0, 0};  // kg m^2/s, about the origin
    double drift_max = 0;                    // m, greatest distance of a dynamic body from its start
    std::size_t asleep = 0;                  // bodies
    std::size_t not_finite = 0;              // bodies
    std::size_t joints = 0;                  // of every kind
    std::size_t joints_broken = 0;
    double joint_force_max = 0;    // N, mean over a step, of any joint in any step so far
    double joint_torque_max = 0;   // N m
    std::size_t below_ground = 0;  // dynamic bodies whose centre lies behind a plane of the scene
};

class World {
public:
    // Checks and copies the scene (throws SceneError; std::invalid_argument for settings out of range). `runner` says where to
    // simulate: make_reference_runner (compute/runner.h) or make_device_runner (compute/device/device_runner.h).
    World(const Scene& scene, const Settings& settings, std::unique_ptr<Runner> runner);
    // On the CPU, with `threads` threads (0: one per core).
    explicit World(const Scene& scene, const Settings& settings = {}, int threads = 0);
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    // Advances by `count` steps of 1/rate seconds. Grows buffers as needed; throws only when memory ends (std::bad_alloc,
    // std::length_error or the device's own error). Then the bodies are as after the last whole step, but for the impulses of the
    // one that failed, and can be read; a further step throws std::logic_error.
    void step(int count = 1);

    std::uint64_t steps() const;       // done so far
    std::size_t bodies_there() const;  // of the scene's bodies; where some may break, read back
    double time() const;               // s
    // As checked, with gravity as it is now and the bodies that were added; pieces of bodies that may break are among its bodies,
    // whether they are there yet or not (BodyState::there).
    const Scene& scene() const;
    const Settings& settings() const;  // as they are now
    Runner& runner();

    // What acts on a body in the next step; calls add up. Indices are those of the scene; a wrong one throws std::out_of_range,
    // a value that is not finite std::invalid_argument, a body that is not dynamic std::invalid_argument. What comes to more than
    // 1e15 N, N m, N s or N m s acts as that much.
    void apply_force(std::size_t body, vec3 force, vec3 offset = vec3(0));      // N, held for the step; offset from the centre, m
    void apply_torque(std::size_t body, vec3 torque);                           // N m
    void apply_impulse(std::size_t body, vec3 impulse, vec3 offset = vec3(0));  // N s, at the step's start
    void apply_angular_impulse(std::size_t body, vec3 impulse);                 // N m s
    void set_velocity(std::size_t body, vec3 velocity, vec3 angular_velocity);  // m/s, rad/s; dynamic and kinematic bodies

    // Bodies that rest fall asleep (Settings::sleeping) and wake when something touches them, when what they lie on moves, or
    // when one of the calls above acts on them.
    void wake(std::size_t body);      // in the next step; throws as apply_force does
    void wake_all();                  // in the next step
    void set_sleeping(bool allowed);  // false: from the next step on nobody sleeps

    // From the next step on: drives an axis of a joint, in place of what drove it (a hinge's is twist, a slider's x). They wake
    // its bodies. Throw std::out_of_range for the index, std::invalid_argument for an axis that cannot move, SceneError for the
    // values.
    void set_motor(std::size_t joint, JointAxis axis, const Motor& motor);
    void set_spring(std::size_t joint, JointAxis axis, const Spring& spring);

    // From the next step on, until told otherwise: what a vehicle's driver does; its route no longer drives it. Wakes it. Throws
    // std::out_of_range for the index, std::invalid_argument for values out of range.
    void drive(std::size_t vehicle, const Controls& controls);
    void drive_by_route(std::size_t vehicle);  // from where it was left; std::invalid_argument if it has none
    // Puts a vehicle on its wheels, at rest, half a metre above where it is.
    void reset_upright(std::size_t vehicle);

    // Holds a dynamic body at `anchor` (in its own frame, from its centre; what lies outside of the box around it is brought to
    // that box) and draws that point to `target` (world, within 1e6 m of 0), step by step, until released. A held body is awake.
    // Returns the number of the grip. Throws as apply_force does, and std::length_error if most_grips are held already.
    std::size_t grip(std::size_t body, vec3 anchor, vec3 target, const GripSpring& spring = {});
    void move_grip(std::size_t grip, vec3 target);  // throws std::out_of_range for a grip that does not hold
    void release(std::size_t grip);                 // throws the same

    // Gives every dynamic body within `radius` (m) of a place a speed away from it: `speed` (m/s) in the middle, falling to 0
    // at the radius. Throws std::invalid_argument for what is not finite or a radius that is not positive.
    void explode(vec3 centre, float radius, float speed);

    // From the next step on; they wake everybody. They throw for what a scene or Settings would not take.
    void set_gravity(vec3 gravity);          // m/s^2
    void set_friction_factor(float factor);  // on the friction of every pair, 0 to 10
    // Of every pair, 0 to 1.
    void set_least_restitution(float restitution);
    // From the next step on. It reads contacts and joints back and sends them again once.
    void set_substeps(int substeps);  // 1 to 64

    // One more body; returns its index. The highest, unless it may break: then its pieces follow it. It sends that body alone,
    // but for once in half as many bodies as there are, when the tables grow. Throws SceneError as the constructor does. Buffers
    // that a canvas draws from may be others afterwards.
    std::size_t add_body(const Body& body);

    // One more joint; returns its index, the highest. It wakes the joint's bodies. It reads all joints and sends those
    // that have changed. Throws SceneError for what a scene would not take, and for a body that is not there.
    std::size_t add_joint(const Joint& joint);
    // Takes a joint away, at the same cost; those behind it move up by one. What it held wakes and goes on as it moves. Throws
    // std::out_of_range, and std::invalid_argument for the joint of a vehicle's wheel.
    void remove_joint(std::size_t joint);
    // A joint for add_joint between two bodies (or the_world) as they lie now, made as scree::joint_at makes one. Throws
    // std::out_of_range for the bodies, SceneError for an axis without a length.
    Joint joint_at(const JointKind& kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis = vec3(1, 0, 0)) const;

    // Before the next step: bodies that are near each other are put side by side in memory, however few they are. Where there are
    // thousands it happens by itself (Settings::reordering). It reads everything back and sends it again once.
    void reorder();
    std::uint64_t reorderings() const;           // so far; after each one bodies are in other rows of state()
    std::size_t row_of(std::size_t body) const;  // in the tables of state(), and of a device; throws std::out_of_range

    // Read back from wherever the world is.
    BodyState body(std::size_t index) const;                       // throws std::out_of_range
    std::vector<BodyContact> contacts_of(std::size_t body) const;  // throws the same; reads all contacts
    std::vector<BodyState> bodies() const;
    // The first surface that a ray meets from outside; a shape that it begins in is passed over, and from behind planes and
    // surfaces are not there. Reads all bodies, and asks one after the other. Throws std::invalid_argument for a ray that is not
    // finite or whose direction is not of length 1.
    std::optional<RayHit> cast_ray(const Ray& ray) const;
    JointState joint(std::size_t index) const;  // throws std::out_of_range; reads all joints
    std::vector<JointState> joints() const;
    VehicleState vehicle(std::size_t index) const;  // throws std::out_of_range; reads all vehicles
    std::vector<VehicleState> vehicles() const;
    // The scene with every body that is there where it is now and as fast; pieces are bodies as all others. A world made of it
    // goes on from there, but not to the same bits: its contacts begin anew, sleepers are awake, and what a position has below
    // its last bit is gone.
    Scene snapshot() const;
    Statistics statistics() const;
    const State& state() const;        // every table of a step (compute/step/state.h), with bodies and contacts as they are now
    std::uint64_t state_hash() const;  // XXH64 over position, orientation, velocity, angular velocity in id order

    std::uint64_t buffer_growths() const;
    std::size_t buffer_bytes() const;  // at present, all tables together
    // Whether the steps to come are timed stage by stage. At first they are not on a Vulkan device, where that takes time of its
    // own: 10 us a stage on lavapipe.
    void set_profiling(bool on);
    StageTimes stage_times() const;       // milliseconds per step, mean of those timed so far
    StageTimes last_stage_times() const;  // the same of the last timed step alone

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

std::string hash_text(std::uint64_t hash);  // of a state: 16 hexadecimal digits

}  // namespace scree
