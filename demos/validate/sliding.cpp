// Dry friction: sliding bodies against Coulomb's law.
#include <cmath>

#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

// A body at rest on an incline of friction 1, so that the pair's friction is sqrt(body's).
struct Slide {
    double distance, aside;  // m, downhill and across after the time
};
Slide slide_down(const Lab& lab, double slope, double friction, vec3 half, double yaw, double seconds) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(slope, static_cast<float>(friction)));
    Body box;
    box.shape = Box{half};
    box.friction = static_cast<float>(friction);
    box.orientation = product(rotation({0, 0, 1}, slope), rotation({0, 1, 0}, yaw));
    box.position = uphill_normal(slope) * half.y;
    scene.bodies.push_back(box);
    World world = lab.world(scene);
    world.step(lab.steps(seconds));
    const vec3 way = world.body(1).position - box.position;
    return {static_cast<double>(glm::dot(way, downhill(slope))), static_cast<double>(way.z)};
}

// A disc that slides and spins on a plane under uniform pressure: distance slid, by integrating Coulomb friction over
// the disc (Farkas, Bartels, Unger, Wolf, Phys. Rev. Lett. 90, 248302, 2003).
double disc_distance(double radius, double friction, double speed, double spin) {
    const auto [cells, turns] = std::pair{24, 48};
    double distance = 0;
    const double dt = 1e-3;
    while (speed > 1e-4 || spin > 1e-3) {
        double force = 0, torque = 0;  // of a unit weight
        for (int i = 0; i < cells; ++i) {
            const double r = radius * std::sqrt((i + 0.5) / cells);
            for (int j = 0; j < turns; ++j) {
                const double angle = 2 * pi * (j + 0.5) / turns;
                const double vx = speed - spin * r * std::sin(angle), vy = spin * r * std::cos(angle);
                const double v = std::hypot(vx, vy) + 1e-12;
                force += vx / v / (cells * turns);
                torque += r * (std::cos(angle) * vy - std::sin(angle) * vx) / v / (cells * turns);
            }
        }
        const double a = friction * gravity * force * dt, b = friction * gravity * torque / (0.5 * radius * radius) * dt;
        distance += (speed - a / 2) * dt;
        speed = std::max(0.0, speed - a);
        spin = std::max(0.0, spin - b);
    }
    return distance;
}

// A flat cylinder on a plane, standing on its face.
Scene disc_on_plane(double radius, double friction, double speed, double spin) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(0, static_cast<float>(friction)));
    Body disc;
    disc.shape = Cylinder{static_cast<float>(radius), 0.05f};
    disc.position = {0, 0.05f, 0};
    disc.friction = static_cast<float>(friction);
    disc.velocity = {static_cast<float>(speed), 0, 0};
    disc.angular_velocity = {0, static_cast<float>(spin), 0};
    scene.bodies.push_back(disc);
    return scene;
}

// Time until the spin has fallen to a hundredth, s.
double spin_time(const Lab& lab, const Scene& scene, double spin) {
    World world = lab.world(scene);
    const int most = lab.steps(20);
    for (int i = 0; i < most; ++i) {
        if (std::abs(static_cast<double>(world.body(1).angular_velocity.y)) < 0.01 * spin) break;
        world.step();
    }
    return world.time();
}

}  // namespace

std::vector<Experiment> sliding_experiments() {
    const vec3 plank(1, 0.3f, 0.2f);
    std::vector<Experiment> all;
    all.push_back({"slide",
                   "a box slides down an incline",
                   "a = g (sin s - mu cos s)",
                   "Coulomb friction",
                   "slope s, degrees",
                   "acceleration, m/s^2",
                   0.005,
                   0.01,
                   {20, 25, 30, 40, 50, 60},
                   [](double s) { return gravity * (std::sin(s * degree) - 0.3 * std::cos(s * degree)); },
                   [plank](const Lab& lab, double s) { return 2 * slide_down(lab, s * degree, 0.3, plank, 0, 1).distance; }});
    all.push_back(
        {"slide-yaw",
         "a plank turned on the incline slides as far",
         "s = (sin 30 - mu cos 30) g t^2 / 2",
         "Coulomb friction",
         "yaw, degrees",
         "way in 2 s, m",
         0.005,
         0,
         {0, 15, 30, 45, 60, 75, 90},
         [](double) { return 2 * gravity * (0.5 - 0.3 * std::cos(30 * degree)); },
         [plank](const Lab& lab, double yaw) { return slide_down(lab, 30 * degree, 0.3, plank, yaw * degree, 2).distance; }});
    all.push_back({"slide-course",
                   "a plank turned on the incline slides straight down",
                   "friction is opposite to the slip",
                   "Coulomb friction",
                   "yaw, degrees",
                   "off course, degrees",
                   0,
                   0.5,
                   {0, 15, 30, 45, 60, 75, 90},
                   [](double) { return 0.0; },
                   [plank](const Lab& lab, double yaw) {
                       const Slide slide = slide_down(lab, 30 * degree, 0.3, plank, yaw * degree, 2);
                       return std::abs(std::atan2(slide.aside, slide.distance)) / degree;
                   }});
    all.push_back({"stop",
                   "a box slides to rest on a plane",
                   "s = v^2 / (2 mu g)",
                   "Coulomb friction",
                   "speed v, m/s",
                   "way, m",
                   0.01,
                   0.002,
                   {1, 2, 4, 8, 16},
                   [](double v) { return v * v / (2 * 0.4 * gravity); },
                   [](const Lab& lab, double v) {
                       Scene scene;
                       scene.bodies.push_back(inclined_plane(0, 0.4f));
                       Body box;
                       box.shape = Box{{0.4f, 0.1f, 0.3f}};
                       box.position = {0, 0.1f, 0};
                       box.friction = 0.4f;
                       box.velocity = {static_cast<float>(v * std::cos(0.5)), 0, static_cast<float>(v * std::sin(0.5))};
                       scene.bodies.push_back(box);
                       World world = lab.world(scene);
                       world.step(lab.steps(v / (0.4 * gravity) + 0.5));
                       const vec3 end = world.body(1).position;
                       return std::hypot(static_cast<double>(end.x), static_cast<double>(end.z));
                   }});
    all.push_back({"disc",
                   "a disc slides and spins to rest",
                   "Coulomb friction integrated over a disc of uniform pressure",
                   "Farkas et al., Phys. Rev. Lett. 90, 248302 (2003)",
                   "spin, rad/s",
                   "way at 2 m/s, m",
                   0.06,
                   0,
                   {0, 2, 5, 10, 20, 40},
                   [](double spin) { return disc_distance(0.5, 0.3, 2, spin); },
                   [](const Lab& lab, double spin) {
                       World world = lab.world(disc_on_plane(0.5, 0.3, 2, spin));
                       world.step(lab.steps(8));
                       return static_cast<double>(world.body(1).position.x);
                   }});
    all.push_back({"spin",
                   "a disc spins to rest",
                   "t = 3 R w / (4 mu g)",
                   "uniform pressure: torque 2/3 mu m g R",
                   "spin w, rad/s",
                   "time, s",
                   0.02,
                   0.02,
                   {5, 10, 20, 40},
                   [](double spin) { return 0.99 * 3 * 0.5 * spin / (4 * 0.3 * gravity); },
                   [](const Lab& lab, double spin) { return spin_time(lab, disc_on_plane(0.5, 0.3, 0, spin), spin); }});
    return all;
}

}  // namespace scree::demos
