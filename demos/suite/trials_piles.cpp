// Piles of ten thousand bodies of 1 m: residual motion, savings by sleep, and separation of overlapping bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

// A pit, and over it a lattice of cells in which bodies of 1 m do not touch at any orientation.
struct Pit {
    explicit Pit(std::size_t count)
        : side(std::max(2, static_cast<int>(std::ceil(portable::cbrt(2.0 * static_cast<double>(count)))))),
          half(0.5f * cell * static_cast<float>(side) + 0.1f),
          wall(0.4f * cell * static_cast<float>(side)) {}

    vec3 place(std::size_t i) const {
        const auto n = static_cast<std::size_t>(side);
        const float middle = 0.5f * static_cast<float>(side - 1);
        return vec3(static_cast<float>(i % n) - middle, static_cast<float>(i / (n * n)) + 0.52f,
                    static_cast<float>(i / n % n) - middle) *
               cell;
    }

    static constexpr float cell = 1.75f;  // m, just above the diagonal of a 1 m cube
    int side;
    float half, wall;  // m
};

Body metre_box(Random& random) {
    return box_at({}, vec3(0.5f), random.orientation());
}

Body metre_mixed(Random& random) {
    const float kind = random.unit();
    Body body = metre_box(random);
    if (kind < 0.5f) return body;
    if (kind < 0.75f) {
        body.shape = Sphere{random.between(0.4f, 0.6f)};
    } else {
        body.shape = Capsule{random.between(0.25f, 0.35f), random.between(0.2f, 0.4f)};
    }
    body.rolling_resistance = 0.03f;  // lets round bodies come to rest
    return body;
}

Scene pile_in(const Pit& pit, const DemoOptions& options, Body (*make)(Random&)) {
    Scene scene;
    scene.bodies.push_back(ground());
    add_pit(scene, {pit.half, pit.wall, pit.half}, 1);
    Random random(options.seed);
    for (std::size_t i = 0; i < options.bodies; ++i) {
        scene.bodies.push_back(make(random));
        scene.bodies.back().position = pit.place(i);
    }
    return scene;
}

// Settling times, s. Of ten thousand boxes some still slide after 18 s; piles with round bodies settle sooner.
constexpr double settled = 20, mix_settled = 12;

Claim speed_when_settled(double when) {
    return because(
        at_most("greatest speed when settled", 0.007, "m/s", fmt::format("of the centre of any body, awake, after {} s", when),
                [when](const Trace& trace) { return sample_at(trace, when).statistics.max_speed; }),
        "of thousands, single bodies rock between two points; asleep they rest");
}
Claim mean_penetration_when_settled(double when) {
    return at_most("mean penetration when settled", 0.0007, "m", fmt::format("over the points that penetrate, after {} s", when),
                   [when](const Trace& trace) { return sample_at(trace, when).statistics.penetration_mean; });
}
Claim penetration_when_settled(double when) {
    return at_most("deepest penetration when settled", 0.01, "m", fmt::format("over all contact points, after {} s", when),
                   [when](const Trace& trace) { return sample_at(trace, when).statistics.penetration_max; });
}

// ---- sleeping: switched on once the pile has settled; later a ball hits the pile
constexpr double left_alone = settled + 5, struck = settled + 6, end = settled + 20;  // s

double count_dynamic(const Trace& trace) {
    const auto& bodies = trace.scene.bodies;
    return static_cast<double>(
        std::count_if(bodies.begin(), bodies.end(), [](const Body& body) { return body.motion == Motion::dynamic; }));
}

double count_awake(const Trace& trace, const Statistics& statistics) {
    return count_dynamic(trace) - static_cast<double>(statistics.asleep);
}

double all_asleep_since(const Trace& trace, double from) {
    return first_time(trace, from, [&](const Statistics& now) { return count_awake(trace, now) == 0; }) - from;
}

// Time of the ball's impact: its velocity changed in one step by more than gravity explains.
double impact(const Trace& trace) {
    for (std::size_t i = 1; i < trace.moments.size(); ++i) {
        const Trace::Moment &before = trace.moments[i - 1], &now = trace.moments[i];
        const bool flies = before.time > struck + 0.5 / trace.rate;
        if (flies && glm::length(now.bodies[0].velocity - before.bodies[0].velocity) > 1) return now.time;
    }
    return no_number;
}

double woken_after_impact(const Trace& trace, double seconds) {
    const double when = impact(trace);
    if (std::isnan(when)) return no_number;
    return count_awake(trace, sample_at(trace, when + seconds).statistics) - 1;  // the ball was awake
}

std::vector<Claim> sleeping_claims(std::size_t boxes) {
    const Claim falls_asleep = at_most("time until all sleep", 5, "s", "from when sleeping is allowed",
                                       [](const Trace& trace) { return all_asleep_since(trace, settled); });
    const Claim cheap = by_clock(at_most(
        "cost of a step asleep, of one awake", 0.01, "", "medians: the second before the blow, the two seconds before sleeping",
        [](const Trace& trace) { return median_step(trace, left_alone, struck) / median_step(trace, settled - 2, settled); }));
    const Claim stays = at_most("greatest drift while all sleep", 0, "m", "of any body in the second before the blow; all asleep",
                                [](const Trace& trace) {
                                    if (count_awake(trace, sample_at(trace, left_alone).statistics) > 0) return no_number;
                                    return greatest_way(trace, snapshot_at(trace, left_alone), snapshot_at(trace, struck));
                                });
    const Claim wakes = at_least("bodies woken by the blow", 1, "", "two steps after the ball's velocity broke",
                                 [](const Trace& trace) { return woken_after_impact(trace, 2 / trace.rate); });
    const Claim sleeps_again = at_most("time until all sleep again", 12, "s", "from the impact",
                                       [](const Trace& trace) { return all_asleep_since(trace, impact(trace) + 0.1) + 0.1; });
    const char *last = "the last body to rest does so by chance", *small = "a blow wakes a greater part of smaller piles";
    std::vector<Claim> claims = {because(falls_asleep, last), cheap, stays, because(wakes, "piles of ten boxes, too"),
                                 because(sleeps_again, last)};
    // A blow shakes bodies up to eleven contacts away: a pile of fewer boxes wakes as a whole.
    if (boxes >= 1000)
        claims.push_back(because(
            at_most("bodies woken by the blow, 0.1 s later", 0.5 * static_cast<double>(boxes), "",
                    "0.1 s after the ball's velocity broke", [](const Trace& trace) { return woken_after_impact(trace, 0.1); }),
            small));
    return claims;
}

// Adds a ball on a post outside a corner of the pit, higher than the wall. Returns the velocity that shoots it into
// the pile near that corner.
vec3 add_ball(Scene& scene, const Pit& pit) {
    const float out = pit.half + 1.5f, height = pit.wall + 7;
    scene.bodies.push_back(fixed_box({out, (height - 1) / 2, out}, {0.4f, (height - 1) / 2, 0.4f}));
    Body ball;
    ball.name = "ball";
    ball.shape = Sphere{1};
    ball.position = {out, height, out};
    ball.rolling_resistance = 0.15f;  // stops the ball within 6 s where it rolls on the ground too
    scene.bodies.push_back(ball);
    const vec3 target(0.75f * pit.half, 0.3f * pit.wall, 0.75f * pit.half);
    return glm::normalize(target - ball.position) * 20.0f;
}

}  // namespace

DemoScene pile1m(const DemoOptions& options) {
    const Pit pit(options.bodies);
    Scene scene = pile_in(pit, options, metre_box);
    const vec3 shot = add_ball(scene, pit);
    const std::size_t ball = scene.bodies.size() - 1;
    Promise promise(speed_when_settled(settled), mean_penetration_when_settled(settled), penetration_when_settled(settled));
    for (Claim& claim : sleeping_claims(options.bodies)) promise.also(std::move(claim));
    const vec3 low(-pit.half, 0, -pit.half), high(pit.half, pit.wall + 8, pit.half);
    return {
        std::move(scene),
        view_of(low, high, 35, 38),
        low,
        high,
        end,
        std::move(promise).sampling({every_step, settled}).watching({ball}, {every_step, struck}).keeping({left_alone, struck}),
        false,
        [ball, shot](World& world) {
            if (is_due(world, settled)) world.set_sleeping(true);
            if (is_due(world, struck)) world.set_velocity(ball, shot, vec3(0));
        }};
}

DemoScene mix1m(const DemoOptions& options) {
    const Pit pit(options.bodies);
    const vec3 low(-pit.half, 0, -pit.half), high(pit.half, pit.wall, pit.half);
    const double when = mix_settled;
    return awake({pile_in(pit, options, metre_mixed), view_of(low, high, 35, 38), low, high, static_cast<float>(when),
                  Promise(speed_when_settled(when), mean_penetration_when_settled(when), penetration_when_settled(when))
                      .sampling({every_step, when})});
}

DemoScene hulls1m(const DemoOptions& options) {
    const Pit pit(options.bodies);
    const auto metre_stone = [](Random& random) { return random_stone(0.62f, random); };  // about 1 m wide
    const vec3 low(-pit.half, 0, -pit.half), high(pit.half, pit.wall, pit.half);
    const double when = settled;
    const Claim mean =
        at_most("mean penetration when settled", 0.0006, "m", fmt::format("over the points that penetrate, after {} s", when),
                [when](const Trace& trace) { return sample_at(trace, when).statistics.penetration_mean; });
    return awake({pile_in(pit, options, metre_stone), view_of(low, high, 35, 38), low, high, static_cast<float>(when),
                  Promise(mean, because(penetration_when_settled(when), "the limit of boxes, which penetrate deeper than hulls"))
                      .sampling({every_step, when})});
}

// Clumps of 3 x 3 x 3 bodies that overlap by half along every axis: the depenetration speed must be limited.
DemoScene overlap(const DemoOptions& options) {
    constexpr std::size_t edge = 3, clump = edge * edge * edge;
    constexpr float spacing = 0.5f,
                    between_clumps = 4;  // m; half a body, and more than the size of a separated clump
    const std::size_t clumps = (options.bodies + clump - 1) / clump;
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(clumps))));
    const float middle = 0.5f * static_cast<float>(side - 1);
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (std::size_t i = 0; i < options.bodies; ++i) {
        const std::size_t of = i / clump, n = i % clump;
        const vec3 centre =
            between_clumps * vec3(static_cast<float>(of % side) - middle, 0, static_cast<float>(of / side) - middle);
        Body body = metre_mixed(random);
        body.position = centre + spacing * vec3(static_cast<float>(n % edge) - 1, static_cast<float>(n / edge % edge) + 3,
                                                static_cast<float>(n / (edge * edge)) - 1);
        scene.bodies.push_back(body);
    }
    const Claim none_flies =
        at_most("greatest speed of the whole run", 10, "m/s", "of the centre of any body, at every step", [](const Trace& trace) {
            double speed = 0;
            for (const Trace::Sample& sample : trace.samples) speed = std::max(speed, sample.statistics.max_speed);
            return speed;
        });
    const float reach = 0.5f * between_clumps * static_cast<float>(side) + 1;
    const vec3 low(-reach, 0, -reach), high(reach, 4, reach);
    return awake({std::move(scene), view_of(low, high, 35, 38), low, high, 4,
                  Promise(none_flies, penetration_below(0.0075)).sampling(every_step)});
}

}  // namespace scree::demos
