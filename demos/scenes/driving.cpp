// Helpers for vehicle demos.
#include "demos/scenes/driving.h"

#include <algorithm>

#include "demos/scenes/scene_builder.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// The y axis of a chassis in the world.
vec3 up_of(const BodyState& body) {
    return physics::rotate(body.orientation, vec3(0, 1, 0));
}

}  // namespace

Body wedge(vec3 position, float width, float length, float rise, float heading) {
    Body body;
    body.motion = Motion::fixed;
    body.friction = 1;
    const float w = width / 2;
    body.shape = Hull{{{-w, -0.2f, 0},
                       {w, -0.2f, 0},
                       {-w, 0, 0},
                       {w, 0, 0},
                       {-w, -0.2f, length},
                       {w, -0.2f, length},
                       {-w, rise, length},
                       {w, rise, length}}};
    body.position = position;
    body.orientation = turned({0, 1, 0}, heading);
    return body;
}

void turn_vehicle(Scene& scene, std::size_t vehicle, vec3 pivot, vec4 turn) {
    const auto move = [&](Body& body) {
        body.position = pivot + physics::rotate(turn, body.position - pivot);
        body.orientation = physics::compose(turn, body.orientation);
    };
    move(scene.bodies[scene.vehicles[vehicle].chassis]);
    for (const Wheel& wheel : scene.vehicles[vehicle].wheels) move(scene.bodies[scene.joints[wheel.joint].b]);
}

Claim all_upright(const std::string& what, Indices chassis) {
    return at_least("upright: " + what, 0.9, "", "the least cosine between a chassis and the vertical, at the end",
                    [chassis](const Trace& trace) {
                        double least = 1;
                        for (const std::size_t body : chassis)
                            least = std::min(least, static_cast<double>(up_of(trace.end[body]).y));
                        return least;
                    });
}

}  // namespace scree::demos
