// Vehicle records: wheel positions, engine shares, routes.
#include "compute/scene/vehicle_records.h"

#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree {

namespace {

physics::VehicleDynamics handling_of(const Vehicle& vehicle, const Scene& scene, std::vector<physics::WayPoint>& way_points) {
    physics::VehicleDynamics made{};
    made.chassis = static_cast<physics::uint>(vehicle.chassis);
    made.wheels = static_cast<physics::uint>(vehicle.wheels.size());
    made.route = static_cast<physics::uint>(way_points.size());
    made.points = static_cast<physics::uint>(vehicle.route.size());
    for (const WayPoint& point : vehicle.route) way_points.push_back({point.position, point.speed});
    made.frame = scene.joints[vehicle.wheels[0].joint].frame_a;
    made.top_speed = vehicle.engine.top_speed;
    made.reverse_speed = vehicle.engine.reverse_speed;
    made.lateral = vehicle.steering.lateral;
    made.loops = vehicle.loops;
    made.throttle = vehicle.controls.throttle;
    made.brake = vehicle.controls.brake;
    made.steer = vehicle.controls.steer;
    made.hand_brake = vehicle.controls.hand_brake;
    made.by_route = vehicle.by_route && !vehicle.route.empty();
    made.next = static_cast<physics::uint>(vehicle.next);
    return made;
}

// Wheel positions, relative to the middle of the unsteered axle, about which the vehicle turns.
void place_wheels(physics::Vehicle& made, const Vehicle& vehicle, const Scene& scene) {
    const std::size_t n = vehicle.wheels.size();
    float aside = 0, axis = 0, all = 0, fixed = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const vec3 place = physics::rotate_back(made.dynamics.frame, scene.joints[vehicle.wheels[k].joint].anchor_a);
        made.wheel[k].ahead = place.z;
        made.wheel[k].aside = place.x;
        aside += place.x / static_cast<float>(n);
        all += place.z / static_cast<float>(n);
        if (!vehicle.wheels[k].steers) axis += place.z, ++fixed;
    }
    axis = fixed > 0 ? axis / fixed : all;
    float base = 0, steered = 0, widest = 0.1f;
    for (std::size_t k = 0; k < n; ++k) {
        physics::VehicleWheel& wheel = made.wheel[k];
        wheel.aside -= aside;
        wheel.ahead = vehicle.wheels[k].steers ? wheel.ahead - axis : 0;
        widest = std::max(widest, std::abs(wheel.aside));
        if (vehicle.wheels[k].steers) base += std::abs(wheel.ahead), ++steered;
    }
    // A skid-steered vehicle turns about one of its sides at full lock.
    made.dynamics.tightest = steered > 0 ? portable::tan(vehicle.steering.angle) * steered / std::max(base, 0.01f) : 1 / widest;
    made.dynamics.turning = made.dynamics.tightest / vehicle.steering.time;
}

}  // namespace

vec3 axle_of(const Joint& joint) {
    return physics::rotate(joint.frame_a, vec3(1, 0, 0));
}

std::vector<physics::Vehicle> vehicle_records(const Scene& scene, const std::vector<std::uint32_t>& joint_records,
                                              std::vector<physics::WayPoint>& way_points) {
    std::vector<physics::Vehicle> records;
    for (const Vehicle& vehicle : scene.vehicles) {
        physics::Vehicle& made = records.emplace_back();
        made.dynamics = handling_of(vehicle, scene, way_points);
        float shares = 0;
        for (const Wheel& wheel : vehicle.wheels) shares += wheel.drive;
        for (std::size_t k = 0; k < vehicle.wheels.size(); ++k) {
            const Wheel& wheel = vehicle.wheels[k];
            physics::VehicleWheel& record = made.wheel[k];
            const float share = shares > 0 ? wheel.drive / shares : 0;
            record.joint = joint_records[wheel.joint];
            record.body = static_cast<physics::uint>(scene.joints[wheel.joint].b);
            record.radius = wheel.radius;
            record.torque = share * vehicle.engine.torque;
            record.power = share * vehicle.engine.power;
            record.drag = share * vehicle.engine.drag;
            record.brake = wheel.brake;
            record.hand_brake = wheel.hand_brake;
            record.skid = wheel.skid;
            record.steers = wheel.steers;
        }
        place_wheels(made, vehicle, scene);
    }
    return records;
}

}  // namespace scree
