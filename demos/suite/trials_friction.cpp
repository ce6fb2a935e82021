// Trials of friction: the direction of sliding, spin and slip together, and what rides on turntables.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "demos/suite/uniform_pressure.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

using std::numbers::pi;

// The greatest angle between a watched body's way and the direction down the slope, degrees.
Claim straight_down(Indices bodies, vec3 down, double limit) {
    return at_most("greatest angle between way and slope", limit, "degrees", "from start to end, the worst of all bodies",
                   [bodies, down](const Trace& trace) {
                       double most = 0;
                       for (const std::size_t body : bodies) {
                           const glm::dvec3 way =
                               glm::dvec3(trace.end.at(body).position) - glm::dvec3(trace.start.at(body).position);
                           const double along = glm::dot(way, glm::dvec3(down)), aside = std::abs(way.z);
                           const double angle = portable::atan2(aside, along) * 180 / pi;
                           if (!(angle <= most)) most = angle;
                       }
                       return most;
                   });
}

// When a watched body's spin falls below 0.05 rad/s for good, s.
double spun_until(const Trace& trace, std::size_t slot) {
    double time = 0;
    for (const Trace::Moment& moment : trace.moments)
        if (std::abs(moment.bodies.at(slot).angular_velocity.y) > 0.05f) time = moment.time;
    return time;
}
struct Spinning {
    std::size_t slot;
    double time;  // s, until it rests
};
Claim all_spin_to_rest(std::vector<Spinning> bodies, double percent) {
    return at_most("error of the time to rest of what spins", percent, "%", "spin below 0.05 rad/s, the worst of all bodies",
                   [bodies](const Trace& trace) {
                       double most = 0;
                       for (const Spinning& one : bodies) {
                           const double error = 100 * std::abs(spun_until(trace, one.slot) / one.time - 1);
                           if (!(error <= most)) most = error;
                       }
                       return most;
                   });
}

// A watched rider and the turntable under it.
struct Riding {
    std::size_t rider, table;  // watched slots
};
// Way of a rider in its table's frame from `from` (s) to the end, m.
Claim none_creeps(const std::string& what, std::vector<Riding> riders, double from, double limit) {
    return at_most(
        "creep of " + what, limit, "m", "way in the turntable's frame from 1 s to the end", [riders, from](const Trace& trace) {
            const auto place = [](const Trace::Moment& moment, const Riding& one) {
                const BodyState& table = moment.bodies.at(one.table);
                return physics::rotate_back(table.orientation, moment.bodies.at(one.rider).position - table.position);
            };
            const auto first = std::find_if(trace.moments.begin(), trace.moments.end(),
                                            [from](const Trace::Moment& moment) { return moment.time >= from - 1e-9; });
            if (first == trace.moments.end()) return no_number;
            double most = 0;
            for (const Riding& one : riders) {
                const double way = glm::length(glm::dvec3(place(trace.moments.back(), one) - place(*first, one)));
                if (!(way <= most)) most = way;
            }
            return most;
        });
}

// A kinematic table that turns as fast as gives bodies at `radius` this part of the friction they need.
struct Turning {
    std::size_t slot;  // watched
    vec3 centre;
    double spin, radius;  // rad/s, m
};
Turning add_turntable(Scene& scene, Indices& watched, bool round, vec3 centre, double friction, double part, double radius) {
    const double spin = std::sqrt(part * friction * earth_gravity / radius);
    Body table = fixed_box(centre, vec3(2, 0.1f, 2), static_cast<float>(friction));
    table.motion = Motion::kinematic;
    if (round) table.shape = Cylinder{2, 0.1f};
    table.angular_velocity.y = static_cast<float>(spin);
    watched.push_back(scene.bodies.size());
    scene.bodies.push_back(table);
    return {watched.size() - 1, centre, spin, radius};
}
// A box that turns with the table, `below` (m) above its top, on the side of +x or -x.
Riding add_rider(Scene& scene, Indices& watched, const Turning& table, float half, float below, float side, double friction) {
    Body box = box_at(table.centre + vec3(side * static_cast<float>(table.radius), 0.1f + half + below, 0),
                      vec3(half, half, 1.5f * half));
    box.velocity.z = -side * static_cast<float>(table.spin * table.radius);
    box.angular_velocity.y = static_cast<float>(table.spin);
    box.friction = static_cast<float>(friction);
    watched.push_back(scene.bodies.size());
    scene.bodies.push_back(box);
    return {watched.size() - 1, table.slot};
}

}  // namespace

// Boxes of several shapes, sizes and yaws on an incline: their way is straight down, whatever the yaw.
DemoScene yaw(const DemoOptions&) {
    const Incline incline{30 * degrees, 6, 1.1f};
    const double mu = 0.3;
    Scene scene;
    scene.bodies.push_back(ground());
    Indices bodies;
    std::vector<Accelerating> sliding;
    float z = -15;
    for (const vec3 half : {vec3(0.9f, 0.27f, 0.18f), vec3(0.1f, 0.05f, 0.3f), vec3(0.05f, 0.02f, 0.03f)}) {
        for (const float angle : {15 * degrees, 45 * degrees, 75 * degrees}) {
            const Body box = box_at({}, half, turned({0, 1, 0}, angle));
            sliding.push_back({bodies.size(), incline.down(), incline.along() - mu * incline.across()});
            bodies.push_back(add_lane(scene, incline, z, box, half.y, static_cast<float>(mu), 1.2f));
            z += 3.75f;
        }
    }
    const vec3 low(-6, 0, -17), high(6, 7, 17);
    Promise promise(straight_down(bodies, incline.down(), 0.0004), all_accelerate("boxes at any yaw", sliding, 0.3, 0.0008));
    return awake({std::move(scene), view_of(low, high, 55, 25), low, high, 2, std::move(promise).watching(bodies)});
}

// Discs and plates that slide and spin come to rest where, and when, uniform pressure says.
DemoScene spins(const DemoOptions&) {
    const double mu = 0.3;
    Scene scene;
    scene.bodies.push_back(ground(static_cast<float>(mu)));
    Indices watched;
    std::vector<Rolling> sliding;
    std::vector<Spinning> spinning;
    float z = -9;
    const auto add = [&](const Shape& shape, vec3 half, double v, double w) {
        Body body;
        body.shape = shape;
        body.position = {-2, half.y, z};
        body.velocity.x = static_cast<float>(v);
        body.angular_velocity.y = static_cast<float>(w);
        body.friction = static_cast<float>(mu);
        const bool round = std::holds_alternative<Cylinder>(shape);
        const glm::dvec3 size(half);
        const Stop stop = stop_of(round ? disc(size.x) : rectangle(size.x, size.z), mu, v, w);
        if (v > 0) sliding.push_back({scene.bodies.size(), stop.distance});
        spinning.push_back({watched.size(), stop.time});
        watched.push_back(scene.bodies.size());
        scene.bodies.push_back(body);
        z += 2;
    };
    for (const float radius : {0.1f, 0.5f}) {
        for (const double v : {0.0, 2.0, 4.0}) {
            const Cylinder disc{radius, 0.1f * radius};
            add(disc, vec3(radius, disc.half_height, radius), v, 5 / static_cast<double>(radius));
        }
    }
    const vec3 square(0.4f, 0.1f, 0.4f), plate(0.5f, 0.05f, 0.25f);
    add(Box{square}, square, 0, 10);
    add(Box{square}, square, 2, 10);
    add(Box{plate}, plate, 0, 10);
    add(Box{plate}, plate, 2, 10);
    const vec3 low(-2.5f, 0, -10), high(3, 0.5f, 10);
    Promise promise(all_roll_to_rest("discs and plates that spin", sliding, 4.5), all_spin_to_rest(spinning, 4));
    return awake({std::move(scene), view_of(low, high, 60, 35), low, high, 5, std::move(promise).watching(watched, 60)});
}

// Boxes, thin and thick, on discs and slabs that turn: at 0.9 of the friction they need, none creeps, nor stacks at 0.2.
DemoScene turntable(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    Indices watched;
    std::vector<Riding> riders, stacked;
    float x = -9;
    for (const double mu : {0.3, 0.8}) {
        for (const double radius : {0.5, 1.5}) {
            for (const bool round : {false, true}) {
                const Turning table = add_turntable(scene, watched, round, {x, 0.5f, round ? -3 : 3}, mu, 0.9, radius);
                for (const float half : {0.05f, 0.2f})
                    riders.push_back(add_rider(scene, watched, table, half, 0, half < 0.1f ? 1.0f : -1.0f, mu));
            }
            const Turning table = add_turntable(scene, watched, true, {x, 0.5f, 9}, mu, 0.06 / mu, radius);
            for (int k = 0; k < 5; ++k)
                stacked.push_back(add_rider(scene, watched, table, 0.1f, 0.2f * static_cast<float>(k), 1, mu));
            x += 6;
        }
    }
    const vec3 low(-11, 0, -5), high(11, 1.5f, 11);
    Promise promise(none_creeps("boxes at 0.9 of the limit", riders, 1, 0.000016),
                    none_creeps("stacks of five at a pull of 0.06 g", stacked, 1, 0.00013));
    return awake({std::move(scene), view_of(low, high, 30, 40), low, high, 20, std::move(promise).watching(watched)});
}

}  // namespace scree::demos
