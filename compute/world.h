// World: simulates a scene on the CPU or on a Vulkan device, bit-identically.
//
//     scree::World world(scene);          // on the CPU, with all cores
//     for (int i = 0; i < 600; ++i) world.step();
//     for (const scree::BodyState& body : world.bodies()) ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compute/checkpoint.h"
#include "compute/events.h"
#include "compute/queries.h"
#include "compute/ray.h"
#include "compute/runner.h"
#include "compute/scene.h"
#include "compute/scene_stream.h"
#include "compute/settings.h"
#include "compute/timeline.h"
#include "compute/version.h"

namespace scree {

struct BodyState {
    vec3 position;          // m
    vec4 orientation;       // unit quaternion x, y, z, w
    vec3 velocity;          // m/s
    vec3 angular_velocity;  // rad/s
    bool asleep = false;
    bool exists = true;  // false: it has broken, or is a fragment of an unbroken body; it neither collides nor moves
    bool quarantined = false;
};

// A body whose pose or velocity would not have been finite any more (or beyond 1e15 m, m/s, rad/s): it was stopped where it last
// was, and since then collides with nothing and hangs on no joint, whose others go on. The same on every backend. Its scene
// asks for more than single precision has: extreme masses, sizes, speeds, springs.
struct Quarantine {
    std::size_t body = 0;
    std::uint64_t step = 0;  // the number of steps done after the one in which it happened
    std::string stage;       // that found it: move_bodies within a substep, end_step after the last
    std::size_t joints = 0;  // that it hung on
};

// Names one body for its whole life: an index is given to a new body once its body was removed, a handle never is.
struct BodyHandle {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  // bodies that had the index before
    bool operator==(const BodyHandle& o) const { return index == o.index && generation == o.generation; }
};

// For set_bodies: what is to change. Velocities of a fixed body and the pose of a plane cannot.
struct BodyChange {
    std::size_t body = 0;
    std::optional<vec3> position{};          // of the centre of mass, within 1e6 m of 0
    std::optional<vec4> orientation{};       // quaternion x, y, z, w of any length but 0
    std::optional<vec3> velocity{};          // m/s, at most 1e4 along each axis
    std::optional<vec3> angular_velocity{};  // rad/s, world axes, likewise
};

// Names one joint for its whole life, whatever happens to the indices of joints.
struct JointHandle {
    std::uint32_t index = 0;  // when the handle was given
    std::uint32_t birth = 0;  // number of the joint, of all that the world has ever had
    bool operator==(const JointHandle& o) const { return index == o.index && birth == o.birth; }
};

// For move_bodies: where a kinematic body is to be.
struct BodyTarget {
    std::size_t body = 0;
    vec3 position{0};              // within 1e6 m of 0
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w of any length but 0; it turns there the shorter way
    int steps = 1;                 // on the way, 1 to 1e6
};

// A contact of a body after the last step. Two bodies have several contacts if one is a compound, mesh or height field.
struct BodyContact {
    std::size_t body;  // the other body
    int points;        // 1 to 4
    float force;       // normal force, N, in the last substep; 0 if speculative
};
using Touching [[deprecated("use BodyContact")]] = BodyContact;

// A joint after the last step.
struct JointState {
    vec3 force{0};         // on B, N, mean over the step; a sleeping joint keeps that of its last step awake
    vec3 torque{0};        // on B, N m
    float max_force = 0;   // greatest force of any step so far, N
    float max_torque = 0;  // N m
    bool broken = false;
    float gap = 0;  // distance between the anchors, m
    // By JointAxis: position of B relative to A, m and rad; for a Distance joint the first is the distance. The angle of a
    // hinge, a twist or a swing alone counts turns.
    std::array<float, 6> coordinates{};
    std::array<float, 6> rates{};  // of these, m/s and rad/s, as the solver takes them: of a large swing to first order
};

// For apply_joint_forces.
struct JointForce {
    std::size_t joint = 0;
    JointAxis axis = JointAxis::twist;  // of a Distance joint x: along the line from A's anchor to B's
    float force = 0;                    // N or N m
};

// For set_drives: the spring of an axis as a servo. It exerts stiffness (target - coordinate) + damping (target_speed - rate), at
// most max_force. What is left out stays, or without a spring is 0, and max_force unlimited. Joints of robot files have springs
// that exert nothing and keep the file's effort as max_force.
struct JointDrive {
    std::size_t joint = 0;
    JointAxis axis = JointAxis::twist;
    std::optional<float> stiffness{};     // N/m or N m/rad
    std::optional<float> damping{};       // N s/m or N m s/rad
    std::optional<float> target{};        // m or rad
    std::optional<float> target_speed{};  // m/s or rad/s
    std::optional<float> max_force{};     // N or N m
};

// For set_motors and set_springs.
struct JointMotor {
    std::size_t joint = 0;
    JointAxis axis = JointAxis::twist;
    Motor motor{};
};
struct JointSpring {
    std::size_t joint = 0;
    JointAxis axis = JointAxis::twist;
    Spring spring{};
};

// For set_joint_coordinates; what is left out stays.
struct JointCoordinate {
    std::size_t joint = 0;
    JointAxis axis = JointAxis::twist;
    std::optional<float> coordinate{};  // m or rad
    std::optional<float> rate{};        // m/s or rad/s
};

// A vehicle after the last step.
struct VehicleState {
    Controls controls{};     // set by the user, or by route following
    float speed = 0;         // forward speed, m/s
    float curvature = 0;     // curvature steered, 1/m, > 0: left
    bool by_route = false;   // whether it follows its route
    std::size_t passed = 0;  // way points passed
    std::size_t next = 0;    // index of the next way point
    bool arrived = false;    // the route has ended
};

// A grab spring: a damped spring between an anchor on a body and a target, solved implicitly in every substep.
struct GripSpring {
    float hertz = 5;               // Hz, 0.1 to 30. Below, the body hangs far down
    float damping_ratio = 1;       // 0 to 10
    float max_acceleration = 300;  // m/s^2, 0 to 1e4: force limit per mass. More tears through stacks
    float spin_damping = 5;        // 1/s, 0 to 100: angular damping while held, or the body swings for long
};
constexpr std::size_t most_grips = 4;  // at a time

// Sums and extremes over the whole world, in double precision.
struct Statistics {
    std::size_t bodies = 0;                  // that exist, of any motion
    std::size_t broken = 0;                  // bodies that have broken, fragments included
    std::size_t pieces = 0;                  // fragments that exist
    std::size_t manifolds = 0;               // contacts with points
    std::size_t points = 0;                  // contact points
    double penetration_mean = 0;             // over penetrating points, m; 0 without any
    double penetration_max = 0;              // m
    double penetration_resting = 0;          // greatest between bodies slower than 0.1 m/s, m
    double max_speed = 0;                    // of dynamic bodies, m/s
    double kinetic_energy = 0;               // J
    double potential_energy = 0;             // J, -m g.x
    double momentum[3] = {0, 0, 0};          // kg m/s
    double angular_momentum[3] = {0, 0, 0};  // kg m^2/s, about the origin
    double max_spin = 0;                     // of dynamic bodies, rad/s
    std::size_t spin_limited = 0;            // bodies at the limit Settings::max_turn as a step ended, over all steps so far
    double drift_max = 0;                    // m, greatest distance of a dynamic body from its start
    std::size_t asleep = 0;                  // bodies
    std::size_t not_finite = 0;              // bodies in quarantine
    std::size_t joints = 0;                  // of every kind
    std::size_t joints_broken = 0;
    double joint_force_max = 0;   // greatest force of any joint in any step so far (mean over a step), N
    double joint_torque_max = 0;  // N m
    std::size_t bonds = 0;        // between bodies
    std::size_t bonds_broken = 0;
    std::size_t below_ground = 0;  // dynamic bodies whose centre is behind a plane of the scene
};

// States that a world keeps for going back, at most.
constexpr std::size_t most_kept_states = 10;

// Changes one copy of a scene before a world of many begins: poses, velocities, materials, masses, joints, gravity; the
// number of bodies, parts, joints and vehicles stays.
using VaryCopy = std::function<void(std::size_t copy, Scene& scene)>;

// Simulates a scene, on the CPU or on a device.
//
// Threads: a world belongs to one thread at a time. Its functions, const ones too (they read from the runner, and keep what
// they found), are called by one thread after another, which may be others; worlds of their own run side by side, also on one
// host::Device. What a function returns by value may be used by any thread, and references until the next call of the world.
// Within a call the runner's threads work (Runner::threads); functions that the user passes run on the calling thread, but for
// Timeline and the messages of a device, which say for themselves. demos/docs/guide/threads.md.
class World {
public:
    // Validates and copies the scene. Throws SceneError, and std::invalid_argument for settings out of range and for no runner.
    // `runner`: make_reference_runner (compute/runner.h) or make_device_runner (compute/device/make_device_runner.h).
    World(const Scene& scene, const Settings& settings, std::unique_ptr<Runner> runner);
    World(Scene&& scene, const Settings& settings, std::unique_ptr<Runner> runner);  // takes the scene, in place of copying it
    // Of a scene whose bodies come one after the other. Ranks that can share it out (compute/distributed/distributed.h) keep
    // their shares of it from the start; any other world takes it whole.
    World(const StreamedScene& scene, const Settings& settings, std::unique_ptr<Runner> runner);
    // On the CPU, with `threads` worker threads (0: one per core; below 0 throws std::invalid_argument).
    explicit World(const Scene& scene, const Settings& settings = {}, int threads = 0);
    // Many copies of the scene in one world (`copies`, 1 to 4,194,304), in one set of tables: each moves with the same bits
    // as a world of that scene alone, whatever happens in the others. Copy w has the bodies from w * bodies_of_copy() on,
    // its joints and vehicles likewise, at the scene's own coordinates. Throws std::invalid_argument, too, if `vary` changes
    // what must be equal.
    World(const Scene& scene, const Settings& settings, std::unique_ptr<Runner> runner, std::size_t copies,
          const VaryCopy& vary = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    // Advances by `count` steps of 1/rate seconds. Buffers grow as needed. Throws only when memory ends (std::length_error or
    // the device's own error): then the bodies are as after the last whole step, but for the impulses of the one that failed,
    // and can be read; a further step throws std::logic_error. Throws std::invalid_argument for a count below 0.
    void step(int count = 1);
    // Memory that the tables of a step may take, bytes, from the next step on; on a device its own memory, but on a rank the
    // host's, also beside a device. Default: no limit. A step whose pairs and contacts need more throws std::length_error, which
    // names the step, the numbers, the bytes and the body with most pairs (not on devices of ranks), before any of it is
    // allocated. No result depends on the limit.
    void set_memory_limit(std::size_t bytes);

    // ---- copies of the scene. Functions that take a copy throw std::out_of_range for one that is not there. A world of
    // several copies has the bodies and joints of the scene: those that add and remove them throw std::logic_error.
    std::size_t copies() const;
    std::size_t bodies_of_copy() const;                             // fragments included
    std::size_t body_of(std::size_t copy, std::size_t body) const;  // index in the world; throws for the body, too
    std::size_t copy_of(std::size_t body) const;                    // throws std::out_of_range
    std::uint64_t state_hash_of(std::size_t copy) const;            // that of the scene alone
    std::vector<std::uint64_t> state_hashes() const;                // of all copies; reads the bodies once
    Statistics statistics_of(std::size_t copy) const;
    Scene snapshot_of(std::size_t copy) const;            // snapshot(), of a copy
    void set_gravity_of(std::size_t copy, vec3 gravity);  // m/s^2, from the next step on; wakes the copy
    vec3 gravity_of(std::size_t copy) const;              // m/s^2
    void wake_copy(std::size_t copy);                     // in the next step
    // Puts copies back to their start, as if they began with the next step: poses, velocities, contacts and their impulses,
    // sleep, what has broken, joints, routes and controls of vehicles. Forces and grips end. What the user has changed about
    // materials, masses, motors, springs, filters and gravity stays. Uploads their bodies and joints, and reads nothing.
    // `mask`: 1 for each copy to be reset; throws std::invalid_argument for another length.
    void reset(std::span<const std::uint8_t> mask);
    void reset_copy(std::size_t copy);

    std::uint64_t steps() const;       // steps done
    std::size_t bodies_there() const;  // number of bodies that exist; reads the bodies back if some may break
    double time() const;               // s
    // The validated scene, with the present gravity and added bodies. Its bodies include all fragments, whether they
    // exist yet or not (BodyState::exists).
    const Scene& scene() const;
    const Settings& settings() const;  // the present settings
    Runner& runner();

    // Forces and impulses on a body in the next step; calls add up. `body` is the index in the scene. Throws
    // std::out_of_range for the index, and std::invalid_argument for values that are not finite or a body that is not
    // dynamic. Sums are clamped to 1e15 N, N m, N s and N m s.
    void apply_force(std::size_t body, vec3 force, vec3 offset = vec3(0));      // N, for the step; offset from the centre, m
    void apply_torque(std::size_t body, vec3 torque);                           // N m
    void apply_impulse(std::size_t body, vec3 impulse, vec3 offset = vec3(0));  // N s, at the start of the step
    void apply_angular_impulse(std::size_t body, vec3 impulse);                 // N m s
    // m/s, rad/s. A dynamic body has it from the start of the step; that of a kinematic body changes evenly over the step,
    // at the end of which it has it.
    void set_velocity(std::size_t body, vec3 velocity, vec3 angular_velocity);

    // Sleep: quiet bodies fall asleep (Settings::sleeping), and wake when a restless body touches them, when their load
    // or support changes, or when a call above acts on them.
    void wake(std::size_t body);      // in the next step; throws like apply_force
    void wake_all();                  // in the next step
    void set_sleeping(bool allowed);  // from the next step on

    // Set the motor or the spring of a joint's axis from the next step on (a hinge's axis is twist, a slider's x), and wake its
    // bodies. The other one stays, and friction, but that a motor takes its place; beside a spring a motor without force is
    // none. Throw std::out_of_range for the index, std::invalid_argument for an axis that cannot move, SceneError for the values
    // and for a spring that acts with a speed or a limit of its force beside a motor or friction.
    void set_motor(std::size_t joint, JointAxis axis, const Motor& motor);
    void set_spring(std::size_t joint, JointAxis axis, const Spring& spring);
    // Many axes in one transfer; what is refused changes none. A drive takes the place of a motor, and one with a limit or a
    // speed that of friction, too. Throw the same.
    void set_motors(std::span<const JointMotor> motors);
    void set_springs(std::span<const JointSpring> springs);
    void set_drives(std::span<const JointDrive> drives);
    // Limits, spring, motor and friction of an axis at present; one that cannot move is locked. Throws std::out_of_range.
    Axis joint_axis(std::size_t joint, JointAxis axis) const;
    // Places bodies so that joints have these coordinates and rates. Joints that are not named keep theirs: what hangs on a joint
    // moves along, seen from the root of its tree, which stays. Roots are the world, bodies that are not dynamic, and else the
    // one body that is b of no joint, or the first. Reads all bodies and joints. Throws std::out_of_range for an index,
    // std::invalid_argument for joints in a loop, broken ones, axes that cannot move, distance joints, values that are not finite
    // or outside of the axis's limits, and what set_bodies refuses; then changes nothing.
    void set_joint_coordinates(std::span<const JointCoordinate> coordinates);

    // Forces (N) or torques (N m) along or about joint axes on B, and the opposite on A, in the next step; they add up. Axes as
    // they are when the step begins; reads the poses of their bodies. Throws std::out_of_range for the index,
    // std::invalid_argument for values that are not finite.
    void apply_joint_forces(std::span<const JointForce> forces);

    // Sets a vehicle's controls from the next step on, ends route following, and wakes the vehicle. Throws
    // std::out_of_range for the index, std::invalid_argument for values out of range.
    void drive(std::size_t vehicle, const Controls& controls);
    void drive_by_route(std::size_t vehicle);  // resumes its route; throws std::invalid_argument if it has none
    // Puts a vehicle upright, at rest, half a metre above its position.
    void reset_upright(std::size_t vehicle);
    [[deprecated("use reset_upright")]] void put_upright(std::size_t vehicle) { reset_upright(vehicle); }

    // Grabs a dynamic body: a spring pulls `anchor` (body frame, from the centre of mass, m; clamped to the shape's
    // box) to `target` (world, within 1e6 m of 0) until released. A held body stays awake. Returns the number of the
    // grip. Throws like apply_force, and std::length_error if most_grips are in use.
    std::size_t grip(std::size_t body, vec3 anchor, vec3 target, const GripSpring& spring = {});
    void move_grip(std::size_t grip, vec3 target);  // throws std::out_of_range for a free grip
    void release(std::size_t grip);                 // throws the same

    // Adds a velocity away from `centre` to every dynamic body within `radius` (m): `speed` (m/s) at the centre,
    // falling linearly to 0 at the radius. Throws std::invalid_argument for values that are not finite or a radius that
    // is not positive. In every copy of the scene, or in one.
    void explode(vec3 centre, float radius, float speed, std::optional<std::size_t> copy = std::nullopt);

    // From the next step on; these wake all bodies. They throw like the validation of a scene or of Settings.
    void set_gravity(vec3 gravity);          // m/s^2
    void set_friction_factor(float factor);  // scales the friction of every pair, 0 to 10
    void set_fields(const Fields& fields);   // wind, water, attractors; throws SceneError
    // Rate at which the scene's periodic cell stretches, 1/s; scene().periodic tells its size now. Until it is 0 nothing sleeps.
    // Throws SceneError, and std::domain_error from the step() before which the cell has become too narrow for a body.
    void set_cell_rate(vec3 rate);
    // Lower bound of every pair's restitution, 0 to 1.
    void set_least_restitution(float restitution);
    // From the next step on. Reads contacts and joints back and uploads them again once.
    void set_substeps(int substeps);  // 1 to 64

    // Adds a body; returns its index, the highest or that of a removed body, but for the fragments of a breakable body,
    // which follow it. Uploads that body alone, unless the tables must grow (they double). Throws SceneError like the
    // constructor. Buffers that a canvas draws from may be replaced.
    std::size_t add_body(const Body& body);
    // Adds many in one upload. Throws SceneError, its pointer by the index in `bodies`, and then adds none.
    std::vector<BodyHandle> add_bodies(std::span<const Body> bodies);
    // Removes bodies in one upload; indices of others stay. With them go their joints (which are broken from then on), grips,
    // exclusions, and the fragments of a whole body; sleepers that touched them wake. Their indices are given to new bodies
    // after the next step. Throws std::out_of_range for a body that was removed before, std::invalid_argument for one that
    // is not there (broken, or a fragment of an unbroken body), is named twice, or belongs to a vehicle; then removes none.
    void remove_bodies(std::span<const BodyHandle> bodies);
    void remove_body(std::size_t body);  // the same for one
    // Throws std::out_of_range for an index that no body has, or none any more.
    BodyHandle handle_of(std::size_t body) const;
    bool is_valid(BodyHandle body) const;         // whether its body has not been removed
    std::size_t index_of(BodyHandle body) const;  // throws std::out_of_range for a body that was removed
    // Changes counted from 0: bodies came or went, or were moved in memory. What refers to rows or shapes is outdated.
    std::uint64_t arrangements() const;
    // By body: row of its first part in the tables of state(), where the others follow; of a body without parts no_body.
    std::vector<std::size_t> first_part_rows() const;

    // Poses and velocities of many bodies, in one transfer each way; the last of several changes of one body counts. Bodies
    // wake; a pose set of a body that is not dynamic wakes all. A velocity alone changes as by set_velocity. Throws
    // std::out_of_range for an index, std::invalid_argument for a body that is not there and for values out of range, naming the
    // body; then changes nothing.
    void set_bodies(std::span<const BodyChange> changes);
    // Where the frames lie in which bodies were described (Body::origin): that of the points of a hull, the parts of a compound,
    // the link of a robot. Others' are their own. Reads all bodies. Throws std::out_of_range for an index.
    std::vector<BodyFrame> origins(std::span<const std::size_t> bodies) const;
    // Moves kinematic bodies to poses, each in a number of steps with constant velocities, which push what they meet; then
    // they stand still. A new target, velocity, pose or motion of a body replaces this. Reads their poses. Throws
    // std::out_of_range for an index, std::invalid_argument for a body that is not kinematic, values out of range, and a
    // speed above Settings::max_speed or rotation above Settings::max_turn; then changes nothing.
    void move_bodies(std::span<const BodyTarget> targets);
    // The user's own number of a body, Body::user_data at first. Throw std::out_of_range for the index.
    void set_user_data(std::size_t body, std::uint64_t data);
    std::uint64_t user_data(std::size_t body) const;
    // From the next step on. They throw std::out_of_range for the index and SceneError for values or a motion that the
    // body cannot have. Fragments of an unbroken body keep what they have.
    void set_material(std::size_t body, const Material& material);  // wakes it; all, if it is not dynamic
    // kg, 1e-9 to 1e15. Its moments of inertia change in proportion, its buoyancy does not. A body that can break, a fragment, a
    // plane, a mesh and a height field refuse.
    void set_mass(std::size_t body, float mass);
    void set_filter(std::size_t body, const Filter& filter);  // wakes all; parts with filters of their own keep them
    // Wakes all. A fixed body has no velocity; a body of a vehicle, or joined to one that is not dynamic, stays dynamic.
    void set_motion(std::size_t body, Motion motion);
    void set_exclusion(std::size_t a, std::size_t b, bool excluded);  // whether they never collide; wakes all

    // Adds a joint; returns its index, the highest. Wakes its bodies. Reads all joints and uploads those that changed.
    // Throws SceneError for an invalid joint, and for a body that does not exist.
    std::size_t add_joint(const Joint& joint);
    // Removes a joint, at the same cost; higher indices decrease by one. Its bodies wake. Throws std::out_of_range, and
    // std::invalid_argument for the joint of a vehicle's wheel.
    void remove_joint(std::size_t joint);
    // Adds many, with the indices of removed ones first, at the cost of one. Throws SceneError, its pointer by the index in
    // `joints`, and then adds none.
    std::vector<JointHandle> add_joints(std::span<const Joint> joints);
    // Removes joints in one transfer; indices of others stay. Their bodies wake. Throws std::out_of_range for a joint that was
    // removed before, std::invalid_argument for one that is named twice or is of a vehicle's wheel; then removes none.
    void remove_joints(std::span<const JointHandle> joints);
    // Throws std::out_of_range for an index that no joint has, or none any more.
    JointHandle joint_handle_of(std::size_t joint) const;
    bool is_valid(JointHandle joint) const;         // whether it has not been removed
    std::size_t index_of(JointHandle joint) const;  // at present; throws std::out_of_range for one that was removed
    // A joint for add_joint between two bodies (or the_world) at their present poses, made like scree::joint_at. Throws
    // std::out_of_range for the bodies, SceneError for an axis of length 0.
    Joint joint_at(const JointKind& kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis = vec3(1, 0, 0)) const;

    // Reorders bodies in memory along a Morton curve before the next step. Worlds of thousands of bodies do so by
    // themselves (Settings::reordering). On a device this reads all poses; the tables are moved there.
    void reorder();
    std::uint64_t reorderings() const;           // done so far; each moves bodies to other rows of state()
    std::size_t row_of(std::size_t body) const;  // in the tables of state(); throws std::out_of_range

    // Reading state; on a device each call downloads.
    BodyState body(std::size_t index) const;                       // throws std::out_of_range
    std::vector<Quarantine> quarantines() const;                   // bodies that are in quarantine, in order
    std::vector<BodyContact> contacts_of(std::size_t body) const;  // throws the same; reads all contacts
    [[deprecated("use contacts_of")]] std::vector<BodyContact> touching(std::size_t body) const { return contacts_of(body); }
    std::vector<BodyState> bodies() const;
    // All contacts of the last step, ordered by bodies and parts. Reads all bodies and contacts.
    std::vector<ContactState> contacts() const;
    // Sum of the contact forces on each body in the last substep, N; 0 without contacts. Reads all contacts.
    std::vector<vec3> touch_forces(std::span<const std::size_t> bodies) const;
    // Events (compute/events.h), from the next step on; none at first. They are kept until taken. Steps are then waited
    // for one by one, and a device's contacts are read back after each. Pairs that touch already begin with the next step.
    // Throws std::invalid_argument for a speed below 0.
    void set_events(const EventSettings& settings);
    const EventSettings& event_settings() const;
    // What overlaps sensors at present, in order. Reads all bodies.
    std::vector<SensorOverlap> sensed() const;
    std::vector<Event> take_events();  // since the last call, in order
    // The first surface that a ray meets from outside, m. Shapes in which it begins, and back faces of planes and
    // surfaces, are ignored. Throws std::invalid_argument for a ray that is not
    // finite or a direction not of unit length.
    std::optional<RayHit> cast_ray(const Ray& ray) const;
    // Queries in batches (compute/queries.h), on the runner's threads. The first after a step or an edit reads all bodies
    // back and builds a tree over them. Throw std::invalid_argument, naming the query, for values that are not finite or out
    // of range, a direction not of unit length, and a shape that cannot be cast.
    std::vector<std::optional<QueryHit>> cast_rays(std::span<const RayQuery> rays) const;  // the nearest of each
    std::vector<std::uint8_t> rays_hit(std::span<const RayQuery> rays) const;              // 1: it hits something
    QueryLists<QueryHit> cast_rays_through(
        std::span<const RayQuery> rays) const;  // the first of each body and part, near ones first
    std::vector<std::optional<QueryHit>> cast_shapes(std::span<const ShapeCast> casts) const;  // the nearest of each
    // The nearest point of each; `distance` is that from the query's point, 0 in a body.
    std::vector<std::optional<QueryHit>> closest_points(std::span<const ClosestQuery> points) const;
    QueryLists<QueryPart> overlaps(std::span<const ShapeOverlap> shapes) const;  // all, by body and part
    // The same with depths and the ways out.
    QueryLists<Penetration> penetrations(std::span<const ShapeOverlap> shapes) const;
    JointState joint(std::size_t index) const;  // throws std::out_of_range; reads all joints
    std::vector<JointState> joints() const;
    VehicleState vehicle(std::size_t index) const;  // throws std::out_of_range; reads all vehicles
    std::vector<VehicleState> vehicles() const;
    // The present scene: existing bodies with their poses and velocities; fragments are ordinary bodies. A world made
    // of it continues, but not bit-identically: contacts begin anew, sleepers are awake, and low-order parts of
    // positions are lost. save() keeps all of these. Throws std::logic_error in a world of several copies.
    Scene snapshot() const;
    Statistics statistics() const;
    // What a rank has of a world that is shared out (compute/distributed), for whoever makes do with that; none of any other
    // world. Valid until the next call that is not const, and no read of the whole world in between.
    struct Share {
        const State& state;  // rows of the bodies that the rank moves, of ghosts, and of those that do not move
        const std::map<std::size_t, Body>& still;  // the latter, by id: on every rank
        const std::vector<Hull>& hulls;            // of all bodies, each once
    };
    std::optional<Share> share() const;
    // On several ranks, collective: shares the world out now where that can be, and not only after some steps without a look at
    // the whole. Else does nothing.
    void share_out();
    const State& state() const;  // all tables of a step (compute/tables/state.h), bodies and contacts up to date
    // XXH64 over position, orientation, velocity and angular velocity in id order; if bodies may break, also over which exist.
    std::uint64_t state_hash() const;

    // The whole state as bytes (compute/checkpoint.h). Reads everything back.
    std::vector<std::byte> save() const;
    // The same in pieces: calls take(offset, bytes) with all bytes in their order, at offsets from 0; then possibly once more
    // with those at offset 0, which are to replace the first ones. On several ranks (compute/distributed) all call it, and take()
    // is called on the first alone; of a world that is shared out no rank holds more than a piece beside its share. What take()
    // throws goes to the caller.
    using TakePiece = std::function<void(std::uint64_t, std::span<const std::byte>)>;
    void save_in_pieces(const TakePiece& take) const;
    // Returns to a saved state: of this world, or of another one of the same scene, whatever its settings (which are
    // restored, too), backend and threads. Later steps give the same bits as those of the world that was saved; bodies
    // added since then are gone. Uploads everything. Buffers that a canvas draws from may be replaced. Throws
    // CheckpointError, changing nothing, if the bytes are damaged, of another format, or of another scene.
    void restore(std::span<const std::byte> saved);

    // Rollback. keep_state() keeps the whole state where the runner has it, on a device in its memory, without a transfer of
    // what steps change; of most_kept_states the oldest goes. A state kept at the same number of steps is replaced. Throws as
    // step() does where memory ends, and then keeps no other state.
    void keep_state();
    // Goes back to the state that was kept `steps` steps ago (0: now, undoing edits). Later steps give the same bits as they
    // did, if the same functions are called; events come again. Bodies and joints added since are gone, removed ones are back, as
    // with restore(). The state stays kept; later ones are dropped. Throws std::out_of_range, naming the steps that are
    // kept, if there is none, and then changes nothing. restore() drops all.
    void roll_back(std::uint64_t steps);
    std::vector<std::uint64_t> kept_states() const;  // numbers of steps done at which states are kept, ascending
    void drop_states();                              // all; frees their memory

    std::uint64_t buffer_growths() const;
    std::size_t buffer_bytes() const;  // of all tables and, on the CPU, of the lists beside them; at present
    // Whether later steps are timed stage by stage. Off at first on a Vulkan device, where a timestamp costs time: 10
    // us per stage on lavapipe.
    void set_profiling(bool on);
    [[deprecated("use set_profiling")]] void time_stages(bool on) { set_profiling(on); }
    StageTimes stage_times() const;       // milliseconds per step, mean over the timed steps
    StageTimes last_stage_times() const;  // of the last timed step
    // Tells it from now on when steps, and stages, loops of threads and transfers (if it wants them) ran, the numbers of pairs
    // and contacts after each step, and when buffers grew, bodies were reordered in memory, or broke; null: nothing. Stages
    // of a device need set_profiling.
    void set_timeline(std::shared_ptr<Timeline> timeline);

private:
    friend void restore_tables(State& state, std::span<const std::byte> saved);
    struct Impl;
    // Ranks that share the world hold it in parts while it only steps: what this one has of it, and the world brought together
    // on every rank, for which all of them are to ask.
    Impl& local() const { return *impl_; }
    Impl& whole() const;
    std::unique_ptr<Impl> impl_;
};

std::string hash_text(std::uint64_t hash);  // 16 hexadecimal digits

}  // namespace scree
