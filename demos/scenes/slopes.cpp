// Inclines: sliding, sticking and rolling, checked against Coulomb friction and rigid body rolling.
#include "demos/scenes/demos.h"
#include "demos/scenes/incline.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"

namespace scree::demos {

namespace {

const Incline incline{15 * degrees, 8};  // sticking needs a friction coefficient of tan 15 degrees = 0.268
constexpr float lane = 1.3f;             // m, spacing of inclines

std::size_t add_numbered(Scene& scene, int index, const Body& body, float height, float friction) {
    return add_lane(scene, incline, lane * (static_cast<float>(index) - 3.5f), body, height, friction);
}

Claim accelerates(const std::string& what, std::size_t slot, double expected) {
    return close_to("acceleration of the " + what, expected, 0.01 * expected, "m/s^2",
                    "velocity gained down the incline from half a second to the end",
                    [slot](const Trace& trace) { return acceleration(trace, slot, incline.down(), 0.5); });
}

Claim sticks(const std::string& what, std::size_t body) {
    return because(at_most("creep of the " + what, 0.0001, "m", "from its start to the end",
                           [body](const Trace& trace) {
                               return static_cast<double>(glm::length(trace.end[body].position - trace.start[body].position));
                           }),
                   "10 km from the origin, where tests run it too, it is 0.08 mm");
}

}  // namespace

DemoScene slopes(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    Body box = box_at({}, vec3(0.3f, 0.2f, 0.3f));
    Indices watched;
    Promise promise(because(penetration_below(0.0002), "10 km from the origin, where tests run it too, it is 0.13 mm"));
    int index = 0;
    for (const char* friction : {"0.05", "0.1", "0.15", "0.2"}) {
        const float mu = std::stof(friction);
        watched.push_back(add_numbered(scene, index++, box, 0.2f, mu));
        promise.also(accelerates("box with friction " + std::string(friction), watched.size() - 1,
                                 incline.along() - mu * incline.across()));
    }
    for (const char* friction : {"0.3", "0.5"}) {
        const std::size_t body = add_numbered(scene, index++, box, 0.2f, std::stof(friction));
        promise.also(sticks("box with friction " + std::string(friction), body));
    }
    Body sphere;
    sphere.shape = Sphere{0.35f};
    watched.push_back(add_numbered(scene, index++, sphere, 0.35f, 0.6f));
    promise.also(accelerates("rolling sphere, 5/7 g sin a", watched.size() - 1, incline.along() * 5 / 7));
    Body capsule;
    capsule.shape = Capsule{0.3f, 0.15f};
    capsule.orientation = turned({1, 0, 0}, 90 * degrees);  // axis across the incline
    watched.push_back(add_numbered(scene, index++, capsule, 0.3f, 0.6f));
    promise.also(accelerates("rolling capsule", watched.size() - 1, incline.along() * going_part(capsule)));
    const vec3 low(-8, 0, -5.2f), high(8.2f, 5.2f, 5.2f);
    return awake({std::move(scene), view_of(low, high, 38, 22), low, high, 3, std::move(promise).watching(watched)});
}

}  // namespace scree::demos
