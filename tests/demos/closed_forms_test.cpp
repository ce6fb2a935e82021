// Analytic checks on synthetic traces: exact motion passes, slightly wrong motion fails.
#include <catch2/catch.hpp>
#include <cmath>

#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"

using namespace scree;
using namespace scree::demos;

namespace {

constexpr double g = 9.81;

BodyState at(vec3 position, vec3 velocity = vec3(0)) {
    return {.position = position, .orientation = {0, 0, 0, 1}, .velocity = velocity, .angular_velocity = vec3(0)};
}

// A trace of one body at 60 Hz; `state` gives its state at a time (s).
template <class State>
Trace trace_of(double seconds, State state) {
    Trace trace;
    trace.scene.bodies.push_back(box_at({}, {0.2f, 0.5f, 0.9f}));
    const int steps = static_cast<int>(std::lround(seconds * 60));
    for (int i = 0; i <= steps; ++i) trace.moments.push_back({i / 60.0, {state(i / 60.0)}});
    trace.start = trace.moments.front().bodies;
    trace.end = trace.moments.back().bodies;
    return trace;
}

// A body dropped from `height` that bounces to each of `tops`, m.
BodyState bouncing(double time, double height, const std::vector<double>& tops) {
    double left = time - std::sqrt(2 * height / g);
    if (left < 0) return at({0, 3 + height - g / 2 * time * time, 0});
    for (const double top : tops) {
        const double speed = std::sqrt(2 * g * top);
        if (left < 2 * speed / g) return at({0, 3 + speed * left - g / 2 * left * left, 0});
        left -= 2 * speed / g;
    }
    return at({0, 3, 0});
}

bool passes(const Claim& claim, const Trace& trace) {
    return claim(trace).pass;
}

}  // namespace

TEST_CASE("a body that creeps further than promised is seen, and no bodies at all is a miss") {
    const auto creeping = [](double speed) { return trace_of(2, [=](double t) { return at({0, 1, float(speed * t)}); }); };
    CHECK(passes(all_stay("it", {0}, 0.001), creeping(0.0004)));
    CHECK_FALSE(passes(all_stay("it", {0}, 0.001), creeping(0.0006)));
    CHECK_FALSE(passes(all_stay("it", {0}, 0.001), creeping(std::nan(""))));
    CHECK_FALSE(passes(all_stay("it", {}, 0.001), creeping(0)));
}

TEST_CASE("an acceleration two per cent off is seen, and one that is not there") {
    const vec3 down(0.6f, -0.8f, 0);
    const Claim claim = all_accelerate("it", {{0, down, 2.0}}, 0.5, 1);
    const auto accelerated = [&](double a) { return trace_of(2, [=](double t) { return at(vec3(0), down * float(a * t)); }); };
    CHECK(acceleration(accelerated(2), 0, down, 0.5) == Approx(2));
    CHECK(passes(claim, accelerated(2.01)));
    CHECK_FALSE(passes(claim, accelerated(2.04)));
    CHECK_FALSE(passes(claim, accelerated(1.96)));
    CHECK_FALSE(passes(claim, accelerated(0)));
    CHECK_FALSE(passes(claim, trace_of(0.3, [&](double t) { return at(vec3(0), down * float(2 * t)); })));  // too short
}

TEST_CASE("what rolls to rest must rest, and in the right place") {
    const Claim claim = all_roll_to_rest("it", {{0, 2.0}}, 5);
    const auto stopped = [](float way, float speed) {
        return trace_of(1, [=](double t) { return at({float(t) * way, 0, 0}, {speed, 0, 0}); });
    };
    CHECK(passes(claim, stopped(2.05f, 0)));
    CHECK_FALSE(passes(claim, stopped(2.2f, 0)));
    CHECK_FALSE(passes(claim, stopped(1.8f, 0)));
    CHECK_FALSE(passes(claim, stopped(2.0f, 0.01f)));
}

TEST_CASE("bounces are held to e^2 of the height, each of them") {
    const auto run = [](double height, std::vector<double> tops) {
        return trace_of(5, [=](double t) { return bouncing(t, height, tops); });
    };
    const Claim half = all_bounce("it", {{0, 2.0, 0.5, 1}}, 2), full = all_bounce("it", {{0, 1.0, 1.0, 3}}, 2);
    const Claim none = all_bounce("it", {{0, 2.0, 0.0, 1}}, 2);
    CHECK(half.measure(run(2, {0.5})) < 0.01);
    CHECK_FALSE(passes(half, run(2, {0.515})));
    CHECK_FALSE(passes(half, run(2, {})));
    CHECK(full.measure(run(1, {1, 1, 1})) < 0.01);
    CHECK_FALSE(passes(full, run(1, {1, 1, 0.97})));
    CHECK_FALSE(passes(full, run(1, {1, 1})));
    CHECK(passes(none, run(2, {})));
    CHECK_FALSE(passes(none, run(2, {0.05})));
}

TEST_CASE("lost or gained momentum, angular momentum and energy are seen") {
    const Indices it = {0};
    const auto moving = [](float linear, float spin) {
        return trace_of(1, [=](double t) {
            BodyState state = at({0.2f * float(t), 3, 0}, {t < 0.5 ? 1 : linear, 0, 0});
            state.angular_velocity = {0, 0, t < 0.5 ? 2 : spin};
            return state;
        });
    };
    const Trace kept = moving(1, 2), slowed = moving(0.97f, 2), spun = moving(1, 2.1f);
    for (const Claim& claim : {each_keeps_angular_momentum(it, 0.01), each_keeps_energy(it, 0.01),
                               together_keep_momentum(it, 1e-5), together_keep_angular_momentum(it, 1e-5)}) {
        INFO(claim.what);
        CHECK(passes(claim, kept));
    }
    CHECK_FALSE(passes(each_keeps_angular_momentum(it, 0.01), spun));
    CHECK_FALSE(passes(each_keeps_energy(it, 0.01), spun));
    CHECK_FALSE(passes(each_keeps_energy(it, 0.01), slowed));
    CHECK_FALSE(passes(together_keep_momentum(it, 1e-5), slowed));
    CHECK_FALSE(passes(together_keep_angular_momentum(it, 1e-5), slowed));  // changes its orbital angular momentum
    CHECK_FALSE(passes(together_keep_angular_momentum(it, 1e-5), spun));
    CHECK_FALSE(passes(together_keep_momentum(it, 1e-5), moving(std::nanf(""), 2)));
    CHECK(passes(energy_left_below(it, 0.5), moving(0.1f, 0.2f)));
    CHECK_FALSE(passes(energy_left_below(it, 0.5), kept));
}

TEST_CASE("a body that does not turn over is seen") {
    const auto turning = [](float angle) {
        return trace_of(1, [=](double t) {
            BodyState state = at(vec3(0));
            state.orientation = turned({1, 0, 0}, angle * static_cast<float>(t));
            return state;
        });
    };
    CHECK(passes(each_turns_over({0}, {0, 1, 0}, 120), turning(130 * degrees)));
    CHECK_FALSE(passes(each_turns_over({0}, {0, 1, 0}, 120), turning(110 * degrees)));
    CHECK_FALSE(passes(each_turns_over({0}, {1, 0, 0}, 120), turning(130 * degrees)));
}

TEST_CASE("a cradle that keeps some of the blow is seen") {
    const auto left_with = [](std::vector<float> speeds) {
        Trace trace;
        for (const float speed : speeds) trace.end.push_back(at(vec3(0), {speed, 0, 0}));
        return trace;
    };
    const Indices row = {0, 1, 2};
    const Claim last = last_take_the_speed("it", row, 1, 2), others = others_stay("it", row, 1, 2);
    CHECK(passes(last, left_with({0, 0, 1.999f})));
    CHECK_FALSE(passes(last, left_with({0, 0, 1.99f})));
    CHECK_FALSE(passes(last, left_with({0, 0, 2.01f})));
    CHECK(passes(others, left_with({1e-5f, -1e-5f, 2})));
    CHECK_FALSE(passes(others, left_with({1e-4f, 0, 2})));
    CHECK_FALSE(passes(others, left_with({-1e-4f, 0, 2})));
    CHECK_FALSE(passes(last_take_the_speed("it", row, 2, 2), left_with({0, 1.8f, 2})));
}

TEST_CASE("a shot behind what it was aimed at is counted, in the target's own axes if it turns") {
    Trace trace;
    trace.end = {at({0, 0, 0}), at({0, 0, 0.1f}), at({0, 0, 0.01f}), at({0.1f, 0, 0})};
    const auto went_through = [&](std::size_t shot, bool turns) {
        return none_through("it", {{shot, 0, {0, 0, 1}, 0.025, turns}}).measure(trace);
    };
    CHECK(went_through(1, false) == 0);
    CHECK(went_through(2, false) == 1);
    CHECK(went_through(3, true) == 1);
    trace.end[0].orientation = turned({0, 1, 0}, 90 * degrees);  // its front faces x now
    CHECK(went_through(3, true) == 0);
    CHECK(went_through(1, true) == 1);
    CHECK(went_through(1, false) == 0);
    trace.end[1].position.z = std::nanf("");
    CHECK(went_through(1, false) == 1);
}
