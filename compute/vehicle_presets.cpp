// Vehicle presets.
#include "compute/vehicle_presets.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree {

namespace {

// A vehicle's pose: axes x left, y up, z ahead.
struct Stand {
    vec3 position;
    vec4 turn;

    Stand(vec3 place, float heading) : position(place), turn(0, portable::sin(heading / 2), 0, portable::cos(heading / 2)) {}
    vec3 at(vec3 place) const { return position + physics::rotate(turn, place); }
    vec3 along(vec3 direction) const { return physics::rotate(turn, direction); }
};

// A tyre around a hub with two spokes that protrude a little, so that rotation is visible. Its axle is x.
Body wheel_of(float radius, float half_width, float density) {
    Body body;
    const Part tyre{Cylinder{radius, half_width}, vec3(0), vec4(0, 0, -std::sqrt(0.5f), std::sqrt(0.5f)), density};
    const Part spoke{Box{vec3(half_width * 1.15f, radius * 0.72f, radius * 0.12f)}, vec3(0), vec4(0, 0, 0, 1), density};
    body.shape = Compound{{tyre, spoke}};
    return body;
}

struct Mount {
    vec3 place;  // wheel centre, vehicle axes, m
    JointKind kind;
    Wheel wheel;
};

void mount(Scene& scene, Vehicle& vehicle, const Stand& stand, Body body, const Mount& m, float speed) {
    body.position = stand.at(m.place);
    body.orientation = stand.turn;
    body.velocity = stand.along(vec3(0, 0, speed));
    body.angular_velocity = stand.along(vec3(speed / m.wheel.radius, 0, 0));
    scene.bodies.push_back(std::move(body));
    Wheel wheel = m.wheel;
    wheel.joint = scene.joints.size();
    scene.joints.push_back(
        joint_at(scene, m.kind, vehicle.chassis, scene.bodies.size() - 1, stand.at(m.place), stand.along(vec3(1, 0, 0))));
    scene.joints.back().name = scene.bodies.back().name;
    vehicle.wheels.push_back(wheel);
}

const char* const corners[] = {" front left", " front right", " rear left", " rear right"};

// All axes locked but the suspension spring, the axle and the steering axis.
SixDof suspension_of(float load, float mass, const Car& car, bool steers) {
    const Axis locked{.locked = true};
    const float omega = 2 * std::numbers::pi_v<float> * car.hertz;
    Spring spring{.stiffness = omega * omega * mass, .damping = 2 * car.damping_ratio * omega * mass};
    spring.rest = -load / spring.stiffness;  // so that the initial pose is in equilibrium
    SixDof six{.x = locked, .y = {}, .z = locked, .twist = {}, .swing_y = locked, .swing_z = locked};
    six.y.spring = spring;
    six.y.limits = Limits{-0.16f * car.size, 0.11f * car.size};
    if (steers) six.swing_y = Axis{.limits = Limits{0, 0}};
    return six;
}

}  // namespace

std::size_t add_car(Scene& scene, const Car& car) {
    const Stand stand(car.position, car.heading);
    const float s = car.size, radius = 0.33f * s, base = 1.3f * s, track = 0.76f * s;
    Vehicle vehicle{
        .name = car.name, .chassis = scene.bodies.size(), .wheels = {}, .engine = car.engine, .steering = car.steering};

    Body chassis;
    chassis.name = car.name;
    const vec4 straight(0, 0, 0, 1);
    chassis.shape = Compound{{Part{Box{vec3(0.62f, 0.17f, 1.95f) * s}, vec3(0, 0.52f, 0) * s, straight, 550 * car.density},
                              Part{Box{vec3(0.8f, 0.12f, 0.8f) * s}, vec3(0, 0.57f, 0) * s, straight, 200 * car.density},
                              Part{Box{vec3(0.58f, 0.22f, 0.95f) * s}, vec3(0, 0.91f, -0.2f) * s, straight, 80 * car.density}}};
    chassis.position = stand.at(vec3(0));
    chassis.orientation = stand.turn;
    chassis.velocity = stand.along(vec3(0, 0, car.speed));
    chassis.friction = 0.3f;
    const float mass = mass_properties(chassis).mass;
    scene.bodies.push_back(std::move(chassis));

    const float pull = glm::length(scene.gravity);
    for (int k = 0; k < 4; ++k) {
        const bool front = k < 2, left = k % 2 == 0;
        Body body = wheel_of(radius, 0.1f * s, 300 * car.density);
        body.name = car.name + corners[k];
        body.friction = car.friction;
        body.tyre = car.tyre;
        const float hold = mass * 0.25f * 9.81f * radius;  // N m: locks a wheel at friction 1
        Wheel wheel{.radius = radius,
                    .drive = front ? 0.0f : 1.0f,
                    .brake = car.brake * hold * (front ? 1.1f : 0.6f),
                    .hand_brake = front ? 0 : 2 * hold,
                    .steers = front};
        mount(scene, vehicle, stand, body,
              {vec3(left ? track : -track, radius, front ? base : -base),
               suspension_of(mass * pull * 0.25f, mass * 0.25f, car, front), wheel},
              car.speed);
    }
    scene.vehicles.push_back(std::move(vehicle));
    return scene.vehicles.size() - 1;
}

std::size_t add_cart(Scene& scene, const Cart& cart) {
    const Stand stand(cart.position, cart.heading);
    constexpr float radius = 0.3f, track = 0.72f, base = 0.4f;
    Vehicle vehicle{.name = cart.name, .chassis = scene.bodies.size(), .wheels = {}, .engine = cart.engine};
    Body box;
    box.name = cart.name;
    box.shape = Box{vec3(0.5f, 0.2f, 1)};
    box.position = stand.at(vec3(0, 0.45f, 0));
    box.orientation = stand.turn;
    box.density = 400;
    box.friction = 0.3f;
    scene.bodies.push_back(std::move(box));
    for (int k = 0; k < 4; ++k) {
        const bool left = k % 2 == 0;
        Body body = wheel_of(radius, 0.08f, 300);
        body.name = cart.name + corners[k];
        body.friction = cart.friction;
        body.tyre = cart.tyre;
        Wheel wheel{.radius = radius, .drive = 1, .brake = 300 * cart.brake, .hand_brake = 600, .skid = left ? -1.0f : 1.0f};
        mount(scene, vehicle, stand, body, {vec3(left ? track : -track, radius, k < 2 ? base : -base), Hinge{}, wheel}, 0);
    }
    scene.vehicles.push_back(std::move(vehicle));
    return scene.vehicles.size() - 1;
}

}  // namespace scree
