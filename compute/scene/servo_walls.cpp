// Servo walls as sliders with a motor and a damper.
//
// A servo moves a wall of area A with v = gain (stress - load / A). So does a wall under the force stress A against a damper of
// A / gain. Here joints and contacts are solved together: a wall whose velocity followed the load of the step before would
// need a gain below that which rigid contacts leave, and would chatter.
#include "compute/servo_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/error_reason.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/check.h"
#include "compute/schema/servo_wall.h"

namespace scree {

namespace {

constexpr double response = 0.01;  // s
constexpr double heaviest = 1e6;   // kg/m^3, as of every body

// Of a checked body along a unit vector, m^2; 0 of what has none of its own.
double shadow_of(const Body& body, glm::dvec3 along) {
    const glm::dvec3 axis = glm::abs(glm::conjugate(double_quaternion(body.orientation)) * along);
    if (const auto* box = std::get_if<Box>(&body.shape)) {
        const glm::dvec3 half(box->half_extents);
        return 4 * (axis.x * half.y * half.z + axis.y * half.z * half.x + axis.z * half.x * half.y);
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) {
        const double radius = double{cylinder->radius}, across = std::sqrt(std::max(0.0, 1 - axis.y * axis.y));
        return std::numbers::pi * radius * radius * axis.y + 4 * radius * double{cylinder->half_height} * across;
    }
    return 0;
}

// Scales mass and moments of inertia, as far as densities go.
void make_heavier(Body& body, double factor) {
    if (body.inertial) {
        factor = std::min(factor, 1e15 / double{body.inertial->mass});
        body.inertial->mass *= static_cast<float>(factor);
        body.inertial->inertia *= static_cast<float>(factor);
        return;
    }
    auto* compound = std::get_if<Compound>(&body.shape);
    double densest = double{body.density};
    if (compound)
        for (const Part& part : compound->parts) densest = std::max(densest, double{part.density});
    const auto times = static_cast<float>(std::min(factor, heaviest / densest));
    body.density *= times;
    if (compound)
        for (Part& part : compound->parts) part.density *= times;
}

// The body as a world has it; none of a mesh, which may be a file that has not been read.
std::optional<Body> checked_alone(const Body& body, std::size_t index) {
    if (std::holds_alternative<Mesh>(body.shape)) return std::nullopt;
    Scene alone;
    alone.bodies.push_back(body);
    alone.bodies[0].fracture.reset();
    try {
        return checked(std::move(alone)).bodies.at(0);
    } catch (const SceneError& error) {
        const std::string inside = "/bodies/0";
        if (!error.pointer.starts_with(inside)) throw;
        throw SceneError("/bodies/" + std::to_string(index) + error.pointer.substr(inside.size()), reason_of(error));
    }
}

}  // namespace

std::size_t add_servo_wall(Scene& scene, const ServoWall& wall, const std::string& place) {
    ServoWall asked = wall;
    try {
        schema::check_fields(Examination{}, asked);
    } catch (const SceneError& error) {
        throw SceneError(place + error.pointer, reason_of(error));
    }
    const auto refuse = [&](const char* key, const std::string& reason) { throw SceneError(place + key, reason); };
    if (!(wall.stress > 0)) refuse("/stress", "must be above 0 Pa");
    if (!(wall.max_speed > 0)) refuse("/max_speed", "must be above 0 m/s");
    if (wall.body >= scene.bodies.size())
        refuse("/body",
               "there is no body " + std::to_string(wall.body) + "; the scene has " + std::to_string(scene.bodies.size()));
    Body& body = scene.bodies[wall.body];
    if (body.motion != Motion::dynamic) refuse("/body", "must be a dynamic body: it moves with the stress");
    for (std::size_t i = 0; i < scene.joints.size(); ++i)
        if (scene.joints[i].a == wall.body || scene.joints[i].b == wall.body)
            refuse("/body", "is held by joint " + std::to_string(i) + " already; a servo wall has one of its own");
    const glm::dvec3 axis(wall.axis);
    const double length = std::sqrt(glm::dot(axis, axis));
    if (!(length > 1e-6)) refuse("/axis", "must not be of length 0");

    const std::optional<Body> known = checked_alone(body, wall.body);
    double area = double{wall.area};
    if (!(area > 0) && known) area = shadow_of(*known, axis / length);
    if (!(area > 0)) refuse("/area", "is needed: only boxes and cylinders have an area of their own");
    const double gain = wall.gain ? double{*wall.gain} : double{wall.max_speed} / double{wall.stress};
    const double damping = area / gain;
    if (!(damping <= 1e12)) refuse("/gain", "must be at least area / 1e12");

    Axis slide;
    slide.motor = Motor{wall.max_speed, static_cast<float>(double{wall.stress} * area)};
    slide.spring = Spring{.damping = static_cast<float>(damping)};
    Joint joint = joint_at(scene, Slider{slide}, the_world, wall.body, body.position, wall.axis);
    joint.name = wall.name.empty() ? body.name : wall.name;
    body.gravity_scale = 0;
    if (const double mass = known ? double{mass_properties(*known).mass} : 0; mass > 0 && mass < response * damping)
        make_heavier(body, response * damping / mass);
    scene.joints.push_back(std::move(joint));
    return scene.joints.size() - 1;
}

}  // namespace scree
