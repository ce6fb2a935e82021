// What a scene may say: ranges, unit vectors, and the mass of each shape.
#include "compute/scene.h"

#include <cmath>
#include <utility>

#include "compute/scene/fracture.h"
#include "compute/scene/joint_validation.h"
#include "compute/scene/shape_validation.h"
#include "compute/scene/vehicle_validation.h"

namespace scree {

namespace {

constexpr float smallest_density = 1e-3f;
constexpr float largest_density = 1e6f;   // kg/m^3
constexpr float largest_velocity = 1e4f;  // m/s and rad/s
constexpr float largest_gravity = 1e4f;   // m/s^2
constexpr float largest_friction = 100;
constexpr float largest_damping = 1e4f;  // 1/s
constexpr float largest_scale = 1e3f;

Shift examine(const Examination& body, Body& b, CheckedHulls& hulls, std::vector<std::string>* notes) {
    check_shape(body, b.shape, b.motion);
    body.between("/position", b.position, position_range.least, position_range.most, " m");
    body.make_unit("/orientation", b.orientation, "a quaternion x, y, z, w; no turn is [0, 0, 0, 1]");
    body.between("/density", b.density, smallest_density, largest_density, " kg/m^3");
    const Shift shift = bring_to_centre(body, b, hulls, notes);
    body.between("/velocity", b.velocity, -largest_velocity, largest_velocity, " m/s");
    body.between("/angular_velocity", b.angular_velocity, -largest_velocity, largest_velocity, " rad/s");
    body.between("/friction", b.friction, 0, largest_friction, "");
    body.between("/restitution", b.restitution, 0, 1, "");
    body.between("/rolling_resistance", b.rolling_resistance, 0, size_range.most, " m");
    body.between("/linear_damping", b.linear_damping, 0, largest_damping, " 1/s");
    body.between("/angular_damping", b.angular_damping, 0, largest_damping, " 1/s");
    body.between("/gravity_scale", b.gravity_scale, -largest_scale, largest_scale, "");
    if (b.tyre) {
        body.between("/tyre/best_slip", b.tyre->best_slip, 0.01f, 0.9f, "");
        body.between("/tyre/sliding", b.tyre->sliding, 0, 1, "");
    }
    if (b.motion == Motion::fixed && (b.velocity != vec3(0) || b.angular_velocity != vec3(0))) {
        body.refuse("/velocity", "a fixed body has no velocity; a body that moves whatever it meets is \"kinematic\"");
    }
    const MassProperties properties = mass_properties(b.shape, b.density);
    const bool representable = std::isnormal(properties.mass) && std::isnormal(properties.inertia.x) &&
                               std::isnormal(properties.inertia.y) && std::isnormal(properties.inertia.z) &&
                               std::isnormal(1 / properties.mass) && std::isnormal(1 / properties.inertia.x) &&
                               std::isnormal(1 / properties.inertia.y) && std::isnormal(1 / properties.inertia.z);
    if (b.motion == Motion::dynamic && !representable) {
        body.refuse("/density", "size and density give a mass or inertia out of the range of a float");
    }
    return shift;
}

}  // namespace

SceneError::SceneError(std::string place, const std::string& reason)
    : std::runtime_error(place.empty() ? reason : place + ": " + reason), pointer(std::move(place)) {}

Scene checked(Scene scene, std::vector<std::string>* notes) {
    CheckedHulls hulls;
    for (int i = 0; i < 3; ++i) {
        const float g = scene.gravity[i];
        if (g >= -largest_gravity && g <= largest_gravity) continue;
        throw SceneError("/gravity/" + std::to_string(i), out_of_range(g, -largest_gravity, largest_gravity, " m/s^2"));
    }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].piece_of != no_body) continue;  // of a scene that was checked before
        const Shift shift = examine(Examination("bodies", "body", i, scene.bodies[i].name), scene.bodies[i], hulls, notes);
        if (shift) shift_joints(scene, i, shift->centre, shift->axes);
    }
    check_joints(scene);
    check_vehicles(scene);
    add_pieces(scene);
    return scene;
}

}  // namespace scree
