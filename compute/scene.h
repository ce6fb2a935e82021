// A scene: what bodies there are, where, of what shape and material. Plain data, in SI units, y up; World simulates it.
#pragma once

#include <glm/glm.hpp>
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
using Shape = std::variant<Sphere, Capsule, Box, Plane>;

enum class Motion {
    dynamic,    // moved by forces and contacts
    fixed,      // never moves
    kinematic,  // moves with its velocity, whatever it meets
};

struct Body {
    std::string name;  // for messages; may be empty
    Motion motion = Motion::dynamic;
    Shape shape = Box{};
    vec3 position{0};              // of the centre of mass, m
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
Scene checked(Scene scene);

// kg and kg m^2 (principal, body frame) of a shape of a given density. A plane has neither: 0.
struct MassProperties {
    float mass = 0;
    vec3 inertia{0};
};
MassProperties mass_properties(const Shape& shape, float density);

}  // namespace scree
