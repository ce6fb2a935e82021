// Impacts: bounces and collisions against Newton's law of restitution.
#include <algorithm>
#include <cmath>
#include <random>

#include "compute/scene/portable_math.h"

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
    return {world.statistics().kinetic_energy / before, portable::atan2(-static_cast<double>(v.y), static_cast<double>(v.x))};
}

vec3 any_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    vec3 v;
    do v = {normal(random), normal(random), normal(random)};
    while (glm::length(v) < 0.1f);
    return glm::normalize(v);
}

// Energy left, of the start's, of 90 pairs of boxes, capsules and discs that tumble with 60 rad/s and collide off centre, in
// empty space.
double collide_tumbling(const Lab& lab, double speed) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> part(0, 1);
    const std::vector<Shape> shapes = {Box{{0.5f, 0.3f, 0.2f}}, Capsule{0.25f, 0.5f}, Cylinder{0.4f, 0.05f}};
    Scene scene;
    scene.gravity = vec3(0);
    const auto v = static_cast<float>(speed);
    for (std::size_t pair = 0; pair < 90; ++pair) {
        const vec3 middle(0, 0, (10 + v) * static_cast<float>(pair)), along = any_direction(random);
        const vec3 across = glm::normalize(glm::cross(along, any_direction(random)));
        const vec3 aside = 0.25f * part(random) * across;
        const vec3 apart = aside + (1.25f + 0.025f * v * part(random)) * along;
        for (const float side : {1.0f, -1.0f}) {
            Body body = ball_at(middle + side * apart, -0.5f * side * v * along);
            body.shape = shapes[pair % 3];
            body.angular_velocity = 60.0f * any_direction(random);
            scene.bodies.push_back(body);
        }
    }
    World world = lab.world(scene);
    const double before = world.statistics().kinetic_energy;
    world.step(lab.steps(4 / speed + 0.3));
    return world.statistics().kinetic_energy / before;
}

// Energy left, of the start's, of 50 balls at rest, each of which two others strike at the same time, in empty space.
double meet(const Lab& lab, double speed) {
    std::mt19937 random(1);
    Scene scene;
    scene.gravity = vec3(0);
    const float away = static_cast<float>(speed) / 30;
    for (int i = 0; i < 50; ++i) {
        const vec3 place(0, 0, (8 + 4 * static_cast<float>(speed)) * static_cast<float>(i));
        const vec3 first = any_direction(random);
        vec3 second;
        do second = any_direction(random);
        while (glm::dot(first, second) > 0.45f);
        scene.bodies.push_back(ball_at(place, vec3(0)));
        for (const vec3 normal : {first, second}) {
            vec3 towards;
            do towards = any_direction(random);
            while (glm::dot(towards, normal) > -0.3f);
            scene.bodies.push_back(ball_at(place + normal - away * towards, static_cast<float>(speed) * towards));
        }
    }
    World world = lab.world(scene);
    const double before = world.statistics().kinetic_energy;
    world.step(lab.steps(0.25));
    return world.statistics().kinetic_energy / before;
}

// Energy left after 10 s, of the start's, of a gas of 125 balls of one speed in a box of ten diameters.
double gas_of(const Lab& lab, double speed, unsigned seed) {
    std::mt19937 random(seed);
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 125; ++i)
        scene.bodies.push_back(
            ball_at(1.9f * (vec3(i % 5, i / 5 % 5, i / 25) - vec3(2)), static_cast<float>(speed) * any_direction(random)));
    for (const float side : {-1.0f, 1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            Body wall = ball_at(vec3(0), vec3(0));
            vec3 half(9);
            half[axis] = 2;
            wall.shape = Box{half};
            wall.motion = Motion::fixed;
            wall.position[axis] = 7 * side;
            scene.bodies.push_back(wall);
        }
    World world = lab.world(scene);
    const double before = world.statistics().kinetic_energy;
    world.step(lab.steps(10));
    return world.statistics().kinetic_energy / before;
}
// The mean of four gases: a few collisions decide what one of them keeps, and which these are depends on the last bit.
double gas(const Lab& lab, double speed) {
    constexpr unsigned gases = 4;
    double sum = 0;
    for (unsigned seed = 1; seed <= gases; ++seed) sum += gas_of(lab, speed, seed);
    return sum / gases;
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

// The spin, of the speed by the radius, of a ball without spin that strikes a plane at a slant.
constexpr double slant_friction = 0.3, slant_restitution = 0.8;
double slant_theory(double degrees) {
    const double slant = degrees * pi / 180;
    return 2.5 * std::min(slant_friction * (1 + slant_restitution) * portable::sin(slant), 2.0 / 7 * portable::cos(slant));
}
double slant_spin(const Lab& lab, double degrees) {
    constexpr float speed = 10, radius = 0.25f;
    const auto slant = static_cast<float>(degrees * pi / 180);
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {{.name = "ground", .motion = Motion::fixed, .shape = Plane{}},
                    ball_at({0, radius + 0.1f, 0}, speed * vec3(portable::cos(slant), -portable::sin(slant), 0))};
    scene.bodies[1].shape = Sphere{radius};
    for (Body& body : scene.bodies) {
        body.friction = static_cast<float>(slant_friction);
        body.restitution = static_cast<float>(slant_restitution);
    }
    World world = lab.world(scene);
    for (int i = 0; i < lab.steps(1) && world.body(1).velocity.y < 0; ++i) world.step();
    return static_cast<double>(-world.body(1).angular_velocity.z * radius / speed);
}

// The speed along the blow with which two welded balls, the upper at an angle to it, leave a block, of that with which they
// came; in empty space. A rigid body of two mass points m with own inertia 2/5 m r^2 each.
constexpr double joined_restitution = 0.7;
double joined_theory(double degrees) {
    const double arm = 0.5 * portable::sin(degrees * pi / 180);  // r = 0.5 m
    const double inverse_mass = 0.5, inertia = 2 * (0.4 * 0.25 + 0.25);
    return -1 + (1 + joined_restitution) / (1 + arm * arm / (inertia * inverse_mass));
}
double joined_leaves(const Lab& lab, double degrees) {
    constexpr float speed = 4;
    Scene scene;
    scene.gravity = vec3(0);
    const auto slant = static_cast<float>(degrees * pi / 180);
    const vec3 axis(portable::sin(slant), portable::cos(slant), 0);
    scene.bodies = {ball_at({0, 0.9f, 0}, {0, -speed, 0}), ball_at(vec3(0, 0.9f, 0) + axis, {0, -speed, 0})};
    for (Body& body : scene.bodies) body.restitution = static_cast<float>(joined_restitution);
    Body block;
    block.motion = Motion::fixed;
    block.shape = Box{{0.2f, 0.5f, 0.2f}};
    block.position = {0, -0.5f, 0};
    block.friction = 0;
    scene.bodies.push_back(block);
    Joint weld;
    weld.kind = Fixed{};
    weld.a = 0;
    weld.b = 1;
    weld.anchor_a = 0.5f * axis;
    weld.anchor_b = -weld.anchor_a;
    scene.joints = {weld};
    World world = lab.world(scene);
    for (int i = 0; i < lab.steps(1) && world.body(0).velocity.y < -0.99f * speed; ++i) world.step();
    world.step();
    return 0.5 * static_cast<double>(world.body(0).velocity.y + world.body(1).velocity.y) / static_cast<double>(speed);
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
    all.push_back({"bounce-slant",
                   "a ball that strikes a plane at a slant takes spin",
                   "w R / v = 5/2 min(mu (1 + e) sin s, 2/7 cos s), mu = 0.3, e = 0.8",
                   "impulse of Coulomb friction on a rigid ball, up to rolling (Cross, Am. J. Phys. 70, 2002)",
                   "slant s, degrees",
                   "spin times radius, of the speed",
                   0.01,
                   0.002,
                   {10, 20, 30, 45, 60, 75, 85},
                   slant_theory,
                   slant_spin});
    all.push_back({"billiard",
                   "a ball struck off centre leaves along the line of centres",
                   "angle = asin(b / 2R)",
                   "conservation of momentum; no friction",
                   "offset b of the diameter",
                   "angle, degrees",
                   0.01,
                   0.5,
                   {0, 0.2, 0.4, 0.6, 0.8},
                   [](double b) { return portable::asin(b) / degree; },
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
    all.push_back({"elastic-solids",
                   "boxes, capsules and discs that tumble and collide off centre keep their energy",
                   "energy after = energy before",
                   "elastic collisions, e = 1; free motion",
                   "speed, m/s",
                   "energy after, of before",
                   0,
                   0.0005,
                   {2, 5, 10, 20, 50},
                   [](double) { return 1.0; },
                   collide_tumbling});
    all.push_back({"meeting",
                   "two balls that strike a third at the same time keep their energy",
                   "energy after = energy before",
                   "elastic collisions, e = 1",
                   "speed, m/s",
                   "energy after, of before",
                   0,
                   0.003,
                   {0.5, 1, 2, 5, 10},
                   [](double) { return 1.0; },
                   meet});
    all.push_back({"bounce-joined",
                   "two welded balls leave a block that the lower one strikes",
                   "u / v = (1 + e) / (1 + M x^2 / I) - 1, e = 0.7",
                   "impulse of a rigid body struck at the arm x",
                   "angle to the blow, degrees",
                   "speed of the centre of mass, of that before",
                   0,
                   0.0025,
                   {0, 5, 20, 40, 60, 80},
                   joined_theory,
                   joined_leaves});
    all.push_back({"gas",
                   "gases of balls keep their energy for 10 s, in the mean of four",
                   "energy after = energy before",
                   "elastic collisions, e = 1",
                   "speed, m/s",
                   "energy after, of before",
                   0,
                   0.03,
                   {1, 5, 10, 25, 50},
                   [](double) { return 1.0; },
                   gas});
    return all;
}

}  // namespace scree::demos
