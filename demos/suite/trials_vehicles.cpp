// Trial of vehicles: braking, acceleration, cornering and parking against closed forms.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/driving.h"
#include "demos/scenes/scene_builder.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr double g = 9.81;
constexpr float wheel_radius = 0.33f, fast = 20;  // m, m/s

// Mass and effective mass (with the wheels' inertia) of a car by add_car, kg.
struct Weight {
    double mass = 0, moving = 0;
};
Weight weight_of(const Scene& scene, const Vehicle& vehicle) {
    const auto of = [&](std::size_t body) { return mass_properties(scene.bodies[body].shape, scene.bodies[body].density); };
    Weight weight;
    weight.mass = static_cast<double>(of(vehicle.chassis).mass);
    for (const Wheel& wheel : vehicle.wheels) {
        const MassProperties properties = of(scene.joints[wheel.joint].b);
        weight.mass += static_cast<double>(properties.mass);
        // The axle is the axis of the largest inertia.
        weight.moving += static_cast<double>(std::max({properties.inertia.x, properties.inertia.y, properties.inertia.z}) /
                                             (wheel.radius * wheel.radius));
    }
    weight.moving += weight.mass;
    return weight;
}

double way_of(const Trace& trace, std::size_t body) {
    return static_cast<double>(glm::distance(trace.start[body].position, trace.end[body].position));
}
Claim brakes(const std::string& how, std::size_t body, double deceleration) {
    return close_to("braking distance, " + how, 20.0 * 20.0 / (2 * deceleration), 0.03 * 20.0 * 20.0 / (2 * deceleration), "m",
                    "from 20 m/s to rest: v^2 / (2 a)", [body](const Trace& trace) { return way_of(trace, body); });
}

double speed_of(const BodyState& body) {
    return static_cast<double>(glm::length(body.velocity));
}
// Time at which the watched body `slot` first reached `speed`, s.
double time_to(const Trace& trace, std::size_t slot, double speed) {
    for (const Trace::Moment& moment : trace.moments)
        if (speed_of(moment.bodies[slot]) >= speed) return moment.time;
    return no_number;
}
// Largest lateral acceleration, averaged over half a second, m/s^2.
double greatest_lateral(const Trace& trace, std::size_t slot) {
    double greatest = 0;
    constexpr std::size_t span = 15;
    for (std::size_t i = 60; i + span < trace.moments.size(); ++i) {
        const BodyState &before = trace.moments[i].bodies[slot], &after = trace.moments[i + span].bodies[slot];
        const glm::dvec3 v(before.velocity), w(after.velocity);
        const double turn = portable::atan2(glm::length(glm::cross(v, w)), glm::dot(v, w));
        const double seconds = trace.moments[i + span].time - trace.moments[i].time;
        greatest = std::max(greatest, turn / seconds * 0.5 * (glm::length(v) + glm::length(w)));
    }
    return greatest;
}

// The trial under construction, with the bodies that it watches.
struct Roadtest {
    Scene scene;
    std::vector<Claim> claims;
    Indices all, watched;

    std::size_t chassis(std::size_t vehicle) {
        all.push_back(scene.vehicles[vehicle].chassis);
        return all.back();
    }
    std::size_t slot(std::size_t vehicle) {
        watched.push_back(chassis(vehicle));
        return watched.size() - 1;
    }
};

// A car with locked, sliding wheels, and one braking just below that.
void add_braking(Roadtest& test) {
    Scene& scene = test.scene;
    const std::size_t locked = add_car(scene, {.position = {-18, 0, 0}, .speed = fast, .brake = 10});
    const std::size_t rolling = add_car(scene, {.position = {-12, 0, 0}, .speed = fast, .brake = 0.75f});
    for (const std::size_t vehicle : {locked, rolling}) scene.vehicles[vehicle].controls.brake = 1;
    double torque = 0;
    for (const Wheel& wheel : scene.vehicles[rolling].wheels) torque += static_cast<double>(wheel.brake);
    const double gentle = torque / static_cast<double>(wheel_radius) / weight_of(scene, scene.vehicles[rolling]).moving;
    test.claims.push_back(brakes("wheels locked", test.chassis(locked), 0.75 * g));
    test.claims.push_back(brakes("wheels rolling", test.chassis(rolling), gentle));
}

void add_start(Roadtest& test) {
    const std::size_t vehicle = add_car(test.scene, {.position = {-6, 0, 0}, .engine = {.top_speed = 25}});
    Vehicle& car = test.scene.vehicles[vehicle];
    car.controls.throttle = 1;
    const double moving = weight_of(test.scene, car).moving, power = static_cast<double>(car.engine.power);
    const double force = static_cast<double>(car.engine.torque / wheel_radius), knee = power / force;
    const double seconds = moving * (knee / force + (20.0 * 20.0 - knee * knee) / (2 * power));
    const std::size_t slot = test.slot(vehicle), body = test.all.back();
    test.claims.push_back(close_to("time from 0 to 20 m/s", seconds, 0.05 * seconds, "s",
                                   "full torque up to the speed P / F, then full power",
                                   [slot](const Trace& trace) { return time_to(trace, slot, 20); }));
    test.claims.push_back(close_to("top speed", 25, 0.5, "m/s", "at the end, at full throttle",
                                   [body](const Trace& trace) { return speed_of(trace.end[body]); }));
}

// A car in a slow curve, and one at the limit of its tyres.
void add_curves(Roadtest& test) {
    Scene& scene = test.scene;
    const std::size_t slow = add_car(scene, {.position = {15, 0, 0}, .speed = 5, .engine = {.drag = 0}});
    scene.vehicles[slow].controls.steer = 0.5f;
    const double tightest = portable::tan(static_cast<double>(scene.vehicles[slow].steering.angle)) / 2.6;
    const double radius = portable::hypot(1 / (0.5 * tightest), 1.3);  // circle of the car's centre
    const std::size_t sliding = add_car(
        scene, {.position = {60, 0, 0}, .speed = 15, .engine = {.torque = 600}, .steering = {.angle = 0.2f, .lateral = 1000}});
    scene.vehicles[sliding].controls = {.throttle = 1, .steer = 1};
    const std::size_t slow_slot = test.slot(slow), sliding_slot = test.slot(sliding);
    test.claims.push_back(close_to("radius of a slow curve", radius, 0.05 * radius, "m",
                                   "speed / rate of turning after 3 s; wheelbase / tan(angle)", [slow_slot](const Trace& trace) {
                                       for (const Trace::Moment& moment : trace.moments) {
                                           const BodyState& body = moment.bodies[slow_slot];
                                           if (moment.time >= 3)
                                               return speed_of(body) / static_cast<double>(std::abs(body.angular_velocity.y));
                                       }
                                       return no_number;
                                   }));
    test.claims.push_back(between("greatest acceleration in a curve", 0.75 * g, 1.03 * g, "m/s^2",
                                  "across the way, mean over half a second, wheels turned too far: v^2 / r <= mu g",
                                  [sliding_slot](const Trace& trace) { return greatest_lateral(trace, sliding_slot); }));
}

void add_parked(Roadtest& test) {
    constexpr float slope = 12 * degrees;
    const vec3 foot(-40, 0, 0);
    const vec4 tilt = turned({1, 0, 0}, -slope);
    test.scene.bodies.push_back(fixed_box(foot + physics::rotate(tilt, vec3(0, -0.5f, 5)), {3, 0.5f, 8}, 1, tilt));
    const std::size_t parked = add_car(test.scene, {.position = foot + vec3(0, 0, 5)});
    turn_vehicle(test.scene, parked, foot, tilt);
    test.scene.vehicles[parked].controls.hand_brake = 1;
    const std::size_t slot = test.slot(parked);
    test.claims.push_back(at_most(
        "drift of a car parked on a slope of 12 degrees", 0.00006, "m", "from 1 s to the end, 21 s", [slot](const Trace& trace) {
            for (const Trace::Moment& moment : trace.moments)
                if (moment.time >= 1)
                    return static_cast<double>(
                        glm::distance(moment.bodies[slot].position, trace.moments.back().bodies[slot].position));
            return no_number;
        }));
}

void add_plain(Roadtest& test) {
    const std::size_t tank = add_cart(test.scene, {.position = {-60, 0, 0}});
    test.scene.vehicles[tank].controls = {.throttle = 0.5f, .steer = 0.5f};
    const std::size_t slot = test.slot(tank);
    test.claims.push_back(
        at_least("turns of the plain cart", 6, "", "sum of its turning to the left", [slot](const Trace& trace) {
            double sum = 0;
            for (std::size_t i = 1; i < trace.moments.size(); ++i)
                sum += static_cast<double>(trace.moments[i].bodies[slot].angular_velocity.y) *
                       (trace.moments[i].time - trace.moments[i - 1].time);
            return sum / 6.2831853;
        }));
}

}  // namespace

DemoScene roadtest(const DemoOptions&) {
    Roadtest test;
    test.scene.bodies.push_back(ground(1));
    add_braking(test);
    add_start(test);
    add_curves(test);
    add_parked(test);
    add_plain(test);
    Promise promise(all_upright("all of them", test.all));
    for (const Claim& claim : test.claims) promise.also(claim);
    const vec3 low(-64, 0, -10), high(80, 3, 40);
    return awake(
        {std::move(test.scene), view_of(low, high, 20, 30), low, high, 22, std::move(promise).watching(test.watched, 30)});
}

}  // namespace scree::demos
