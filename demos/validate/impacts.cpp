// Impacts: bounces and collisions against Newton's law of restitution.
#include <algorithm>
#include <cmath>

#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

Body ball_at(vec3 position, vec3 velocity) {
    Body ball;
    ball.shape = Sphere{0.5f};
    ball.position = position;
    ball.velocity = velocity;
    ball.friction = 0;
    ball.restitution = 1;
    return ball;
}

// A ball flies at one at rest, `offset` of their diameter beside its centre, in empty space.
struct Collision {
    double energy;  // after, of that before
    double angle;   // of the struck ball's course to the line of flight, rad
};
Collision collide(const Lab& lab, double speed, double offset) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back(ball_at({0, 0, 0}, {0, 0, 0}));
    const float away = 1.5f + static_cast<float>(speed) / 50;
    scene.bodies.push_back(ball_at({-away, static_cast<float>(offset), 0}, {static_cast<float>(speed), 0, 0}));
    World world = lab.world(scene);
    const double before = world.statistics().kinetic_energy;
    world.step(lab.steps(2 * static_cast<double>(away) / speed + 0.2));
    const vec3 v = world.body(0).velocity;
    return {world.statistics().kinetic_energy / before, std::atan2(-static_cast<double>(v.y), static_cast<double>(v.x))};
}

// The height to which a body rises after its first bounce on a plane, of the height of its fall of 1 m.
double rise(const Lab& lab, Body body, double restitution, double half_height) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(0, 0.5f));
    body.restitution = static_cast<float>(restitution);
    body.position = {0, static_cast<float>(half_height + 1), 0};
    scene.bodies.push_back(body);
    World world = lab.world(scene);
    double top = 0, last = 1;
    bool risen = false;
    for (int i = 0; i < lab.steps(2); ++i) {
        world.step();
        const double height = static_cast<double>(world.body(1).position.y) - half_height;
        if (risen && height < last) break;
        risen = risen || height > last;
        if (risen) top = std::max(top, height);
        last = height;
    }
    return top;
}

}  // namespace

std::vector<Experiment> impact_experiments() {
    std::vector<Experiment> all;
    const auto bounces = [&](const char* name, const char* title, const Shape& shape, double half_height) {
        all.push_back({name,
                       title,
                       "height = e^2 of the fall",
                       "Newton's law of restitution",
                       "restitution e",
                       "height of 1 m, m",
                       0.01,
                       0.005,
                       {0.4, 0.6, 0.8, 0.9, 1},
                       [](double e) { return e * e; },
                       [shape, half_height](const Lab& lab, double e) {
                           Body body;
                           body.shape = shape;
                           return rise(lab, body, e, half_height);
                       }});
    };
    bounces("bounce-ball", "a ball bounces on a plane", Sphere{0.3f}, 0.3);
    bounces("bounce-box", "a box bounces flat on a plane", Box{{0.4f, 0.2f, 0.3f}}, 0.2);
    all.push_back({"billiard",
                   "a ball struck off centre leaves along the line of centres",
                   "angle = asin(b / 2R)",
                   "conservation of momentum; no friction",
                   "offset b of the diameter",
                   "angle, degrees",
                   0.01,
                   0.5,
                   {0, 0.2, 0.4, 0.6, 0.8},
                   [](double b) { return std::asin(b) / degree; },
                   [](const Lab& lab, double b) { return collide(lab, 5, b).angle / degree; }});
    all.push_back({"elastic",
                   "balls that collide off centre keep their energy",
                   "energy after = energy before",
                   "elastic collision, e = 1",
                   "speed, m/s",
                   "energy after, of before",
                   0,
                   0.001,
                   {2, 5, 10, 20, 50, 100, 150},
                   [](double) { return 1.0; },
                   [](const Lab& lab, double v) { return collide(lab, v, 0.5).energy; }});
    return all;
}

}  // namespace scree::demos
