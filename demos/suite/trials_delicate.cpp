// Delicate stability, which needs contacts without creep or jitter: a house of cards, a tower of blocks, a tray under
// a heavy load.
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float lean = 22 * degrees;               // angle of a card from the vertical; needs friction 0.40
constexpr float length = 0.9f, thickness = 0.01f;  // m, a card of 9 cm x 1 mm, scaled by ten
constexpr float width = 0.6f;

// Adds two cards that lean against each other above (x, y). Returns the height of their upper edges.
float add_tent(Scene& scene, float x, float y, Random& random) {
    const float half_span = 0.5f * (thickness * portable::cos(lean) + length * portable::sin(lean));
    const float half_rise = 0.5f * (thickness * portable::sin(lean) + length * portable::cos(lean));
    for (const float side : {-1.0f, 1.0f}) {
        const vec3 place(x + side * half_span, y + half_rise, random.between(-0.002f, 0.002f));
        scene.bodies.push_back(box_at(place, {thickness / 2, length / 2, width / 2}, turned({0, 0, 1}, side * lean)));
    }
    return y + 2 * half_rise;
}

}  // namespace

DemoScene cards(const DemoOptions& options) {
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    const float spacing = 2 * (thickness * portable::cos(lean) + length * portable::sin(lean));
    float y = 0;
    for (int tents = 3; tents > 0; --tents) {
        float top = y;
        const float first = -0.5f * spacing * static_cast<float>(tents - 1);
        for (int i = 0; i < tents; ++i) top = add_tent(scene, first + spacing * static_cast<float>(i), y, random);
        // Floors span from ridge to ridge, 1 mm shorter so that they do not overlap.
        for (int i = 0; i + 1 < tents; ++i) {
            const vec3 place(first + spacing * (static_cast<float>(i) + 0.5f), top + thickness / 2,
                             random.between(-0.002f, 0.002f));
            scene.bodies.push_back(box_at(place, {(spacing - 0.001f) / 2, thickness / 2, width / 2}));
        }
        y = top + thickness;
    }
    const vec3 low(-1.3f, 0, -0.6f), high(1.3f, 2.7f, 0.6f);
    return awake({std::move(scene), view_of(low, high, 25, 12), low, high, 20,
                  Promise(drift_below(0.011), end_speed_below(), end_spin_below(), sway_below())});
}

// Jenga blocks, scaled by ten.
DemoScene jenga(const DemoOptions& options) {
    const vec3 half(0.375f, 0.075f, 0.125f);
    const float spacing = 0.254f;  // m, with 4 mm gaps so that rotated blocks do not overlap
    Scene scene;
    scene.bodies.push_back(ground());
    Random random(options.seed);
    for (int layer = 0; layer < 18; ++layer) {
        for (int i = -1; i <= 1; ++i) {
            const float along = random.between(-0.002f, 0.002f), across = spacing * static_cast<float>(i);
            const bool turned_layer = layer % 2 == 1;
            const vec3 place(turned_layer ? across : along, half.y * static_cast<float>(2 * layer + 1),
                             turned_layer ? along : across);
            const float turn = (turned_layer ? 90 : 0) + random.between(-0.3f, 0.3f);
            scene.bodies.push_back(box_at(place, half, turned({0, 1, 0}, turn * degrees)));
            scene.bodies.back().density = 600;  // wood
        }
    }
    const vec3 low(-0.8f, 0, -0.8f), high(0.8f, 2.75f, 0.8f);
    return awake({std::move(scene), view_of(low, high, 30, 14), low, high, 20,
                  Promise(drift_below(0.016), end_speed_below(), end_spin_below(), sway_below(), penetration_below(0.0018))});
}

// A plate on a table smaller than itself, under a layer of boxes of 2.5 times its mass. On a plate of a tenth of
// their mass the boxes would not come to rest, because its split masses are too small (mass_splitting.h).
DemoScene tray(const DemoOptions& options) {
    constexpr int rows = 20, columns = 25;
    constexpr float spacing = 1.05f;
    const vec3 half(0.5f * spacing * columns, 0.1f, 0.5f * spacing * rows);
    const vec3 table(0.6f * half.x, 0.5f, 0.6f * half.z);
    Scene scene;
    scene.bodies.push_back(ground());
    scene.bodies.push_back(fixed_box({0, table.y, 0}, table));
    const std::size_t plate = scene.bodies.size();
    scene.bodies.push_back(box_at({0, 2 * table.y + half.y, 0}, half));
    scene.bodies[plate].density = 200000 / (8 * half.x * half.y * half.z);  // 200 t; the 500 boxes weigh 1 t each
    Random random(options.seed);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float across = random.between(-0.002f, 0.002f), along = random.between(-0.002f, 0.002f);
            const vec3 place(spacing * (static_cast<float>(column) - 0.5f * (columns - 1)) + along,
                             2 * table.y + 2 * half.y + 0.5f, spacing * (static_cast<float>(row) - 0.5f * (rows - 1)) + across);
            scene.bodies.push_back(box_at(place, vec3(0.5f), turned({0, 1, 0}, random.between(-0.3f, 0.3f) * degrees)));
        }
    }
    const Claim still = because(at_most("speed of the plate at the end", rest_speed, "m/s", "of its centre",
                                        [plate](const Trace& trace) { return glm::length(trace.end[plate].velocity); }),
                                at_rest);
    const Claim calm =
        at_most("mean speed of the plate", rest_speed, "m/s", "over the last 5 s, at every step", [](const Trace& trace) {
            double sum = 0, count = 0;
            for (const Trace::Moment& moment : trace.moments) {
                sum += static_cast<double>(glm::length(moment.bodies[0].velocity));
                ++count;
            }
            return sum / count;
        });
    const Claim level = at_most("tilt of the plate", 0.05, "degrees", "at the end", [plate](const Trace& trace) {
        return tilt(trace.end[plate], {0, 1, 0});
    });
    const vec3 low(-half.x, 0, -half.z), high(half.x, 2.4f, half.z);
    return awake(
        {std::move(scene), view_of(low, high, 30, 24), low, high, 20,
         Promise(still, because(calm, at_rest), because(level, "single precision resolves 0.02 degrees"), drift_below(0.00045))
             .watching({plate}, {every_step, 15})});
}

}  // namespace scree::demos
