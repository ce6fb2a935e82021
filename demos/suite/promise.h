// Promises: what must be true after a demo has run, measured from how its bodies moved.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "compute/world.h"

namespace scree::demos {

// Measured where there is nothing to measure: it passes nothing.
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// What is remembered of a run. Small: what a promise has not asked for is not kept.
struct Trace {
    struct Moment {
        double time = 0;                // s
        std::vector<BodyState> bodies;  // the watched ones, in the promise's order; or all, in a snapshot
    };
    struct Sample {
        double time = 0;  // s
        Statistics statistics;
    };
    Scene scene;       // as checked; for a claim that reads shapes and materials
    double rate = 60;  // steps per second
    std::vector<BodyState> start, end;
    Statistics statistics;            // at the end
    std::vector<Moment> moments;      // of the watched bodies
    std::vector<Moment> snapshots;    // of all bodies, one for each time that the promise asks for
    std::vector<Sample> samples;      // of sums and extremes over the world
    std::vector<float> step_seconds;  // what each step took by the clock; differs from machine to machine
};

// One line of a verdict.
struct Row {
    std::string what, promised, measured;
    bool pass = false;
    double value = 0;  // measured, in `unit`
    double low = 0, high = 0;
    std::string unit;
    bool by_clock = false;  // depends on the machine and on what else it does
};

// What is promised of one measured value: that it lies between two limits, both included.
struct Claim {
    std::string what;      // is measured
    std::string promised;  // the limits in words
    double low, high;
    std::string unit;  // may be empty
    std::string how;   // it is measured
    std::function<double(const Trace&)> measure;
    bool by_clock = false;  // measured by the clock: meant for a machine that does nothing else

    Row operator()(const Trace& trace) const;  // a value that is not a number passes nothing
};

using Measure = std::function<double(const Trace&)>;
Claim at_most(std::string what, double limit, std::string unit, std::string how, Measure measure);
Claim at_least(std::string what, double limit, std::string unit, std::string how, Measure measure);
Claim between(std::string what, double low, double high, std::string unit, std::string how, Measure measure);
Claim by_clock(Claim claim);
Claim close_to(std::string what, double expected, double tolerance, std::string unit, std::string how, Measure measure);

using Indices = std::vector<std::size_t>;
constexpr double every_step = std::numeric_limits<double>::infinity();  // as a number of looks per second

// When to look: so often a second between two times, s.
struct Span {
    double per_second, from, to;

    Span(double looks_per_second = every_step, double begin = 0, double finish = std::numeric_limits<double>::infinity())
        : per_second(looks_per_second), from(begin), to(finish) {}
    bool holds(std::uint64_t step, double rate) const;
};

// At least one claim, so that no demo is without.
class Promise {
public:
    template <class... More>
    explicit Promise(Claim first, More... more) : claims_{std::move(first), std::move(more)...} {}

    void also(Claim claim) { claims_.push_back(std::move(claim)); }
    // The states of some bodies.
    Promise&& watching(Indices bodies, Span span = 30) && {
        watched_ = std::move(bodies);
        watch_ = span;
        return std::move(*this);
    }
    // Sums and extremes over the world: cheap beside a step, not beside nothing. Spans add up.
    Promise&& sampling(Span span) && {
        sampled_.push_back(span);
        return std::move(*this);
    }
    Promise&& watching_energy() && { return std::move(*this).sampling(2); }
    // The states of all bodies at these times, s.
    Promise&& keeping(std::vector<double> times) && {
        kept_ = std::move(times);
        return std::move(*this);
    }
    const std::vector<Claim>& claims() const { return claims_; }
    const Indices& watched() const { return watched_; }
    bool watches(std::uint64_t step, double rate) const { return !watched_.empty() && watch_.holds(step, rate); }
    bool samples(std::uint64_t step, double rate) const;
    bool keeps(std::uint64_t step, double rate) const;

    // Every claim, and what holds for any run.
    std::vector<Row> judge(const Trace& trace) const;

private:
    std::vector<Claim> claims_;
    Indices watched_;
    Span watch_;
    std::vector<Span> sampled_;
    std::vector<double> kept_;  // s
};

// What holds for any run: all bodies finite, none behind a plane (where hands did not put it).
Claim finite();
std::vector<Claim> soundness();
std::vector<Row> judge(const std::vector<Claim>& claims, const Trace& trace);
bool all_pass(const std::vector<Row>& rows);

}  // namespace scree::demos
