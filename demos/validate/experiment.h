// Validation of the physics: experiments whose results are known in closed form or by an independent integration.
#pragma once

#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

// Where experiments run: a backend and settings.
class Lab {
public:
    Lab(std::function<std::unique_ptr<Runner>()> make_runner, Settings settings);
    World world(const Scene& scene) const;
    int steps(double seconds) const;  // at least 1
    const Settings& settings() const { return settings_; }

private:
    std::function<std::unique_ptr<Runner>()> make_runner_;
    Settings settings_;
};

// One quantity as a function of one parameter, measured and by theory.
struct Experiment {
    std::string name, title;
    std::string law;                    // the theory, as a formula
    std::string source;                 // where the theory is from
    std::string parameter, quantity;    // with units
    double relative = 0, absolute = 0;  // allowed error: of the theoretical value, and beyond that
    std::vector<double> parameters;
    std::function<double(double)> theory;
    std::function<double(const Lab&, double)> measure;
};

std::vector<Experiment> sliding_experiments();
std::vector<Experiment> rolling_experiments();
std::vector<Experiment> impact_experiments();
std::vector<Experiment> rotation_experiments();
std::vector<Experiment> static_experiments();
std::vector<Experiment> all_experiments();

struct Sample {
    double parameter = 0, theory = 0, measured = 0;
};
struct Validation {
    const Experiment* experiment = nullptr;
    std::vector<Sample> samples;

    double worst() const;  // greatest error, as a part of the allowed one; above 1 fails
    bool pass() const { return worst() <= 1; }
};

// Runs an experiment; stops early, with fewer samples, if `go_on` returns false.
Validation validate(const Experiment& experiment, const Lab& lab, const std::function<bool()>& go_on = {});

// A line per experiment, and with `samples` a line per sample.
std::string validation_table(const std::vector<Validation>& all, bool samples);
std::string validation_json(const std::vector<Validation>& all, const std::string& backend, const std::string& device);
// One HTML page with a plot (SVG) of each experiment.
std::string validation_page(const std::vector<Validation>& all, const std::string& heading);
// Laws, sources and allowed errors of experiments, as text and as a Markdown table, for demos/docs/evidence/experiments.md.
std::string experiments_of(const std::vector<Experiment>& experiments);
std::string experiments_as_markdown(const std::vector<Experiment>& experiments);

// ---- building blocks of experiments
using std::numbers::pi;
constexpr double degree = pi / 180;  // rad

// A fixed plane through the origin at `slope` (rad) to the horizontal: downhill is towards -x.
Body inclined_plane(double slope, float friction);
// Downhill direction of that plane, and its normal.
vec3 downhill(double slope);
vec3 uphill_normal(double slope);
// Displacement, m, of a box from rest on such a plane, turned by `yaw` (rad) about the normal, after the time (s).
vec3 way_on_incline(const Lab& lab, double slope, double friction, vec3 half_extents, double yaw, double seconds);

}  // namespace scree::demos
