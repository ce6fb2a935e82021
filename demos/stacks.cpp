// What must stand: bodies at rest, a stack, a tower, a wall and a pyramid.
#include "demos/building.h"
#include "demos/demos.h"
#include "demos/random.h"

namespace scree::demos {

namespace {

constexpr float half = 0.5f;  // m, of the boxes that are stacked

// A column of boxes, each off by up to 2 mm and turned by up to 0.3 degrees, as if set by hand.
void add_column(Scene& scene, int count, Random& random) {
    for (int i = 0; i < count; ++i) {
        const vec3 position(random.between(-0.002f, 0.002f), half + 2 * half * static_cast<float>(i),
                            random.between(-0.002f, 0.002f));
        scene.bodies.push_back(box_at(position, vec3(half), turned({0, 1, 0}, random.between(-0.3f, 0.3f) * degrees)));
    }
}

}  // namespace

DemoScene rest(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    const float drop = 0.01f;
    Body sphere;
    sphere.name = "sphere";
    sphere.shape = Sphere{0.5f};
    sphere.position = {-2.4f, 0.5f + drop, 0};
    Body capsule;
    capsule.name = "capsule";
    capsule.shape = Capsule{0.3f, 0.4f};
    capsule.position = {-0.8f, 0.3f + drop, 0};
    capsule.orientation = turned({1, 0, 0}, 90 * degrees);
    Body box = box_at({0.8f, 0.5f + drop, 0}, vec3(0.5f), turned({0, 1, 0}, 30 * degrees));
    box.name = "box";
    Body slab = box_at({2.4f, 0.15f + drop, 0}, {0.6f, 0.15f, 0.4f}, turned({0, 1, 0}, -20 * degrees));
    slab.name = "slab";
    for (Body* body : {&sphere, &capsule, &box, &slab}) {
        body->rolling_resistance = 0.005f;
        scene.bodies.push_back(*body);
    }
    const vec3 low(-3.2f, 0, -1), high(3.2f, 1.6f, 1);
    return {std::move(scene),
            view_of(low, high, 25, 18),
            low,
            high,
            5,
            Promise(drift_below(0.05), end_speed_below(0.005), penetration_below(0.002))};
}

DemoScene stack(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    add_column(scene, 10, random);
    const vec3 low(-2, 0, -2), high(2, 10.2f, 2);
    return {std::move(scene),
            view_of(low, high, 30, 14),
            low,
            high,
            20,
            Promise(drift_below(0.05), end_speed_below(0.005), penetration_below(0.005))};
}

DemoScene tower(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    add_column(scene, 40, random);
    const vec3 low(-4, 0, -4), high(4, 40.5f, 4);
    return {std::move(scene),
            view_of(low, high, 30, 10),
            low,
            high,
            20,
            Promise(drift_below(0.16), end_speed_below(0.05), penetration_below(0.01))};
}

DemoScene wall(const DemoOptions& options) {
    constexpr int rows = 16, columns = 32;
    const vec3 brick(0.5f, 0.25f, 0.25f);
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (int row = 0; row < rows; ++row) {
        const bool shifted = row % 2 == 1;  // odd courses begin and end with half a brick
        const float y = brick.y * static_cast<float>(2 * row + 1);
        for (int column = 0; column < columns + shifted; ++column) {
            const bool halved = shifted && (column == 0 || column == columns);
            float x = static_cast<float>(column) - 0.5f * columns + (shifted ? 0.0f : 0.5f);
            if (halved) x += column == 0 ? 0.25f : -0.25f;
            const vec3 size(halved ? 0.25f : 0.5f, brick.y, brick.z);
            // A millimetre of air at each head joint: bricks must not overlap at the start.
            scene.bodies.push_back(box_at({x, y, random.between(-0.002f, 0.002f)}, size - vec3(0.0005f, 0, 0)));
        }
    }
    const vec3 low(-16, 0, -2), high(16, 8.2f, 2);
    return {std::move(scene),
            view_of(low, high, 30, 16),
            low,
            high,
            20,
            Promise(drift_below(0.04), end_speed_below(0.01), penetration_below(0.005))};
}

DemoScene pyramid(const DemoOptions& options) {
    constexpr int base = 30;
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (int row = 0; row < base; ++row) {
        for (int column = 0; column < base - row; ++column) {
            const float x = (static_cast<float>(column) - 0.5f * static_cast<float>(base - row - 1)) * 1.02f;
            const vec3 position(x, half + 2 * half * static_cast<float>(row), random.between(-0.002f, 0.002f));
            scene.bodies.push_back(box_at(position, vec3(half), turned({0, 1, 0}, random.between(-0.3f, 0.3f) * degrees)));
        }
    }
    const vec3 low(-15.5f, 0, -3), high(15.5f, 30.2f, 3);
    return {std::move(scene),
            view_of(low, high, 30, 14),
            low,
            high,
            20,
            Promise(drift_below(0.06), end_speed_below(0.01), penetration_below(0.01))};
}

}  // namespace scree::demos
