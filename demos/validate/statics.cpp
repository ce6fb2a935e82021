// Statics: angles at which bodies slip and tip, and the compliance of columns.
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/statics.h"
#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

// Whether a box at rest on an incline has moved by a tenth of its half height after the time.
bool leaves(const Lab& lab, double slope, double friction, vec3 half, double yaw, double seconds) {
    return glm::length(way_on_incline(lab, slope, friction, half, yaw, seconds)) > 0.1f * half.y;
}

// The value above which `leaves` holds, to within `step`.
template <class Leaves>
double critical(double low, double high, double step, Leaves leaves) {
    while (high - low > step) {
        const double middle = (low + high) / 2;
        (leaves(middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

// What a column of boxes of `size` (m) loses of its height, m, scaled to 480 substeps a second.
double sag(const Lab& lab, int boxes, double pull = earth_gravity, float size = 0.5f) {
    Scene scene;
    scene.gravity = {0, static_cast<float>(-pull), 0};
    scene.bodies.push_back(inclined_plane(0, 0.6f));
    for (int i = 0; i < boxes; ++i) add_body(scene, Box{vec3(0.5f * size)}, {0, size * (0.5f + static_cast<float>(i)), 0});
    World world = lab.world(scene);
    world.step(lab.steps(10));
    const double substeps = static_cast<double>(lab.settings().rate) * lab.settings().substeps;
    return static_cast<double>(scene.bodies.back().position.y - world.bodies().back().position.y) *
           portable::pow(substeps / 480, 2);
}
constexpr double compliance = 7.23e-5 / earth_gravity;  // s^2

// Whether an arch of radius 5 m falls within 5 s.
bool falls(const Lab& lab, double thickness, int stones) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(0, 0.8f));
    const std::vector<std::size_t> arch = add_arch(scene, {5, static_cast<float>(thickness), stones}, vec3(0));
    World world = lab.world(scene);
    world.step(lab.steps(5));
    const std::size_t keystone = arch[arch.size() / 2];
    return !(world.body(keystone).position.y > 0.8f * scene.bodies[keystone].position.y);
}
// Whether a rope round a peg runs: whether its lighter weight rises by more than 1 cm in a second.
bool runs(const Lab& lab, double friction, double ratio) {
    Scene scene;
    scene.bodies.push_back(peg());
    const std::size_t weight = add_rope(scene, {static_cast<float>(friction), ratio, 0});
    World world = lab.world(scene);
    world.step(lab.steps(1));
    return world.body(weight).position.y > scene.bodies[weight].position.y + 0.01f;
}

}  // namespace

std::vector<Experiment> static_experiments() {
    return {
        {"slip",
         "a box on an incline begins to slip",
         "slope = atan(mu)",
         "Coulomb friction",
         "friction mu",
         "slope, degrees",
         0,
         0.2,
         {0.1, 0.2, 0.4, 0.6, 0.9},
         [](double mu) { return portable::atan(mu) / degree; },
         [](const Lab& lab, double mu) {
             return critical(0, 60, 0.05, [&](double s) { return leaves(lab, s * degree, mu, {0.5f, 0.2f, 0.5f}, 0.4, 4); });
         }},
        {"tip",
         "a box on an incline begins to tip",
         "slope = atan(width / height)",
         "statics",
         "width, of the height",
         "slope, degrees",
         0,
         0.3,
         {0.2, 0.4, 0.6, 0.8, 1},
         [](double w) { return portable::atan(w) / degree; },
         [](const Lab& lab, double w) {
             const vec3 half(0.5f * static_cast<float>(w), 0.5f, 0.4f);
             return critical(0, 60, 0.05, [&](double s) { return leaves(lab, s * degree, 4, half, 0, 6); });
         }},
        {"sag",
         "a column is compressed by its weight",
         "sag = C n^2 g h^2, substep h = 1/480 s",
         "compliance of soft contacts (Catto, GDC 2011), C measured once",
         "boxes n",
         "sag, m",
         0.1,
         0.0001,
         {2, 3, 4, 6},
         [](double n) { return compliance * earth_gravity * n * n; },
         [](const Lab& lab, double n) { return sag(lab, static_cast<int>(n)); }},
        {"sag-gravity",
         "a column of six under other gravity",
         "sag = C n^2 g h^2",
         "as sag",
         "gravity, m/s^2",
         "sag, m",
         0.1,
         0.0001,
         {0.981, 3.7, 24.8, 98.1},
         [](double g) { return compliance * g * 36; },
         [](const Lab& lab, double g) { return sag(lab, 6, g); }},
        {"sag-size",
         "a column of six boxes of any size",
         "sag = C n^2 g h^2",
         "as sag",
         "size, m",
         "sag, m",
         0.1,
         0.0001,
         {0.02, 0.1, 5, 50},
         [](double) { return compliance * earth_gravity * 36; },
         [](const Lab& lab, double size) { return sag(lab, 6, earth_gravity, static_cast<float>(size)); }},
        {"arch",
         "a semicircular arch begins to stand",
         "thickness = 0.1075 of the radius",
         "Milankovitch 1907; Heyman, The Stone Skeleton (1966)",
         "stones",
         "thickness, of the radius",
         0,
         0.012,
         {9, 15},
         [](double) { return 0.1075; },
         [](const Lab& lab, double stones) {
             return critical(-0.14, -0.08, 0.001, [&](double t) { return falls(lab, -t, static_cast<int>(stones)); }) * -1;
         }},
        {"capstan",
         "a rope round half a peg begins to run",
         "ratio = e^(mu pi)",
         "Euler and Eytelwein",
         "friction mu",
         "ratio of the pulls",
         0.15,
         0,
         {0.05, 0.1, 0.2},
         [](double mu) { return portable::exp(mu * pi); },
         [](const Lab& lab, double mu) { return critical(1, 3, 0.02, [&](double ratio) { return runs(lab, mu, ratio); }); }},
    };
}

}  // namespace scree::demos
