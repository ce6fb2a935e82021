// Trial of cylinders, cones and hulls: they stand, ten hulls stack, a cylinder rolls as expected.
#include "demos/scenes/demos.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

namespace {

const Incline incline{15 * degrees, 6, 1};

}  // namespace

DemoScene solids(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    const vec4 lying = turned({1, 0, 0}, 90 * degrees);
    const Indices standing{add_body(scene, Cylinder{0.3f, 0.4f}, {-2, 0.4f, 4}), add_body(scene, Cone{0.3f, 0.8f}, {-1, 0.2f, 4}),
                           add_body(scene, prism(5, 0.4f, 0.3f), {0, 0.3f, 4}),
                           add_body(scene, Cylinder{0.3f, 0.4f}, {1, 0.3f, 4}, lying)};
    Indices column;
    for (int k = 0; k < 10; ++k)
        column.push_back(add_body(scene, prism(6, 0.5f, 0.25f), {3, 0.25f + 0.5f * static_cast<float>(k), 4}));
    Body roller;
    roller.shape = Cylinder{0.4f, 0.5f};
    roller.orientation = lying;
    const std::size_t rolling = add_lane(scene, incline, 0, roller, 0.4f, 0.6f, 1);
    const vec3 low(-6, 0, -1), high(6, 5, 5);
    // I = m r^2 / 2 for a cylinder, so it accelerates by two thirds of gravity along the slope.
    const double expected = incline.along() * 2 / 3;
    Promise promise(all_stay("cylinders, a cone and a hull that stand or lie", standing, 0.00006),
                    all_stay("ten hulls, one on the other", column, 0.006),
                    close_to("acceleration of a cylinder that rolls", expected, 0.01 * expected, "m/s^2",
                             "velocity gained down the incline from half a second to the end",
                             [](const Trace& trace) { return acceleration(trace, 0, incline.down(), 0.5); }));
    return awake(
        {std::move(scene), view_of(low, high, 20, 15), low, high, 2.2f, std::move(promise).watching({rolling}, {30, 0, 2})});
}

}  // namespace scree::demos
