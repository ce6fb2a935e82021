// Meshes of machines.
#include "tests/world/machines.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace scree::tests {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Body moving(Mesh mesh) {
    Body body;
    body.motion = Motion::kinematic;
    body.shape = std::move(mesh);
    return body;
}

void move(Scene& scene, std::size_t first, vec3 by) {
    for (std::size_t i = first; i < scene.bodies.size(); ++i) scene.bodies[i].position += by;
}

Body wall_at(vec3 normal, float offset, float friction) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{normal, offset};
    body.friction = friction;
    return body;
}

}  // namespace

Mesh swept(const std::vector<glm::vec2>& profile, int sides, float turns, float pitch) {
    Mesh mesh;
    const int rows = static_cast<int>(std::lround(turns * static_cast<float>(sides)));
    const bool closes = pitch == 0;
    const auto width = static_cast<std::uint32_t>(profile.size());
    for (int k = 0; k < (closes ? rows : rows + 1); ++k) {
        const float turn = static_cast<float>(k) / static_cast<float>(sides);
        for (const glm::vec2 point : profile)
            mesh.vertices.emplace_back(point.x * std::cos(2 * pi * turn), point.y + pitch * turn,
                                       point.x * std::sin(2 * pi * turn));
    }
    for (int k = 0; k < rows; ++k)
        for (std::uint32_t i = 0; i + 1 < width; ++i) {
            const auto here = static_cast<std::uint32_t>(k) * width,
                       next = static_cast<std::uint32_t>(closes ? (k + 1) % rows : k + 1) * width;
            mesh.triangles.emplace_back(here + i, next + i, next + i + 1);
            mesh.triangles.emplace_back(here + i, next + i + 1, here + i + 1);
        }
    return mesh;
}

Mesh grating(int holes, float hole, float bar, float thickness) {
    Mesh mesh;
    const int cells = 2 * holes + 1;
    const float half = 0.5f * (static_cast<float>(holes) * (hole + bar) + bar);
    const auto edge = [&](int i) {
        const auto pairs = static_cast<float>(i / 2);
        return pairs * (hole + bar) + (i % 2 != 0 ? bar : 0.0f) - half;
    };
    const auto solid = [&](int i, int k) { return i >= 0 && k >= 0 && i < cells && k < cells && (i % 2 == 0 || k % 2 == 0); };
    const auto face = [&](vec3 a, vec3 b, vec3 c, vec3 d) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const vec3 corner : {a, b, c, d}) mesh.vertices.push_back(corner);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    };
    const float up = 0.5f * thickness;
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
            if (!solid(i, k)) continue;
            const float x0 = edge(i), x1 = edge(i + 1), z0 = edge(k), z1 = edge(k + 1);
            face({x0, up, z0}, {x0, up, z1}, {x1, up, z1}, {x1, up, z0});
            face({x0, -up, z0}, {x1, -up, z0}, {x1, -up, z1}, {x0, -up, z1});
            if (!solid(i - 1, k)) face({x0, -up, z0}, {x0, -up, z1}, {x0, up, z1}, {x0, up, z0});
            if (!solid(i + 1, k)) face({x1, -up, z0}, {x1, up, z0}, {x1, up, z1}, {x1, -up, z1});
            if (!solid(i, k - 1)) face({x0, -up, z0}, {x0, up, z0}, {x1, up, z0}, {x1, -up, z0});
            if (!solid(i, k + 1)) face({x0, -up, z1}, {x1, -up, z1}, {x1, up, z1}, {x0, up, z1});
        }
    return mesh;
}

Body drum(float radius, float length, float spin) {
    const float half = 0.5f * length, quarter = std::sqrt(0.5f);
    Body body = moving(swept({{0, -half}, {radius, -half}, {radius, half}, {0, half}}, 40));
    body.orientation = {quarter, 0, 0, quarter};  // y to z
    body.angular_velocity = {0, 0, spin};
    body.friction = 0.8f;
    return body;
}

void add_balls(Scene& scene, std::size_t count, float radius, vec3 lower, vec3 upper) {
    const float step = 2.05f * radius;
    vec3 at = lower + vec3(radius);
    for (std::size_t i = 0; i < count; ++i) {
        Body ball;
        ball.shape = Sphere{radius};
        ball.position = at;
        ball.friction = 0.5f;
        ball.density = 2500;
        scene.bodies.push_back(ball);
        at.x += step;
        if (at.x > upper.x - radius) at.x = lower.x + radius, at.z += step;
        if (at.z > upper.z - radius) at.z = lower.z + radius, at.y += step;
    }
}

Sieve add_sieve(Scene& scene, std::size_t small, std::size_t large) {
    Sieve sieve;
    const float half = 0.5f * (Sieve::holes * (Sieve::hole + Sieve::bar) + Sieve::bar) + 0.01f, top = Sieve::height + 0.1f;
    for (const vec3 normal : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
        scene.bodies.push_back(wall_at(normal, -half, 0.2f));
    scene.bodies.push_back(wall_at({0, 1, 0}, 0, 0.5f));
    sieve.plate = scene.bodies.size();
    scene.bodies.push_back(moving(grating(Sieve::holes, Sieve::hole, Sieve::bar, Sieve::thickness)));
    scene.bodies.back().position = {0, Sieve::height, 0};
    scene.bodies.back().friction = 0.3f;
    sieve.first_large = scene.bodies.size();
    add_balls(scene, large, 0.065f, {-half, top, -half}, {half, 9, half});
    sieve.first_small = scene.bodies.size();
    add_balls(scene, small, 0.03f, {-half, top + 0.4f, -half}, {half, 9, half});
    sieve.end = scene.bodies.size();
    return sieve;
}

Scene screw(float pitch, float spin) {
    Scene scene;
    const float diagonal = std::sqrt(0.5f);
    for (const float side : {-diagonal, diagonal}) scene.bodies.push_back(wall_at({0, diagonal, side}, 0, 0));
    constexpr float thin = 0.01f;
    Body turning = moving(swept({{0.02f, -thin}, {0.02f, thin}, {0.2f, thin}, {0.2f, -thin}, {0.02f, -thin}}, 24, 6, pitch));
    turning.orientation = {0, 0, -diagonal, diagonal};  // y to x
    turning.position = {0, 0.22f, 0};
    turning.angular_velocity = {spin, 0, 0};
    turning.friction = 0;
    scene.bodies.push_back(turning);
    Body ball;
    ball.shape = Sphere{0.05f};
    ball.friction = 0;
    ball.linear_damping = 3;  // so that it does not outrun the face that pushes it
    ball.position = {(spin > 0 ? 1.25f : 4.75f) * pitch, 0.071f, 0};
    scene.bodies.push_back(ball);
    return scene;
}

Body cone(float spin) {
    Body body = moving(swept({{0, 0}, {0.5f, 0.5f}, {0.5f, 1.5f}}, 32));
    body.angular_velocity = {0, spin, 0};
    body.friction = 0.6f;
    return body;
}

Scene machines() {
    Scene scene;
    add_sieve(scene, 12, 6);  // its walls bound nothing else: the others have none
    scene.bodies.erase(scene.bodies.begin(), scene.bodies.begin() + 4);
    std::size_t first = scene.bodies.size();
    scene.bodies.push_back(drum(0.4f, 0.3f, 1.5f));
    add_balls(scene, 20, 0.04f, {-0.2f, -0.25f, -0.15f}, {0.2f, 0.3f, 0.15f});
    move(scene, first, {3, 1, 0});
    first = scene.bodies.size();
    scene.bodies.push_back(cone(2));
    add_balls(scene, 20, 0.04f, {-0.15f, 0.3f, -0.15f}, {0.15f, 1, 0.15f});
    move(scene, first, {-3, 0.2f, 0});
    first = scene.bodies.size();
    Scene pushing = screw(0.2f, 3);
    pushing.bodies.erase(pushing.bodies.begin(), pushing.bodies.begin() + 2);
    scene.bodies.insert(scene.bodies.end(), pushing.bodies.begin(), pushing.bodies.end());
    move(scene, first, {0, 0, 3});
    return scene;
}

}  // namespace scree::tests
