// Running experiments, and what they are built of.
#include "demos/validate/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

Lab::Lab(std::function<std::unique_ptr<Runner>()> make_runner, Settings settings)
    : make_runner_(std::move(make_runner)), settings_(settings) {
    settings_.sleeping = false;
}

World Lab::world(const Scene& scene) const {
    return World(scene, settings_, make_runner_());
}

int Lab::steps(double seconds) const {
    return std::max(1, static_cast<int>(std::lround(seconds * static_cast<double>(settings_.rate))));
}

double Validation::worst() const {
    double worst = samples.empty() ? INFINITY : 0;
    for (const Sample& sample : samples) {
        const double allowed = experiment->relative * std::abs(sample.theory) + experiment->absolute;
        const double error = std::abs(sample.measured - sample.theory) / allowed;
        if (!std::isfinite(error)) return INFINITY;
        worst = std::max(worst, error);
    }
    return worst;
}

Validation validate(const Experiment& experiment, const Lab& lab, const std::function<bool()>& go_on) {
    Validation made{&experiment, {}};
    for (const double parameter : experiment.parameters) {
        if (go_on && !go_on()) break;
        made.samples.push_back({parameter, experiment.theory(parameter), experiment.measure(lab, parameter)});
    }
    return made;
}

std::vector<Experiment> all_experiments() {
    std::vector<Experiment> all;
    for (auto* group : {sliding_experiments, rolling_experiments, impact_experiments, rotation_experiments, static_experiments}) {
        std::vector<Experiment> some = group();
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
}

vec3 uphill_normal(double slope) {
    return {static_cast<float>(-portable::sin(slope)), static_cast<float>(portable::cos(slope)), 0};
}

vec3 downhill(double slope) {
    return {static_cast<float>(-portable::cos(slope)), static_cast<float>(-portable::sin(slope)), 0};
}

Body inclined_plane(double slope, float friction) {
    Body body;
    body.name = "incline";
    body.motion = Motion::fixed;
    body.shape = Plane{uphill_normal(slope), 0};
    body.friction = friction;
    return body;
}

vec3 way_on_incline(const Lab& lab, double slope, double friction, vec3 half_extents, double yaw, double seconds) {
    Scene scene;
    scene.bodies.push_back(inclined_plane(slope, static_cast<float>(friction)));
    const vec4 orientation =
        physics::compose(turned({0, 0, 1}, static_cast<float>(slope)), turned({0, 1, 0}, static_cast<float>(yaw)));
    Body box = box_at(uphill_normal(slope) * half_extents.y, half_extents, orientation);
    box.friction = static_cast<float>(friction);
    scene.bodies.push_back(box);
    World world = lab.world(scene);
    world.step(lab.steps(seconds));
    return world.body(1).position - box.position;
}

}  // namespace scree::demos
