// Scenes for tests of whole worlds.
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

// A sphere, capsule or box of extent 2 * half in every direction.
Body even_body(int i, float half) {
    Body body;
    if (i % 3 == 0) body.shape = Box{vec3(half)};
    if (i % 3 == 1) body.shape = Sphere{half};
    if (i % 3 == 2) body.shape = Capsule{0.6f * half, 0.4f * half};
    return body;
}

}  // namespace

Body ground() {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{};
    return body;
}

Scene heap(int count, std::uint32_t seed) {
    Noise noise(seed);
    Scene scene;
    scene.bodies.push_back(ground());
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

// Without restitution and rolling resistance.
static Scene plain_heap(int count, std::uint32_t seed) {
    Scene scene = heap(count, seed);
    for (Body& body : scene.bodies) body.restitution = body.rolling_resistance = 0;
    return scene;
}

Scene laden_heap(int count, std::uint32_t seed) {
    Scene scene = plain_heap(count, seed);
    for (std::size_t i = 0; i < scene.bodies.size(); i += 8) scene.bodies[i].density *= 300;
    return scene;
}

Scene brittle_heap(int count, std::uint32_t seed) {
    Scene scene = plain_heap(count, seed);
    for (Body& body : scene.bodies)
        if (std::holds_alternative<Box>(body.shape)) body.fracture = Fracture{.impulse = 60, .pieces = 4};
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

Scene packed(int count, std::uint32_t seed) {
    constexpr float half = 0.4f, spacing = 2 * half - 0.002f;
    Noise noise(seed);
    Scene scene;
    scene.bodies.push_back(ground());
    const int side = std::max(1, static_cast<int>(std::cbrt(static_cast<float>(count))));
    for (int i = 0; i < count; ++i) {
        Body body = even_body(i, half);
        const vec3 cell(i % side, i / (side * side), i / side % side);
        body.position = cell * spacing + noise.vector() * 0.001f + vec3(0, half - 0.002f, 0);
        body.friction = 0.4f + 0.2f * noise();
        body.rolling_resistance = i % 7 == 0 ? 0.01f : 0;
        scene.bodies.push_back(body);
    }
    return scene;
}

Scene apart(int count, float height, std::uint32_t seed) {
    Noise noise(seed);
    Scene scene;
    scene.bodies.push_back(ground());
    const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
    for (int i = 0; i < count; ++i) {
        const float half = 0.3f + 0.1f * noise();
        Body body = even_body(i, half);
        body.position = vec3(1.8f * static_cast<float>(i % side), half + height, 1.8f * static_cast<float>(i / side));
        scene.bodies.push_back(body);
    }
    return scene;
}

}  // namespace scree::tests
