// A scene: bodies, joints and vehicles as plain data in SI units, y up. World simulates it.
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

// Tyre friction, which depends on slip (shaders/physics/contact/tyre.h). Body::friction is that at the best slip.
struct Tyre {
    float best_slip = 0.1f;  // slip of greatest friction, 0.01 to 0.9; sideways the tangent of the slip angle
    float sliding = 0.75f;   // friction when sliding, relative to the greatest, 0 to 1
    bool operator==(const Tyre& o) const { return best_slip == o.best_slip && sliding == o.sliding; }
};

enum class Motion {
    dynamic,    // moved by forces and contacts
    fixed,      // never moves
    kinematic,  // moves with its velocity, not affected by forces and contacts
};

constexpr std::size_t no_body = static_cast<std::size_t>(-1);

enum class Cutting {
    voronoi,    // any shape but a plane: Voronoi cells of similar size
    boxes,      // a box into boxes
    splinters,  // Voronoi cells across the thinnest extent, finer towards the middle: panes
};
struct Cut;  // compute/scene/fracture.h
// Fracture of a dynamic body. It breaks at the end of the step in which one contact exceeds the threshold
// (shaders/physics/fracture/fracture.h says exactly what counts, and what happens to the impulse); its fragments replace
// it. Exactly one of the two thresholds is positive.
struct Fracture {
    float impulse = 0;   // N s, normal impulse of one contact in this step and the last; a static load F: 2 F / rate
    float momentum = 0;  // N s, of the body as the step begins, if a contact takes a tenth of it
    Cutting cutting = Cutting::voronoi;
    std::size_t pieces = 8;  // 2 to 256
    std::size_t depth = 1;   // levels of fragments, 1 to 4; their thresholds scale with mass to the power 2/3
    std::uint32_t seed = 1;  // random seed of the cuts. Equal bodies with equal fractures share the shapes of fragments

    // Made when the scene is checked.
    std::shared_ptr<const Cut> cut{};
    std::size_t first_piece = no_body;  // index of its first fragment; all are contiguous
};

// Mass properties of a body in place of those of its shape at its density. When the scene is checked, the body's frame is
// moved to the centre and the principal axes: `centre` becomes 0, `frame` no turn, and a shape that is then elsewhere a
// compound.
struct Inertial {
    float mass = 1;          // kg, 1e-9 to 1e15
    vec3 centre{0};          // centre of mass, in the frame of the shape, m
    vec3 inertia{1};         // principal moments of inertia, kg m^2, 1e-20 to 1e25; none above the sum of the others
    vec4 frame{0, 0, 0, 1};  // principal axes to the frame of the shape, quaternion
};

// A frame within another.
struct BodyFrame {
    vec3 position{0};              // m
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w
};

struct Body {
    std::string name{};  // for messages; may be empty
    Motion motion = Motion::dynamic;
    Shape shape = Box{};
    Role role = Role::solid;  // of the shape, and of all its parts if not solid; no mesh or height field
    // Position of the centre of mass, m. For a hull or compound, until the scene is checked, the origin of its points
    // or parts; for a mesh or height field always.
    vec3 position{0};
    vec4 orientation{0, 0, 0, 1};        // quaternion x, y, z, w; normalised when the scene is checked
    vec3 velocity{0};                    // m/s, at most Settings::max_speed
    vec3 angular_velocity{0};            // rad/s, world axes
    float density = 1000;                // kg/m^3
    std::optional<Inertial> inertial{};  // none: from shape and density. Required of a dynamic body without solid parts
    // Its material (Material), but for parts that have their own.
    float friction = 0.6f;         // Coulomb coefficient, >= 0; a pair takes sqrt(a b), unless friction_rule says otherwise
    float restitution = 0;         // 0 to 1; a pair takes the larger, unless restitution_rule says otherwise
    float rolling_resistance = 0;  // m, lever arm of the normal force that resists rolling, >= 0; a pair takes the larger
    float static_friction = unset, spinning_resistance = unset, restitution_threshold = unset;
    vec3 surface_velocity{0};  // m/s, in the body's frame
    CombineRule friction_rule = CombineRule::usual, restitution_rule = CombineRule::usual;
    float cohesion = 0, cohesion_range = unset;  // J/m^2; m
    float linear_damping = 0;                    // 1/s, >= 0
    float angular_damping = 0;                   // 1/s, >= 0
    float gravity_scale = 1;
    float drag = 1;                      // drag coefficient, >= 0, in Fields::wind and Fields::water
    std::uint64_t user_data = 0;         // the user's own; no result depends on it
    std::optional<vec3> color{};         // of pictures: red, green, blue in sRGB, 0 to 1; none: a light grey
    std::optional<Filter> filter{};      // which bodies it collides with; none: all
    std::optional<Tyre> tyre{};          // of spheres, capsules, cylinders, also as parts; none: Coulomb friction
    std::optional<Fracture> fracture{};  // none: unbreakable
    // The body of which this is a fragment, inactive until that one breaks; its pose is the initial one. Fragments are
    // appended when the scene is checked; scene files have none.
    std::size_t piece_of = no_body;
    // The frame in which the body was described, in the body's own: none until the scene is checked, which moves the frames of
    // hulls, compounds and bodies with `inertial`; then none for one that stayed. Importers give that of the link.
    std::optional<BodyFrame> origin{};
};

// ---- joints
// A joint connects a frame in body A with a frame in body B, which coincide at coordinates 0. x is the axis of a hinge
// or slider, and the middle of a cone.
constexpr float unlimited = 1e30f;

struct Limits {       // of the position of B relative to A along an axis (m) or about it (rad, any number of turns)
    float lower = 0;  // -unlimited to unlimited, not above `upper`
    float upper = 0;
};
struct Spring {                   // spring-damper towards `rest`; with stiffness 0 a damper, with both 0 nothing yet
    float stiffness = 0;          // N/m or N m/rad, 0 to 1e12
    float damping = 0;            // N s/m or N m s/rad, 0 to 1e12
    float rest = 0;               // m or rad
    float max_force = unlimited;  // N or N m; of a spring that does nothing yet what World::set_drives keeps
    float speed = 0;              // m/s or rad/s, -1e4 to 1e4, towards which it damps
};
struct Motor {            // drives B relative to A
    float speed = 0;      // m/s or rad/s
    float max_force = 0;  // N or N m
};
// Behaviour along or about one axis: limits, a spring with damping, and a motor or dry friction. A spring that acts beside
// a motor or friction has no max_force and no speed. A position motor is a spring whose `rest` World::set_drives moves.
struct Axis {
    bool locked = false;  // no motion
    std::optional<Limits> limits;
    std::optional<Spring> spring;
    std::optional<Motor> motor;
    float friction = 0;  // dry friction, N or N m
    // Inertia of a rotor that turns with the axis (armature): adds to the axis's own inertia and to nothing else, kg or
    // kg m^2, 0 to 1e9. Of a rotor behind a gear of ratio n: n^2 times its inertia. Below 1e-9: none.
    float armature = 0;
};

struct Ball {            // anchors coincide; rotation is free
    float friction = 0;  // N m about each axis
};
struct Hinge {  // B rotates about x
    Axis turn;
};
struct Slider {  // B moves along x without rotation
    Axis slide;
};
struct Fixed {};                   // no relative motion
struct Distance {                  // between the anchors: a rope (0 to its length), a rod (both equal), or a spring
    float least = 0;               // m
    float greatest = unlimited;    // m
    std::optional<Spring> spring;  // `rest` is its length
};
struct ConeTwist {       // anchors coincide; B's x axis stays within a cone about A's
    float swing = 0;     // half the cone's angle, rad, 0 to pi
    Limits twist;        // about x
    float friction = 0;  // N m, of the twist
};
struct SixDof {    // each axis as given; by default free
    Axis x, y, z;  // along A's axes
    Axis twist;    // about x, after the swing
    Axis swing_y, swing_z;
};
using SixDegrees [[deprecated("use SixDof")]] = SixDof;

enum class JointAxis { x, y, z, twist, swing_y, swing_z };  // along, then about, the axes of a joint's frame in A
struct CoupledAxis {
    std::size_t joint = 0;            // index of the scene's joint; no coupling
    float factor = 1;                 // of its coordinate in the sum
    std::optional<JointAxis> axis{};  // none: x of a slider and of a distance, the twist of others
};
// A coupling joins no two bodies but the axes of other joints: its coordinate is the sum of factor times coordinate of these,
// less `offset`. Without limits, spring, motor and friction it is locked at 0: gears, a rack, a pulley, a finger that follows
// another; with them it is a tendon. It has no a and b, anchors and frames; its break_force is that of its coordinate.
struct Coupling {
    std::vector<CoupledAxis> joints;  // 1 to most_coupled_axes
    // Of the last one, in place of its factor: a polynomial's coefficients of the first power to the fourth; at most 4 joints.
    std::vector<float> curve{};
    std::optional<float> offset{};  // none: the sum at the start
    Axis sum{};                     // without armature
};
constexpr std::size_t most_coupled_axes = 8;
// Limits of a group of joints that share bodies or couplings, with at least one coupling.
constexpr std::size_t most_joints_of_coupled_block = 54;  // couplings count as joints
constexpr std::size_t most_couplings_of_block = 26;
using JointKind = std::variant<Ball, Hinge, Slider, Fixed, Distance, ConeTwist, SixDof, Coupling>;
// The axis along or about which a joint of that kind moves, if it has one: x of a slider, distance or coupling, else twist.
JointAxis main_axis(const JointKind& kind);

constexpr std::size_t the_world = static_cast<std::size_t>(-1);  // in place of a body: the static world

struct Joint {
    std::string name{};  // for messages; may be empty
    JointKind kind = Ball{};
    std::size_t a = the_world, b = the_world;  // bodies; different, and at least one dynamic
    vec3 anchor_a{0}, anchor_b{0};             // in the body's frame, from its centre of mass (the world's: from its origin), m
    vec4 frame_a{0, 0, 0, 1}, frame_b{0, 0, 0, 1};  // joint to body, quaternions; normalised when checked
    bool collide = false;                           // whether the two bodies collide
    float break_force = unlimited;                  // N, mean over a step; above it the joint breaks
    float break_torque = unlimited;                 // N m
    bool broken = false;                            // already broken
    // Angle of a hinge, a twist or a swing alone at the start, to tell whole turns: that of the poses nearest to it, rad. Left
    // out: the nearest to 0 that lies within the limits, or violates them by less than 0.1.
    std::optional<float> angle{};
};

// ---- vehicles
// A chassis and wheels, each connected by a joint from the chassis (a) to the wheel (b), whose x axis is the axle and
// points to the left, and whose y axis points up: a Hinge, or a SixDof with free twist, a spring along y as suspension,
// and for a steered wheel equal limits of swing_y. The step drives these joints' motors. compute/vehicle_presets.h
// makes such bodies and joints.
struct Controls {
    float throttle = 0;    // -1 to 1, < 0: backwards
    float brake = 0;       // 0 to 1. A braked wheel is not driven
    float steer = 0;       // -1 to 1, 1: to the left
    float hand_brake = 0;  // 0 to 1
    bool operator==(const Controls& o) const {
        return throttle == o.throttle && brake == o.brake && steer == o.steer && hand_brake == o.hand_brake;
    }
};
struct Wheel {
    std::size_t joint = 0;  // index of the scene's joint
    float radius = 0.3f;    // m, 1e-3 to 1e3
    float drive = 0;        // share of the engine, >= 0; shares are normalised to a sum of 1
    float brake = 0;        // N m, at full brake
    float hand_brake = 0;   // N m
    bool steers = false;    // steered about the joint's y axis (Ackermann)
    float skid = 0;         // skid steering: part of the steering added to its throttle, -1 to 1
};
struct Engine {
    float torque = 1500;       // N m, at full throttle, of all driven wheels together
    float power = 75000;       // W; above power / torque the torque falls as 1 / speed
    float top_speed = 50;      // m/s
    float reverse_speed = 10;  // backwards, m/s
    float drag = 40;           // N m, without throttle, of all driven wheels together
};
struct Steering {
    float angle = 0.6f;  // rad, of a wheel on the centre line at full lock, 0.01 to 1.2
    float time = 0.4f;   // s, from straight ahead to full lock, 0.01 to 100
    float lateral = 8;   // m/s^2, greatest lateral acceleration: limits curvature at speed, 0.1 to 1e4
};
struct WayPoint {
    vec3 position{0};  // m
    float speed = 10;  // m/s, 0.1 to 1e3; interpolated linearly to the next
};
struct Vehicle {
    std::string name{};  // for messages; may be empty
    std::size_t chassis = 0;
    std::vector<Wheel> wheels;  // 1 to 8
    Engine engine{};
    Steering steering{};
    Controls controls{};  // initial; see World::drive
    // Way points, from the first (where the vehicle begins) to the last, where it stops; at least 2, or none. A vehicle
    // with a route follows it on the device until World::drive ends that.
    std::vector<WayPoint> route{};
    bool loops = false;  // the route is closed
    // State, for snapshots.
    bool by_route = true;  // whether it follows its route, if any
    std::size_t next = 1;  // index of the next way point
};

// Two bodies that never collide with each other, whatever their filters.
struct Exclusion {
    std::size_t a = 0, b = 0;  // different bodies
    bool operator==(const Exclusion& o) const { return a == o.a && b == o.b; }
};

// Cement between two bodies: a round beam that resists stretch, shear, bending and twist, until a stress at its edge exceeds a
// strength (Potyondy, Cundall, 2004). The bodies still collide, and do not sleep while it holds. compute/bonds.h makes many.
struct Bond {
    std::size_t a = 0, b = 0;  // bodies; different, and at least one dynamic
    float radius = 0;          // m, of its section
    // Young's modulus, Pa; 0, and more than a substep allows: as stiff as the substep allows.
    float stiffness = 0;
    float damping = 0.5f;       // ratio, 0 to 10, as far as the substep allows
    float tension = unlimited;  // strengths, Pa
    float shear = unlimited;
    bool broken = false;
    // Its length, m; 0: the bond is placed when the scene is checked: on the line between the centres of mass, without stress.
    float length = 0;
    vec3 anchor_a{0}, anchor_b{0};                  // in the body's frame, from its centre of mass, m
    vec4 frame_a{0, 0, 0, 1}, frame_b{0, 0, 0, 1};  // bond to body, x along the bond
};

// ---- fields, which act on all dynamic bodies that are awake
struct Wind {
    vec3 velocity{0};      // m/s
    float density = 1.2f;  // of the air, kg/m^3; 0.5 density drag area speed^2 is the force on a body
};
// A plane of water: buoyancy by the submerged volume, drag, damping.
struct Water {
    vec3 normal{0, 1, 0};  // up; normalised when the scene is checked
    float offset = 0;      // m, of the surface along the normal from the origin
    float density = 1000;  // kg/m^3
    vec3 velocity{0};      // m/s
    float damping = 0.5f;  // 1/s, of velocity and spin of what is submerged
};
struct Attractor {  // pulls with strength / distance^2
    vec3 position{0};
    float strength = 0;  // m^3/s^2; < 0: pushes away
};
constexpr std::size_t most_attractors = 4;
struct Fields {
    std::optional<Wind> wind{};
    std::optional<Water> water{};
    std::vector<Attractor> attractors{};  // at most most_attractors
    float attractor_radius = 0.5f;        // m, within which their pull no longer grows
    bool any() const { return wind || water || !attractors.empty(); }
};

// A periodic cell: what leaves it through one side comes back through the opposite one, and each body meets the nearest image of
// every other, so that a few thousand bodies stand for endlessly many. Along an axis where the size is 0 there is none.
struct PeriodicCell {
    vec3 size{0};    // m, 0 or 1e-2 to 1e5, and then at least four times the bounding radius of each grain
    vec3 centre{0};  // m
    // 1/s, -10 to 10, at which it stretches about its centre along each axis; bodies at its sides are drawn along by their
    // images.
    vec3 rate{0};
    bool any() const { return size.x > 0 || size.y > 0 || size.z > 0; }
};

struct Scene {
    vec3 gravity{0, -9.81f, 0};  // m/s^2
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    std::vector<Vehicle> vehicles{};
    std::vector<Exclusion> exclusions{};
    Fields fields{};
    std::vector<Bond> bonds{};
    PeriodicCell periodic{};
};

// A joint of two bodies of the scene (or the world) at their present poses, from anchor and x axis in world
// coordinates. Throws SceneError for an axis of length 0.
Joint joint_at(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis = vec3(1, 0, 0));
// The same with an anchor in A and one in B, world coordinates, for a Distance.
Joint joint_between(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor_a, vec3 anchor_b);

// An invalid scene. `pointer`: JSON pointer of the value ("/bodies/17/shape/sphere/radius").
struct SceneError : std::runtime_error {
    SceneError(std::string place, const std::string& reason);
    std::string pointer;
};

// The validated scene, with unit quaternions and normals. Throws SceneError, naming the body, for values that are not
// finite, out of range (sizes 1e-3 to 1e5 m, positions to 1e6 m, density 1e-3 to 1e6 kg/m^3, velocities to 1e4), or
// contradictory (a plane that moves). Hulls and compounds are moved to their centre of mass and principal axes of
// inertia, and the body's position and orientation with them, so that every point stays in place. `notes`, if given,
// receives remarks on hulls simplified to 64 vertices and on defects of meshes. Breakable bodies are cut: their
// fragments, and those of these, are appended behind all other bodies, in the order of the bodies they belong to.
Scene checked(Scene scene, std::vector<std::string>* notes = nullptr);

// Mass (kg) and principal moments of inertia (kg m^2, body frame) of a shape at a density (kg/m^3). 0 for planes,
// meshes and height fields.
struct MassProperties {
    float mass = 0;
    vec3 inertia{0};
};
MassProperties mass_properties(const Shape& shape, float density);
MassProperties mass_properties(const Body& body);  // of a checked body

// Refuses fields out of range with SceneError, and makes the water's normal a unit vector; checked() calls it.
void check_world_fields(Fields& fields);

Material material_of(const Body& body);
void set_material(Body& body, const Material& material);  // parts keep those of their own

}  // namespace scree
