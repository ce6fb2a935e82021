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

namespace scree {

using glm::vec3;
using glm::vec4;

struct Sphere {
    float radius = 0.5f;  // m
};
struct Capsule {               // along the body's y axis
    float radius = 0.3f;       // m
    float half_height = 0.3f;  // m, from the centre to the centre of a cap; 0 is a sphere
};
struct Box {
    vec3 half_extents{0.5f};  // m
};
struct Plane {             // infinite, solid behind the normal; fixed bodies only, whose position and orientation it ignores
    vec3 normal{0, 1, 0};  // normalised when the scene is checked
    float offset = 0;      // m, along the normal from the origin
};
struct Cylinder {              // along the body's y axis
    float radius = 0.3f;       // m
    float half_height = 0.3f;  // m
};
struct Cone {             // along the body's y axis, the apex up; its centre of mass is a quarter of its height above its base
    float radius = 0.3f;  // of the base, m
    float height = 0.6f;  // m
};
struct HullForm;                             // compute/hull.h
struct Hull {                                // the convex hull of points
    std::vector<vec3> points;                // m, at least 4, not in a plane; inner and repeated ones do not matter
    std::shared_ptr<const HullForm> form{};  // made when the scene is checked
};
using Shape = std::variant<Sphere, Capsule, Box, Plane, Cylinder, Cone, Hull>;

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
struct Cut;  // compute/fracture.h
// How a dynamic body comes apart, and what breaks it. It breaks at the end of the step in which one contact has carried more than
// the threshold (shaders/physics/fracture.h says exactly what counts, and what becomes of the blow); its pieces go on from there.
// One of the two thresholds is positive.
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
    // Of the centre of mass, m; of a hull where its points' origin lies, until the scene is checked.
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
    std::optional<Fracture> fracture{};  // none: it never breaks
    // Of which body of the scene this is a piece, not there until that one breaks: its place is the one that it would have at the
    // start. Pieces are added behind the other bodies when the scene is checked; no scene says it.
    std::size_t piece_of = no_body;
};

struct Scene {
    vec3 gravity{0, -9.81f, 0};  // m/s^2
    std::vector<Body> bodies;
};

// A scene that cannot be simulated. `pointer` is the place as a JSON pointer ("/bodies/17/shape/sphere/radius").
struct SceneError : std::runtime_error {
    SceneError(std::string place, const std::string& reason);
    std::string pointer;
};

// The scene with quaternions and normals of unit length. Throws SceneError, naming the body, for what is not finite, out of range
// (sizes 1e-3 to 1e5 m, positions to 1e6 m, density 1e-3 to 1e6 kg/m^3, velocities to 1e4), or contradictory (a plane that
// moves).
// A hull is brought to its centre of mass and its principal axes of inertia: its points are moved, and the body's position and
// orientation with them, so that every point stays where it is in the world. `notes`, if given, is told of hulls that had more
// than 64 corners and were simplified.
// Bodies that may break are cut: their pieces, and the pieces of those, become bodies behind all others, in the order of the bodies
// that they are pieces of.
Scene checked(Scene scene, std::vector<std::string>* notes = nullptr);

// kg and kg m^2 (principal, body frame) of a shape of a given density. A plane has neither: 0.
struct MassProperties {
    float mass = 0;
    vec3 inertia{0};
};
MassProperties mass_properties(const Shape& shape, float density);

}  // namespace scree
