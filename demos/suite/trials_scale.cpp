// Trials of small and of thin bodies: what stands at 1 m stands at 1 cm, coins and plates stack, and heaps of every
// shape come to rest.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

namespace {

constexpr float run_for = 20, last_part = 2;  // s

// Bodies of a stack, which must stay where they are.
struct Stacked {
    std::size_t body;
    float half;  // half width, m
};
Claim none_fell(std::vector<Stacked> stacked) {
    return at_most("bodies that fell off", 0, "", "moved sideways by more than half their half width",
                   [stacked = std::move(stacked)](const Trace& trace) {
                       double fallen = 0;
                       for (const auto& [body, half] : stacked) {
                           const vec3 way = trace.end[body].position - trace.start[body].position;
                           fallen += !(portable::hypot(way.x, way.z) < 0.5f * half);
                       }
                       return fallen;
                   });
}

DemoScene resting(Scene scene, vec3 low, vec3 high, std::vector<Claim> more) {
    Promise promise(end_speed_below(rest_speed, last_part), end_spin_below(rest_spin, last_part));
    for (Claim& claim : more) promise.also(std::move(claim));
    return awake({std::move(scene), view_of(low, high, 25, 15), low, high, run_for, std::move(promise)});
}

// `count` bodies of one shape, one on the other, displaced at random by up to `shift` and turned by up to `turn`.
struct Pile {
    Shape shape;
    int count;
    float height, half;  // of one, m
    float yaw, shift, turn;
    float step_yaw = 0;  // from one to the next, rad
    float gap = 0;       // between them at the start, m
};
void add_pile(Scene& scene, const Pile& pile, vec3 foot, Random& random, std::vector<Stacked>& stacked) {
    for (int i = 0; i < pile.count; ++i) {
        const auto level = static_cast<float>(i);
        const float z = random.between(-pile.shift, pile.shift), x = random.between(-pile.shift, pile.shift);
        const vec3 place(x, pile.height * (level + 0.5f) + pile.gap * level, z);
        const float yaw = pile.yaw + pile.step_yaw * level + random.between(-pile.turn, pile.turn);
        stacked.push_back({add_body(scene, pile.shape, foot + place, turned({0, 1, 0}, yaw)), pile.half});
    }
}

Hull as_hull(const Box& box) {
    Hull hull;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f})
            for (const float z : {-1.0f, 1.0f}) hull.points.push_back(vec3(x, y, z) * box.half_extents);
    return hull;
}

}  // namespace

DemoScene scales(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    std::vector<Stacked> stacked;
    float x = 0;
    for (const auto& [count, size] : {std::pair{5, 0.01f}, {10, 0.02f}, {10, 0.1f}}) {
        for (const float yaw : {0.0f, 20 * degrees, 45 * degrees}) {
            add_pile(scene, {Box{vec3(0.5f * size)}, count, size, 0.5f * size, yaw, 0.002f * size, 0.3f * degrees}, {x, 0, 0},
                     random, stacked);
            x += 5 * size;
        }
    }
    constexpr float brick = 0.01f;
    for (int row = 0; row < 10; ++row)
        for (int column = 0; column < 10 - row; ++column)
            stacked.push_back({add_body(scene, Box{vec3(0.5f * brick)},
                                        vec3((static_cast<float>(column) - 0.5f * static_cast<float>(9 - row)) * 1.02f,
                                             static_cast<float>(row) + 0.5f, 20) *
                                            brick),
                               0.5f * brick});
    return resting(std::move(scene), {-0.2f, 0, -0.2f}, {x, 1, 0.3f}, {none_fell(std::move(stacked))});
}

DemoScene coins(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    std::vector<Stacked> stacked;
    float x = 0;
    for (const float radius : {0.5f, 0.05f}) {
        const float half = 0.1f * radius;
        std::vector<std::pair<Shape, int>> shapes = {{Cylinder{radius, half}, 10},
                                                     {Cylinder{radius, half}, 20},
                                                     {prism(8, radius, half), 10},
                                                     {Box{{radius, half, radius}}, 10}};
        if (radius == 0.5f) shapes.push_back({prism(5, radius, half), 10});
        for (const auto& [shape, count] : shapes) {
            add_pile(scene, {shape, count, 2 * half, radius, 0, 0.04f * radius, 180 * degrees}, {x, 0, 0}, random, stacked);
            x += 3 * radius;
        }
    }
    // Plates across each other, dropped by 2 mm each: boxes and hulls.
    for (const auto& [shape, count, step_yaw] : {std::tuple<Shape, int, float>{Box{{0.5f, 0.02f, 0.1f}}, 10, 90 * degrees},
                                                 {Box{{0.5f, 0.025f, 0.15f}}, 4, 75 * degrees},
                                                 {as_hull(Box{{0.5f, 0.025f, 0.15f}}), 4, 90 * degrees}}) {
        x += 1.3f;
        const float half = std::holds_alternative<Box>(shape) ? std::get<Box>(shape).half_extents.y : 0.025f;
        add_pile(scene, {shape, count, 2 * half, 0.15f, 0, 0.005f, degrees, step_yaw, 0.002f}, {x, 0, 0}, random, stacked);
    }
    return resting(std::move(scene), {-0.5f, 0, -1}, {x, 2, 1}, {none_fell(std::move(stacked))});
}

DemoScene calm(const DemoOptions& options) {
    DemoOptions heap;
    heap.bodies = options.bodies;
    heap.seed = options.seed + 2;  // not those of `assortment`
    DemoScene made = assortment(heap);
    made.add_others();
    return resting(std::move(made.scene), made.low, made.high, {});
}

}  // namespace scree::demos
