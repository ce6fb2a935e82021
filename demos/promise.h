// Promises: what must be true after a demo has run, measured from how its bodies moved.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "compute/world.h"

namespace scree::demos {

// One line of a verdict.
struct Row {
    std::string what, promised, measured;
    bool pass = false;
};

// What is remembered of a run.
struct Trace {
    struct Moment {
        double time = 0;                // s
        std::vector<BodyState> bodies;  // the watched ones, in the promise's order
    };
    Scene scene;  // as checked; for a promise that reads shapes and materials
    std::vector<BodyState> start, end;
    Statistics statistics;  // at the end
    std::vector<Moment> moments;
    std::vector<double> energies;  // J, kinetic and potential, every half second, if the promise asks for them
};

using Claim = std::function<Row(const Trace&)>;
using Indices = std::vector<std::size_t>;

// At least one claim, so that no demo is without.
class Promise {
public:
    template <class... More>
    explicit Promise(Claim first, More... more) : claims_{std::move(first), Claim(std::move(more))...} {}

    void also(Claim claim) { claims_.push_back(std::move(claim)); }
    Promise&& watching(Indices bodies) && {
        watched_ = std::move(bodies);
        return std::move(*this);
    }
    Promise&& watching_energy() && {
        watches_energy_ = true;
        return std::move(*this);
    }
    const Indices& watched() const { return watched_; }
    bool watches_energy() const { return watches_energy_; }

    // Every claim, and what holds for any run: all bodies finite, none behind a plane.
    std::vector<Row> judge(const Trace& trace) const;

private:
    std::vector<Claim> claims_;
    Indices watched_;
    bool watches_energy_ = false;
};

// What holds for any run.
std::vector<Row> soundness(const Statistics& statistics);
bool all_pass(const std::vector<Row>& rows);

// Fills a trace while a world runs.
class Recorder {
public:
    Recorder(const World& world, const Promise& promise);
    void after_step(const World& world);
    Trace finish(const World& world);

private:
    const Promise& promise_;
    Trace trace_;
    std::uint64_t stride_, energy_stride_;  // steps
};

// ---- claims, each a measured value against its limit
// -----------------------------------------------------------------------------
Row below(std::string what, double measured, double limit, const char* unit);
Row within(std::string what, double measured, double expected, double tolerance, const char* unit);

Claim drift_below(double limit);        // m, of any dynamic body from its start
Claim end_speed_below(double limit);    // m/s, of any dynamic body at the end
Claim penetration_below(double limit);  // m, the deepest point at the end
Claim energy_never_rises(double part);  // by more than this part of the energy that the run has turned into heat
// No dynamic body left the box between these corners.
Claim all_within(vec3 low, vec3 high);
// The angle between a body's own axis and the vertical, degrees.
double tilt(const BodyState& body, vec3 axis);

}  // namespace scree::demos
