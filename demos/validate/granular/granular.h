// Validation of granular media: heaps, silos and flows against figures that were published, over several seeds.
//
// Grains are rigid, so lengths count in grain diameters and times in sqrt(d / g) alone: all cases have grains of 10 cm.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/grains.h"
#include "compute/world.h"
#include "demos/validate/plot.h"

namespace scree::demos {

// What a user may change of all cases; what is left out is each case's own.
struct GranularOptions {
    std::uint64_t seeds = 3;
    std::size_t bodies = 0;  // grains of a case's largest scene, about; 0: each its own
    std::optional<float> rate{};
    std::optional<int> substeps{};
};

struct Stopped {};  // thrown out of a case that is to stop

// Where cases run.
class GranularLab {
public:
    // `go_on` is asked before each step.
    GranularLab(std::function<std::unique_ptr<Runner>()> make_runner, GranularOptions options, std::function<bool()> go_on = {});

    World world(const Scene& scene, float rate, int substeps) const;  // without sleep
    // Steps, and calls `after_step` after each. Throws Stopped.
    void run(World& world, double seconds, const std::function<void()>& after_step = {}) const;
    // By which lengths grow so that the largest scene has as many grains as the user wants, in place of `usual`.
    double scale(std::size_t usual) const;
    const GranularOptions& options() const { return options_; }

private:
    std::function<std::unique_ptr<Runner>()> make_runner_;
    GranularOptions options_;
    std::function<bool()> go_on_;
};

// A published figure, and what is accepted of the mean over seeds.
struct GranularFigure {
    std::string quantity;   // with its unit
    std::string published;  // as the source has it
    double low = 0, high = 0;
};
// What one seed gave.
struct GranularMeasured {
    std::vector<double> figures;       // in the order of the case's
    std::vector<PlotSeries> points{};  // each seed has the same series
    std::vector<PlotSeries> theory{};  // lines that follow from what was measured
};
struct GranularCase {
    std::string name, title;
    std::string source;      // author, journal, volume, year; where in it
    std::string setup;       // grains, friction, sizes, rate, substeps
    std::size_t grains = 0;  // of the largest scene
    std::vector<GranularFigure> figures;
    PlotOf plot{};  // axes and published lines
    std::function<GranularMeasured(const GranularLab&, std::uint64_t seed)> measure;
};

std::vector<GranularCase> column_cases();
std::vector<GranularCase> discharge_cases();
std::vector<GranularCase> heap_cases();
std::vector<GranularCase> drum_cases();
std::vector<GranularCase> cut_cases();
std::vector<GranularCase> triaxial_cases();
std::vector<GranularCase> all_granular_cases();

struct GranularResult {
    const GranularCase* of = nullptr;
    std::vector<GranularMeasured> seeds;

    double mean(std::size_t figure) const;
    double spread(std::size_t figure) const;  // standard deviation over the seeds; 0 of one
    bool pass(std::size_t figure) const;
    bool pass() const;
    PlotOf plot() const;  // points are means over the seeds, with bars of their spread
};

// Runs a case with each seed; `done` is called after each. Throws Stopped.
GranularResult validate(const GranularCase& granular, const GranularLab& lab, const std::function<void()>& done = {});

// Figures and verdicts; what of the figures is published, with sources; setups. `as_markdown`: else aligned text.
std::string granular_table(const std::vector<GranularResult>& all, bool as_markdown);
std::string granular_seeds_table(const std::vector<GranularResult>& all);  // a line for each figure and seed
std::string granular_list(const std::vector<GranularCase>& cases, bool as_markdown);
std::string granular_json(const std::vector<GranularResult>& all, const std::string& backend, const std::string& device);
std::string granular_page(const std::vector<GranularResult>& all, const std::string& heading);

// ---- building blocks of cases
namespace granular {

constexpr double g = 9.81;  // m/s^2
constexpr float d = 0.1f;   // m, of a grain
constexpr double dd = 0.1;  // the same
constexpr float density = 2500;

// A fixed plane; its solid side is behind the normal.
Body wall(vec3 normal, float offset, float friction);
// Four walls about the axis, their distance from it.
void add_walls(Scene& scene, float half_x, float half_z, float friction);
// Grains of 0.9 to 1.1 d, uniform by mass, there at the start in the region.
Grains grains_of(std::size_t count, std::uint64_t seed, float friction, const GrainRegion& region);
// Adds them; returns their volume, m^3.
double add_grains(Scene& scene, const Grains& grains, const std::function<void(Body&)>& change = {});
// Pours grains into a shaft of these half widths, layer by layer, each dropped from 1.5 d above those before; returns their
// volume, m^3.
double pour(const GranularLab& lab, World& world, const Grains& grains, float half_x, float half_z);
double volume_of(const Scene& scene, std::size_t body);  // m^3

struct Line {
    double slope = 0, offset = 0;
};
Line fit(const std::vector<PlotPoint>& points);  // least squares
double mean_of(const std::vector<double>& values);

}  // namespace granular

}  // namespace scree::demos
