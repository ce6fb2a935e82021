// The heap and the swarm.
#include "tests/world/heaps.h"

#include <cmath>

namespace scree::tests {

namespace {

Body some_body(int i, float size, Noise& noise) {
    Body body;
    if (i % 3 == 0) body.shape = Box{vec3(size, 0.8f * size, 1.1f * size)};
    if (i % 3 == 1) body.shape = Sphere{size};
    if (i % 3 == 2) body.shape = Capsule{0.6f * size, 0.5f * size};
    body.orientation = vec4(noise.vector(), 1.1f);
    return body;
}

}  // namespace

Scene heap(int count, std::uint32_t seed) {
    Noise noise(seed);
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    const int side = std::max(1, static_cast<int>(std::cbrt(static_cast<float>(count))));
    for (int i = 0; i < count; ++i) {
        Body body = some_body(i, 0.3f + 0.15f * noise(), noise);
        body.restitution = i % 5 == 0 ? 0.5f : 0;
        body.rolling_resistance = i % 7 == 0 ? 0.01f : 0;
        const vec3 cell(i % side, i / (side * side), i / side % side);
        body.position = cell * 1.4f + noise.vector() * 0.05f + vec3(0, 0.9f, 0);
        scene.bodies.push_back(body);
    }
    return scene;
}

Scene swarm(int count, float restitution, std::uint32_t seed) {
    Noise noise(seed);
    Scene scene;
    scene.gravity = vec3(0);
    const int side = std::max(1, static_cast<int>(std::ceil(std::cbrt(static_cast<float>(count)))));
    for (int i = 0; i < count; ++i) {
        Body body = some_body(i, 0.4f + 0.1f * noise(), noise);
        const vec3 cell(i % side, i / (side * side), i / side % side);
        body.position = (cell - vec3(0.5f * static_cast<float>(side - 1))) * 1.6f;
        body.velocity = body.position * -0.5f + noise.vector() * 2.0f;
        body.angular_velocity = noise.vector() * 3.0f;
        body.restitution = restitution;
        scene.bodies.push_back(body);
    }
    return scene;
}

}  // namespace scree::tests
