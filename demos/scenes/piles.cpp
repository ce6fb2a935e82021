// Piles in a pit: boxes, boxes with spheres and capsules, stones in a bin.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random_bodies.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float pile_reach = 0.42f;  // m
constexpr float pile_cell = 2 * pile_reach;

// Bodies in a lattice above a pit that is twice as wide as the lattice is high.
DemoScene heap(const DemoOptions& options, Body (*make)(float reach, Random&), float smallest_reach) {
    const std::size_t count = options.bodies;
    const int side = std::max(2, static_cast<int>(std::ceil(portable::cbrt(2.0 * static_cast<double>(count)))));
    Scene scene;
    scene.bodies.push_back(ground());
    const float half = 0.5f * pile_cell * static_cast<float>(side) + 0.1f;
    const float wall = 0.4f * pile_cell * static_cast<float>(side);
    add_pit(scene, {half, wall, half}, 0.5f);
    const auto place_of = [side](std::size_t i) {
        const auto n = static_cast<std::size_t>(side);
        const vec3 place(static_cast<float>(i % n) - 0.5f * static_cast<float>(side - 1), static_cast<float>(i / (n * n)) + 0.55f,
                         static_cast<float>(i / n % n) - 0.5f * static_cast<float>(side - 1));
        return place * pile_cell;
    };
    const auto bodies = [=, seed = options.seed](const TakeBody& take) {
        Random random(seed);
        for (std::size_t i = 0; i < count; ++i) {
            Body body = make(random.between(smallest_reach, pile_reach), random);
            body.position = place_of(i);
            take(std::move(body));
        }
    };
    const float top = count == 0 ? 0 : place_of(count - 1).y + pile_reach;
    const float outside = half + 0.5f;
    const vec3 low(-outside, 0, -outside), high(outside, top, outside);
    const float seconds = 8 + 0.2f * static_cast<float>(side);  // higher lattices fall and settle longer
    DemoScene made{
        std::move(scene),
        view_of(low, high, 35, 38),
        low,
        high,
        seconds,
        Promise(all_within({-half, -0.01f, -half}, {half, 2 * wall, half}), because(penetration_below(0.05), any_number),
                energy_never_rises(0.001), because(end_speed_below(0.005), any_number), because(end_spin_below(0.01), any_number))
            .watching_energy()};
    made.others = bodies;
    return made;
}

}  // namespace

DemoScene pile(const DemoOptions& options) {
    return heap(options, random_box, 0.32f);
}

DemoScene mix(const DemoOptions& options) {
    return heap(options, random_mixed, 0.25f);
}

DemoScene assortment(const DemoOptions& options) {
    return heap(options, random_assorted, 0.2f);
}

// The stones are the same for every seed, which says how they lie: copies of the scene with seeds of their own share them.
DemoScene bins(const DemoOptions& options) {
    constexpr float half = 0.3f, height = 0.3f, cell = 0.2f;  // m
    Scene scene;
    scene.bodies.push_back(fixed_box({0, -0.05f, 0}, {half + 0.1f, 0.05f, half + 0.1f}));
    add_pit(scene, {half, height, half}, 0.05f);
    Random shapes(1), random(options.seed);
    for (int i = 0; i < 20; ++i) {
        Body stone = random_stone(shapes.between(0.07f, 0.095f), shapes);
        stone.orientation = random.orientation();
        stone.position =
            cell * vec3(static_cast<float>(i % 3 - 1), static_cast<float>(i / 9) + 0.6f, static_cast<float>(i / 3 % 3 - 1));
        stone.velocity = {random.between(-0.25f, 0.25f), 0, random.between(-0.25f, 0.25f)};
        scene.bodies.push_back(std::move(stone));
    }
    const vec3 low(-half - 0.1f, -0.1f, -half - 0.1f), high(half + 0.1f, 0.6f, half + 0.1f);
    return {std::move(scene),
            view_of(low, high, 35, 38),
            low,
            high,
            5,
            Promise(all_within({-half, 0, -half}, {half, 2 * height, half}),
                    because(penetration_below(0.00045), "the deepest of hundreds of contacts: 0.18 to 0.35 mm, by the seed"),
                    energy_never_rises(0.001), end_speed_below(), end_spin_below())
                .watching_energy()};
}

}  // namespace scree::demos
