// Dry friction: sliding bodies against Coulomb's law.
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/suite/uniform_pressure.h"
#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

struct Slide {
    double distance, aside;  // m, downhill and across after the time
};
Slide slide_down(const Lab& lab, double slope, double friction, vec3 half, double yaw, double seconds) {
    const vec3 way = way_on_incline(lab, slope, friction, half, yaw, seconds);
    return {static_cast<double>(glm::dot(way, downhill(slope))), static_cast<double>(way.z)};
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
                   [](double s) { return earth_gravity * (portable::sin(s * degree) - 0.3 * portable::cos(s * degree)); },
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
         [](double) { return 2 * earth_gravity * (0.5 - 0.3 * portable::cos(30 * degree)); },
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
                       return std::abs(portable::atan2(slide.aside, slide.distance)) / degree;
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
                   [](double v) { return v * v / (2 * 0.4 * earth_gravity); },
                   [](const Lab& lab, double v) {
                       Scene scene;
                       scene.bodies.push_back(inclined_plane(0, 0.4f));
                       Body box;
                       box.shape = Box{{0.4f, 0.1f, 0.3f}};
                       box.position = {0, 0.1f, 0};
                       box.friction = 0.4f;
                       box.velocity = {static_cast<float>(v * portable::cos(0.5)), 0, static_cast<float>(v * portable::sin(0.5))};
                       scene.bodies.push_back(box);
                       World world = lab.world(scene);
                       world.step(lab.steps(v / (0.4 * earth_gravity) + 0.5));
                       const vec3 end = world.body(1).position;
                       return portable::hypot(static_cast<double>(end.x), static_cast<double>(end.z));
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
                   [](double spin) { return stop_of(disc(0.5), 0.3, 2, spin).distance; },
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
                   [](double spin) { return 0.99 * 3 * 0.5 * spin / (4 * 0.3 * earth_gravity); },
                   [](const Lab& lab, double spin) { return spin_time(lab, disc_on_plane(0.5, 0.3, 0, spin), spin); }});
    return all;
}

}  // namespace scree::demos
