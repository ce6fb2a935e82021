// Oscillation and rotation: pendulum, spring, gyroscope, free top.
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/validate/experiment.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// Period from the zero crossings of a quantity with a linear interpolation in each step, s.
template <class Quantity>
double period_of(const Lab& lab, World& world, double about, Quantity quantity) {
    double last = quantity(world), first_crossing = -1;
    int crossings = 0;
    const int most = lab.steps(12 * about);
    for (int i = 0; i < most; ++i) {
        world.step();
        const double now = quantity(world);
        if (last < 0 && now >= 0) {
            const double time = world.time() - now / (now - last) / static_cast<double>(lab.settings().rate);
            if (first_crossing < 0)
                first_crossing = time;
            else if (++crossings == 5)
                return (time - first_crossing) / 5;
        }
        last = now;
    }
    return NAN;
}

double arithmetic_geometric_mean(double a, double b) {
    while (std::abs(a - b) > 1e-14 * a) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return a;
}

// A rod of 1 m hung at its end: m g d / I = 3 g / (2 L) with d = L / 2, I = m (L^2 + w^2) / 12 + m d^2.
constexpr double half_length = 0.5, half_width = 0.05;
double pendulum_period(double amplitude) {
    const double inertia = (half_length * half_length + half_width * half_width) / 3 + half_length * half_length;
    return 2 * pi * std::sqrt(inertia / (earth_gravity * half_length)) /
           arithmetic_geometric_mean(1, portable::cos(amplitude / 2));
}
double measured_pendulum(const Lab& lab, double amplitude) {
    Scene scene;
    Body rod;
    rod.shape = Box{{0.05f, 0.5f, 0.05f}};
    rod.orientation = turned({0, 0, 1}, static_cast<float>(amplitude));
    rod.position = {static_cast<float>(half_length * portable::sin(amplitude)),
                    static_cast<float>(-half_length * portable::cos(amplitude)), 0};
    scene.bodies.push_back(rod);
    scene.joints.push_back(joint_at(scene, Hinge{}, the_world, 0, vec3(0), {0, 0, 1}));
    World world = lab.world(scene);
    return period_of(lab, world, pendulum_period(amplitude),
                     [](const World& w) { return static_cast<double>(w.body(0).position.x); });
}

double measured_spring(const Lab& lab, double stiffness) {
    Scene scene;
    scene.gravity = vec3(0);
    Body box;
    box.shape = Box{vec3(0.5f)};  // 1000 kg
    box.position = {0.3f, 0, 0};
    scene.bodies.push_back(box);
    Slider slider;
    slider.slide.spring = Spring{static_cast<float>(stiffness), 0, 0};
    Joint joint = joint_at(scene, slider, the_world, 0, vec3(0), {1, 0, 0});
    joint.anchor_b = vec3(0);
    scene.joints.push_back(joint);
    World world = lab.world(scene);
    return period_of(lab, world, 2 * pi * std::sqrt(1000 / stiffness),
                     [](const World& w) { return static_cast<double>(w.body(0).position.x); });
}

// A disc (radius 0.3, half thickness 0.05) that spins about a level axle of 0.4 m, held at the axle's end.
constexpr double axle = 0.4;
double precession(double spin) {
    return earth_gravity * axle / (0.5 * 0.3 * 0.3 * spin);
}
double measured_precession(const Lab& lab, double spin) {
    Scene scene;
    Body disc;
    disc.shape = Cylinder{0.3f, 0.05f};
    disc.orientation = turned({0, 0, 1}, -90 * degrees);  // its axis, y, along x
    disc.position = {static_cast<float>(axle), 0, 0};
    const double turn = precession(spin);
    disc.angular_velocity = {static_cast<float>(spin), static_cast<float>(turn), 0};
    disc.velocity = glm::cross(disc.angular_velocity, disc.position);
    scene.bodies.push_back(disc);
    scene.joints.push_back(joint_at(scene, Ball{}, the_world, 0, vec3(0)));
    World world = lab.world(scene);
    const double seconds = 0.8 * pi / turn;  // less than half a turn
    world.step(lab.steps(seconds));
    const vec3 end = world.body(0).position;
    return portable::atan2(-static_cast<double>(end.z), static_cast<double>(end.x)) / world.time();
}

// A symmetric top in empty space: its axis precesses about the angular momentum at L / I1.
struct Top {
    double i1, i3, about_axis, across;  // kg m^2 of unit mass, rad/s
    double rate() const { return portable::hypot(i3 * about_axis, i1 * across) / i1; }
};
Top top_of(double across) {
    const double r = 0.5, h = 0.1;
    return {r * r / 4 + h * h / 3, r * r / 2, 4, across};
}
double measured_top(const Lab& lab, double across) {
    const Top top = top_of(across);
    Scene scene;
    scene.gravity = vec3(0);
    Body disc;
    disc.shape = Cylinder{0.5f, 0.1f};
    disc.angular_velocity = {static_cast<float>(across), static_cast<float>(top.about_axis), 0};
    scene.bodies.push_back(disc);
    World world = lab.world(scene);
    // The angle that the axis turns through about the angular momentum.
    const glm::dvec3 momentum = glm::normalize(glm::dvec3(top.i1 * across, top.i3 * top.about_axis, 0));
    const auto across_of = [&](const World& w) {
        const glm::dvec3 axis(physics::rotate(w.body(0).orientation, vec3(0, 1, 0)));
        return axis - momentum * glm::dot(axis, momentum);
    };
    const glm::dvec3 start = across_of(world);
    const double seconds = 0.8 * pi / top.rate();
    world.step(lab.steps(seconds));
    const glm::dvec3 end = across_of(world);
    const double angle = portable::atan2(glm::dot(momentum, glm::cross(start, end)), glm::dot(start, end));
    return angle / world.time();
}

// Energy left after 2 s, of the start's, of bodies of three shapes that spin about any axis in empty space: the greatest change.
double measured_tumbling(const Lab& lab, double spin) {
    double worst = 1;
    for (const Shape& shape : {Shape(Box{{0.5f, 0.3f, 0.2f}}), Shape(Capsule{0.25f, 0.5f}), Shape(Cylinder{0.4f, 0.05f})}) {
        for (int i = 0; i < 12; ++i) {
            const double rise = 1 - (2 * i + 1) / 12.0, turn = 2.4 * i, level = std::sqrt(1 - rise * rise);
            Scene scene;
            scene.gravity = vec3(0);
            Body body;
            body.shape = shape;
            body.angular_velocity = vec3(spin * glm::dvec3(level * portable::cos(turn), rise, level * portable::sin(turn)));
            scene.bodies.push_back(body);
            World world = lab.world(scene);
            const double before = world.statistics().kinetic_energy;
            world.step(lab.steps(2));
            const double left = world.statistics().kinetic_energy / before;
            if (std::abs(left - 1) > std::abs(worst - 1)) worst = left;
        }
    }
    return worst;
}

}  // namespace

std::vector<Experiment> rotation_experiments() {
    return {
        {"pendulum",
         "a rod swings about its end",
         "T = 2 pi sqrt(I / (m g d)) / agm(1, cos(A / 2))",
         "complete elliptic integral by Gauss's arithmetic-geometric mean",
         "amplitude A, degrees",
         "period, s",
         0.005,
         0,
         {5, 30, 60, 90, 120, 150},
         [](double a) { return pendulum_period(a * degree); },
         [](const Lab& lab, double a) { return measured_pendulum(lab, a * degree); }},
        {"spring",
         "a box swings on a spring",
         "T = 2 pi sqrt(m / k)",
         "Hooke",
         "stiffness k, N/m",
         "period of 1000 kg, s",
         0.005,
         0,
         {1e3, 1e4, 1e5, 4e5},
         [](double k) { return 2 * pi * std::sqrt(1000 / k); },
         measured_spring},
        {"gyroscope",
         "a spinning disc precesses about the end of its axle",
         "W = m g a / (I3 w)",
         "Euler's equations, level axle",
         "spin w, rad/s",
         "precession W, rad/s",
         0.01,
         0,
         {100, 150, 200, 300},
         precession,
         measured_precession},
        {"top",
         "a free disc wobbles",
         "W = L / I1",
         "Euler's equations, symmetric body",
         "spin across the axis, rad/s",
         "precession W, rad/s",
         0.01,
         0,
         {0.5, 1, 2, 4},
         [](double across) { return top_of(across).rate(); },
         measured_top},
        {"tumble",
         "free boxes, capsules and discs keep their energy however fast they spin",
         "energy after = energy before",
         "Euler's equations, no torque",
         "spin, rad/s",
         "energy after 2 s, of before",
         0,
         0.002,
         {5, 20, 60, 150, 300},
         [](double) { return 1.0; },
         measured_tumbling},
    };
}

}  // namespace scree::demos
