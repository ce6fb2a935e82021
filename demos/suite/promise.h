// Promises: limits that a demo's run must meet, measured from a trace of its bodies.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "compute/world.h"

namespace scree::demos {

// The value of a measurement without data; it fails every claim.
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// The trace of a run: only what the promise has asked for.
struct Trace {
    struct Moment {
        double time = 0;                // s
        std::vector<BodyState> bodies;  // the watched bodies, in the promise's order; all bodies in a snapshot
    };
    struct Sample {
        double time = 0;  // s
        Statistics statistics;
    };
    Scene scene;       // the validated scene, for claims about shapes and materials
    double rate = 60;  // steps per second
    std::vector<BodyState> start, end;
    Statistics statistics;            // at the end
    std::vector<Moment> moments;      // states of the watched bodies
    std::vector<Moment> snapshots;    // states of all bodies, one per time in keeping()
    std::vector<Sample> samples;      // statistics of the world over time
    std::vector<Sample> ending;       // statistics after every step of the last seconds that a claim asks for
    std::vector<Moment> last_second;  // states of all bodies, ten times in the last second, if a claim asks for them
    std::vector<float> step_seconds;  // wall clock time of each step
};

// The verdict on one claim.
struct Row {
    std::string what, promised, measured;
    bool pass = false;
    double value = 0;  // measured, in `unit`
    double low = 0, high = 0;
    std::string unit;
    bool by_clock = false;  // measured by wall clock, hence machine-dependent
    std::string reason;     // the claim's

    // Whether the limit is within twice what was measured; two limits are the claim's own tolerance.
    bool is_sharp() const;
};

// A claim: that a measured value is within two inclusive limits.
struct Claim {
    std::string what;      // the measured quantity
    std::string promised;  // the limits as text
    double low, high;
    std::string unit;  // may be empty
    std::string how;   // method of measurement
    std::function<double(const Trace&)> measure;
    bool by_clock = false;     // measured by wall clock; needs an otherwise idle machine
    double ending = 0;         // s before the end from which Trace::ending is recorded
    bool last_second = false;  // whether Trace::last_second is recorded
    std::string reason;        // why the limit is more than twice what is measured; empty if it is not

    Row operator()(const Trace& trace) const;  // NaN fails
};

using Measure = std::function<double(const Trace&)>;
Claim at_most(std::string what, double limit, std::string unit, std::string how, Measure measure);
Claim at_least(std::string what, double limit, std::string unit, std::string how, Measure measure);
Claim between(std::string what, double low, double high, std::string unit, std::string how, Measure measure);
Claim by_clock(Claim claim);
Claim because(Claim claim, std::string reason);  // states Claim::reason; an empty one leaves it
// Reasons that many claims share.
constexpr const char *rounding = "rounding of single precision", *any_number = "holds for any number of bodies";
Claim over_ending(Claim claim, double seconds);  // records Trace::ending
Claim over_last_second(Claim claim);             // records Trace::last_second
Claim close_to(std::string what, double expected, double tolerance, std::string unit, std::string how, Measure measure);

using Indices = std::vector<std::size_t>;
constexpr double every_step = std::numeric_limits<double>::infinity();  // as samples per second

// Sampling: a rate, 1/s, between two times, s.
struct Span {
    double per_second, from, to;

    Span(double looks_per_second = every_step, double begin = 0, double finish = std::numeric_limits<double>::infinity())
        : per_second(looks_per_second), from(begin), to(finish) {}
    bool holds(std::uint64_t step, double rate) const;
};

// A list of at least one claim.
class Promise {
public:
    template <class... More>
    explicit Promise(Claim first, More... more) : claims_{std::move(first), std::move(more)...} {}

    void also(Claim claim) { claims_.push_back(std::move(claim)); }
    // Records the states of some bodies over time.
    Promise&& watching(Indices bodies, Span span = 30) && {
        watched_ = std::move(bodies);
        watch_ = span;
        return std::move(*this);
    }
    // Records the world's statistics, at a small cost per sample. Calls accumulate.
    Promise&& sampling(Span span) && {
        sampled_.push_back(span);
        return std::move(*this);
    }
    Promise&& watching_energy() && { return std::move(*this).sampling(2); }
    // Records the states of all bodies at these times, s.
    Promise&& keeping(std::vector<double> times) && {
        kept_ = std::move(times);
        return std::move(*this);
    }
    const std::vector<Claim>& claims() const { return claims_; }
    const Indices& watched() const { return watched_; }
    bool watches(std::uint64_t step, double rate) const { return !watched_.empty() && watch_.holds(step, rate); }
    bool samples(std::uint64_t step, double rate) const;
    bool keeps(std::uint64_t step, double rate) const;
    double ending() const;  // s before the end from which statistics are recorded after every step
    bool keeps_last_second() const;

    // Judges every claim of the promise and those of soundness().
    std::vector<Row> judge(const Trace& trace) const;

private:
    std::vector<Claim> claims_;
    Indices watched_;
    Span watch_;
    std::vector<Span> sampled_;
    std::vector<double> kept_;  // s
};

// Claims of every run: all states finite, no body behind a plane (unless the user moved it there).
Claim finite();
std::vector<Claim> soundness();
std::vector<Row> judge(const std::vector<Claim>& claims, const Trace& trace);
bool all_pass(const std::vector<Row>& rows);

}  // namespace scree::demos
