// Statics: angles at which bodies slip and tip, and the compliance of columns.
#include <cmath>

#include "demos/validate/experiment.h"

namespace scree::demos {

namespace {

// A body at rest on an incline; whether it has moved by a tenth of its height after the time.
bool leaves(const Lab& lab, double slope, double friction, vec3 half, double yaw, double seconds) {
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
    return glm::length(world.body(1).position - box.position) > 0.1f * half.y;
}

// The slope above which it does, to 0.05 degrees.
template <class Leaves>
double critical(double low, double high, Leaves leaves) {
    while (high - low > 0.05) {
        const double middle = (low + high) / 2;
        (leaves(middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

// What a column of boxes loses of its height, m, scaled to 480 substeps a second.
double sag(const Lab& lab, int boxes) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(0, 0.6f));
    for (int i = 0; i < boxes; ++i) {
        Body box;
        box.shape = Box{vec3(0.25f)};
        box.position = {0, 0.25f + 0.5f * static_cast<float>(i), 0};
        scene.bodies.push_back(box);
    }
    World world = lab.world(scene);
    world.step(lab.steps(10));
    const double substeps = static_cast<double>(lab.settings().rate) * lab.settings().substeps;
    return static_cast<double>(scene.bodies.back().position.y - world.bodies().back().position.y) * std::pow(substeps / 480, 2);
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
         [](double mu) { return std::atan(mu) / degree; },
         [](const Lab& lab, double mu) {
             return critical(0, 60, [&](double s) { return leaves(lab, s * degree, mu, {0.5f, 0.2f, 0.5f}, 0.4, 4); });
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
         [](double w) { return std::atan(w) / degree; },
         [](const Lab& lab, double w) {
             const vec3 half(0.5f * static_cast<float>(w), 0.5f, 0.4f);
             return critical(0, 60, [&](double s) { return leaves(lab, s * degree, 4, half, 0, 6); });
         }},
        {"sag",
         "a column is compressed by its weight",
         "sag = C n^2 g h^2, substep h = 1/480 s (contact_momentum.h)",
         "compliance of soft contacts (Catto, GDC 2011), C measured once",
         "boxes n",
         "sag, m",
         0.1,
         0.0001,
         {2, 5, 10, 20},
         [](double n) { return 4.37e-5 * n * n; },
         [](const Lab& lab, double n) { return sag(lab, static_cast<int>(n)); }},
    };
}

}  // namespace scree::demos
