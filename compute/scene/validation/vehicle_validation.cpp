// Validation of vehicles.
#include "compute/scene/validation/vehicle_validation.h"

#include <cmath>
#include <map>
#include <string>

#include "compute/scene/validation/validator.h"
#include "compute/scene/vehicle_records.h"
#include "compute/schema/check.h"
#include "compute/schema/vehicle.h"

namespace scree {

namespace {

static_assert(schema::field_of(&Vehicle::wheels).range.high == physics::MOST_WHEELS);
constexpr float least_cosine = 0.99f;  // between two axles

// Owner vehicle of each chassis or wheel.
using Owners = std::map<std::size_t, std::size_t>;

void take(const Examination& vehicle, Owners& owners, std::size_t index, std::size_t what, const std::string& key,
          const std::string& called) {
    const auto [found, fresh] = owners.try_emplace(what, index);
    if (!fresh)
        vehicle.refuse(key, called + " of vehicle " + std::to_string(found->second) + " already; each belongs to one vehicle");
}

void examine_joint(const Examination& vehicle, const std::string& key, const Wheel& wheel, std::size_t chassis,
                   const Scene& scene) {
    if (wheel.joint >= scene.joints.size())
        vehicle.refuse(key + "/joint", "the wheel is on no joint: there is no joint " + std::to_string(wheel.joint) +
                                           "; the scene has " + std::to_string(scene.joints.size()));
    const Joint& joint = scene.joints[wheel.joint];
    const std::string named = "joint " + std::to_string(wheel.joint) + (joint.name.empty() ? "" : " (\"" + joint.name + "\")");
    if (joint.a != chassis)
        vehicle.refuse(key + "/joint", named + " does not begin at the chassis: its a must be body " + std::to_string(chassis));
    if (joint.b == the_world || scene.bodies[joint.b].motion != Motion::dynamic)
        vehicle.refuse(key + "/joint", named + " has no wheel: its b must be a dynamic body");
    const auto* hinge = std::get_if<Hinge>(&joint.kind);
    const auto* six = std::get_if<SixDof>(&joint.kind);
    if (!hinge && !six) vehicle.refuse(key + "/joint", named + " must be a hinge or have six degrees, for a wheel to turn on it");
    const Axis& turn = hinge ? hinge->turn : six->twist;
    if (turn.locked || turn.limits)
        vehicle.refuse(key + "/joint", named + " prevents rotation of the wheel: its twist must be free");
    const bool steerable = six && six->swing_y.limits && six->swing_y.limits->lower == six->swing_y.limits->upper;
    if (wheel.steers && !steerable)
        vehicle.refuse(key + "/steers",
                       named + " cannot be steered: it must be a six_degrees joint whose swing_y has limits, both 0");
}

void examine_wheels(const Examination& vehicle, std::size_t index, const Vehicle& v, const Scene& scene, Owners& wheels) {
    for (std::size_t k = 0; k < v.wheels.size(); ++k) {
        const Wheel& wheel = v.wheels[k];
        const std::string key = "/wheels/" + std::to_string(k);
        examine_joint(vehicle, key, wheel, v.chassis, scene);
        take(vehicle, wheels, index, scene.joints[wheel.joint].b, key + "/joint",
             "body " + std::to_string(scene.joints[wheel.joint].b) + " is a wheel");
        if (glm::dot(axle_of(scene.joints[v.wheels[0].joint]), axle_of(scene.joints[wheel.joint])) < least_cosine)
            vehicle.refuse(key + "/joint", "its axle is not parallel to the first wheel's: all axles point to the left");
    }
}

void examine_route(const Examination& vehicle, const Vehicle& v) {
    if (v.route.empty()) return;
    if (v.next > v.route.size())
        vehicle.refuse("/next",
                       "there is no way point " + std::to_string(v.next) + "; the route has " + std::to_string(v.route.size()));
    for (std::size_t k = 1; k < v.route.size(); ++k)
        if (glm::distance(v.route[k].position, v.route[k - 1].position) < 0.01f)
            refuse(vehicle / "route" / k / "position", "lies on the way point before it; leave one of them out");
}

void examine(std::size_t index, const Vehicle& v, const Scene& scene, Owners& chassis, Owners& wheels) {
    const Examination vehicle("vehicles", "vehicle", index, v.name);
    for (std::size_t k = 0; k < v.wheels.size(); ++k)
        if (v.wheels[k].radius <= 0)
            refuse(vehicle / "wheels" / k / "radius", "must be positive, m, is " + text_of(v.wheels[k].radius));
    schema::check_fields(vehicle, v);
    if (v.chassis >= scene.bodies.size())
        vehicle.refuse("/chassis", "there is no body " + std::to_string(v.chassis) + "; the scene has " +
                                       std::to_string(scene.bodies.size()));
    if (scene.bodies[v.chassis].motion != Motion::dynamic) vehicle.refuse("/chassis", "must be a dynamic body");
    take(vehicle, chassis, index, v.chassis, "/chassis", "body " + std::to_string(v.chassis) + " is the chassis");
    examine_wheels(vehicle, index, v, scene, wheels);
    examine_route(vehicle, v);
}

}  // namespace

void check_vehicles(const Scene& scene) {
    Owners chassis, wheels;
    for (std::size_t i = 0; i < scene.vehicles.size(); ++i) examine(i, scene.vehicles[i], scene, chassis, wheels);
}

}  // namespace scree
