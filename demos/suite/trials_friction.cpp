// Trials of friction: the direction of sliding, spin and slip together, and what rides on turntables.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "demos/scenes/demos.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
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
                           const double angle = std::atan2(aside, along) * 180 / pi;
                           if (!(angle <= most)) most = angle;
                       }
                       return most;
                   });
}

// A flat body under uniform pressure: points of equal area, and the moment of inertia per mass about the normal, m^2.
struct Pressed {
    std::vector<glm::dvec2> points;
    double inertia = 0;
};
Pressed pressed(double half_x, double half_z, bool round) {
    Pressed face;
    const int across = 24;
    for (int i = 0; i < across; ++i) {
        for (int k = 0; k < across; ++k) {
            const glm::dvec2 at((2 * i + 1.0) / across - 1, (2 * k + 1.0) / across - 1);
            if (!round || glm::dot(at, at) < 1) face.points.emplace_back(at.x * half_x, at.y * half_z);
        }
    }
    face.inertia = round ? half_x * half_x / 2 : (half_x * half_x + half_z * half_z) / 3;
    return face;
}
// Way and time until slip (from v, m/s) and spin (from w, rad/s) have ended: every point of the face rubs against its
// own slip (Farkas, Bartels, Unger, Wolf, Frictional Coupling between Sliding and Spinning Motion, PRL 90, 2003).
struct Stop {
    double way = 0, time = 0;
};
Stop stop_of(const Pressed& face, double mu, double v, double w) {
    const double step = 2e-3;
    Stop stop;
    double turn = 0;
    for (; v > 1e-3 || w > 2e-3; stop.time += step) {
        double force = 0, moment = 0;
        for (const glm::dvec2 point : face.points) {
            const double x = std::cos(turn) * point.x - std::sin(turn) * point.y;
            const double z = std::sin(turn) * point.x + std::cos(turn) * point.y;
            const double along = v - w * z, aside = w * x, speed = std::hypot(along, aside) + 1e-6;
            force += along / speed;
            moment += (x * aside - z * along) / speed;
        }
        const double rate = step * mu * earth_gravity / static_cast<double>(face.points.size());
        v -= std::min(v, rate * force);
        w -= std::min(w, rate * moment / face.inertia);
        turn += w * step;
        stop.way += v * step;
    }
    return stop;
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
Claim none_creeps(std::vector<Riding> riders, double from, double limit) {
    return at_most("creep of boxes at 0.9 of the limit", limit, "m", "way in the turntable's frame from 1 s to the end",
                   [riders, from](const Trace& trace) {
                       const auto place = [](const Trace::Moment& moment, const Riding& one) {
                           const BodyState& table = moment.bodies.at(one.table);
                           return physics::rotate_back(table.orientation, moment.bodies.at(one.rider).position - table.position);
                       };
                       const auto first =
                           std::find_if(trace.moments.begin(), trace.moments.end(),
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
    Promise promise(straight_down(bodies, incline.down(), 0.01), all_accelerate("boxes at any yaw", sliding, 0.3, 0.01));
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
        const Stop stop = stop_of(pressed(static_cast<double>(half.x), static_cast<double>(half.z), round), mu, v, w);
        if (v > 0) sliding.push_back({scene.bodies.size(), stop.way});
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
    Promise promise(all_roll_to_rest("discs and plates that spin", sliding, 5), all_spin_to_rest(spinning, 4));
    return awake({std::move(scene), view_of(low, high, 60, 35), low, high, 5, std::move(promise).watching(watched, 60)});
}

// Boxes, thin and thick, on discs and slabs that turn: at 0.9 of the friction they need, none creeps.
DemoScene turntable(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    Indices watched;
    std::vector<Riding> riders;
    float x = -9;
    for (const double mu : {0.3, 0.8}) {
        for (const double radius : {0.5, 1.5}) {
            const double spin = std::sqrt(0.9 * mu * earth_gravity / radius);
            for (const bool round : {false, true}) {
                Body table = fixed_box({x, 0.5f, 0}, vec3(2, 0.1f, 2), static_cast<float>(mu));
                table.motion = Motion::kinematic;
                if (round) table.shape = Cylinder{2, 0.1f};
                table.position.z = round ? -3 : 3;
                table.angular_velocity.y = static_cast<float>(spin);
                const std::size_t slot = watched.size();
                watched.push_back(scene.bodies.size());
                scene.bodies.push_back(table);
                for (const float half : {0.05f, 0.2f}) {
                    const float side = half < 0.1f ? 1.0f : -1.0f;
                    Body box = box_at(table.position + vec3(side * static_cast<float>(radius), 0.1f + half, 0),
                                      vec3(half, half, 1.5f * half));
                    box.velocity.z = -side * static_cast<float>(spin * radius);
                    box.angular_velocity = table.angular_velocity;
                    box.friction = static_cast<float>(mu);
                    riders.push_back({watched.size(), slot});
                    watched.push_back(scene.bodies.size());
                    scene.bodies.push_back(box);
                }
            }
            x += 6;
        }
    }
    const vec3 low(-11, 0, -5), high(11, 1.5f, 5);
    Promise promise(none_creeps(riders, 1, 0.001));
    return awake({std::move(scene), view_of(low, high, 30, 40), low, high, 20, std::move(promise).watching(watched)});
}

}  // namespace scree::demos
