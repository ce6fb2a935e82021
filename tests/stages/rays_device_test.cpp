// Rays cast on a device: the same bits as on the CPU, in every kind of scene and after edits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"
#include "tests/world/poisoned.h"

using namespace scree;

namespace {

// A world on a device that casts every batch itself.
struct CastingWorld {
    DeviceRunner* runner;
    World world;
    CastingWorld(const Scene& scene, const std::shared_ptr<host::Device>& device)
        : CastingWorld(scene, std::make_unique<DeviceRunner>(device)) {}
    // In which these bodies are beyond all scenes in the first step.
    CastingWorld(const Scene& scene, const std::shared_ptr<host::Device>& device, const std::vector<std::size_t>& lost)
        : CastingWorld(scene, std::make_unique<tests::Poisoned<DeviceRunner>>(lost, 1, 2e15f, device)) {}

private:
    CastingWorld(const Scene& scene, std::unique_ptr<DeviceRunner> made)
        : runner(made.get()), world(scene, {}, (made->cast_rays_from(1), std::move(made))) {}
};

std::vector<RayQuery> rays_around(const World& world, std::size_t count, std::uint32_t seed) {
    vec3 low(1e30f), high(-1e30f);
    for (const BodyState& body : world.bodies())
        if (body.exists) low = glm::min(low, body.position), high = glm::max(high, body.position);
    tests::Noise noise(seed);
    std::vector<RayQuery> rays;
    while (rays.size() < count) {
        RayQuery ray;
        ray.from = (low + high) * 0.5f + noise.vector() * ((high - low) * 0.5f + 2.0f);
        const vec3 along = noise.vector();
        if (glm::length(along) < 0.1f) continue;
        ray.along = glm::normalize(along);
        const std::size_t i = rays.size();
        if (i % 7 == 0) ray.along = {0, i % 2 ? 1.0f : -1.0f, 0};  // along an axis
        if (i % 5 == 0) ray.reach = 2 + noise();
        if (i % 3 == 0) ray.solid = false;
        if (i % 11 == 0) ray.mask = 6;
        rays.push_back(ray);
    }
    return rays;
}

bool same(const QueryHit& a, const QueryHit& b) {
    const auto bits = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    return a.body == b.body && a.part == b.part && bits(a.distance, b.distance) && bits(a.point, b.point) &&
           bits(a.normal, b.normal);
}

std::string told(const QueryHit& hit) {
    char text[200];
    std::snprintf(text, sizeof text, "body %zu part %u at %a, normal %a %a %a", hit.body, hit.part,
                  static_cast<double>(hit.distance), static_cast<double>(hit.normal.x), static_cast<double>(hit.normal.y),
                  static_cast<double>(hit.normal.z));
    return text;
}

// Returns the number of hits on the way.
std::size_t require_equal(const World& cpu, const World& there, const std::vector<RayQuery>& rays) {
    const auto nearest = cpu.cast_rays(rays), nearest_there = there.cast_rays(rays);
    const auto any = cpu.rays_hit(rays), any_there = there.rays_hit(rays);
    const auto all = cpu.cast_rays_through(rays), all_there = there.cast_rays_through(rays);
    REQUIRE(any == any_there);
    REQUIRE(all.starts == all_there.starts);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        INFO("ray " << i);
        REQUIRE(nearest[i].has_value() == nearest_there[i].has_value());
        if (!nearest[i]) continue;
        INFO(told(*nearest[i]) << " on the CPU, there " << told(*nearest_there[i]));
        REQUIRE(same(*nearest[i], *nearest_there[i]));
    }
    for (std::size_t k = 0; k < all.items.size(); ++k) REQUIRE(same(all.items[k], all_there.items[k]));
    return all.items.size();
}

}  // namespace

TEST_CASE("rays on a device meet what they meet on the CPU, to the bit, after steps, edits and breaking",
          "[vulkan][process:runs]") {
    Watched watched;
    Scene scene = tests::museum(120);
    Body sensor;
    sensor.shape = Box{vec3(3)};
    sensor.role = Role::sensor;
    sensor.motion = Motion::fixed;
    scene.bodies.push_back(sensor);
    for (std::size_t i = 2; i < 60; i += 3) scene.bodies[i].filter = Filter{static_cast<std::uint32_t>(1u << (i % 4)), ~0u, 0};
    World cpu(scene, {}, 2);
    CastingWorld there(scene, watched.device);
    std::size_t hits = require_equal(cpu, there.world, rays_around(cpu, 1500, 1));
    for (const int steps : {1, 20, 40}) {
        cpu.step(steps);
        there.world.step(steps);
        REQUIRE(cpu.state_hash() == there.world.state_hash());
        hits += require_equal(cpu, there.world, rays_around(cpu, 1500, 2));
        for (World* one : {&cpu, &there.world}) {
            one->remove_body(9 + static_cast<std::size_t>(steps));
            one->set_bodies(std::vector{BodyChange{4, vec3(0.5f, 3, 0.5f)}});
        }
        hits += require_equal(cpu, there.world, rays_around(cpu, 500, 3));
        for (World* one : {&cpu, &there.world}) {
            Body ball;
            ball.position = {1, 6, 1};
            Body cone;
            cone.shape = Cone{0.5f, 1};
            cone.position = {-1, 6, 1};
            Body hammer;
            hammer.shape = tests::hammer();
            hammer.position = {1, 8, -1};
            one->add_bodies(std::vector{ball, cone, hammer});
        }
        hits += require_equal(cpu, there.world, rays_around(cpu, 500, 4));
    }
    REQUIRE(hits > 4000);
}

TEST_CASE("rays on a device meet every shape, and nothing in an empty scene", "[vulkan][process:runs]") {
    Watched watched;
    Scene scene;
    const std::vector<Shape> shapes{Sphere{0.5f},         Capsule{0.3f, 0.4f}, Box{vec3(0.4f, 0.3f, 0.5f)},
                                    Cylinder{0.4f, 0.3f}, Cone{0.5f, 1},       Ellipsoid{vec3(0.6f, 0.3f, 0.4f)},
                                    tests::wedge(),       tests::hammer()};
    tests::Noise noise(5);
    for (std::size_t i = 0; i < 400; ++i) {
        Body body;
        body.shape = shapes[i % shapes.size()];
        body.position = noise.vector() * 4.0f;  // many in one another
        body.orientation = {noise(), noise(), noise(), 1.1f};
        scene.bodies.push_back(body);
    }
    World cpu(scene, {}, 1);
    CastingWorld there(scene, watched.device);
    REQUIRE(require_equal(cpu, there.world, rays_around(cpu, 8000, 6)) > 5000);
    CastingWorld empty(Scene{}, watched.device);
    REQUIRE_FALSE(empty.world.cast_rays(std::vector{RayQuery{}})[0]);
}

namespace {

// Bodies of one shape in a line along -z, and rays side by side along it.
Scene line_of(const Shape& shape, std::size_t count) {
    Scene scene;
    for (std::size_t i = 0; i < count; ++i) {
        Body body;
        body.shape = shape;
        body.position = {0, 0, -0.05f * static_cast<float>(i + 1)};
        body.motion = Motion::fixed;
        scene.bodies.push_back(body);
    }
    return scene;
}
std::vector<RayQuery> rays_beside(std::size_t count, float apart) {
    std::vector<RayQuery> rays(count);
    for (std::size_t i = 1; i < count; ++i) rays[i].from.x = apart * static_cast<float>(i);
    return rays;
}

}  // namespace

TEST_CASE("a ray through more bodies than a device's thread may visit is cast to the end", "[vulkan][process:runs]") {
    Watched watched;
    const Scene spheres = line_of(Sphere{0.01f}, 20000);
    World cpu(spheres, {}, 1);
    CastingWorld there(spheres, watched.device);
    REQUIRE(require_equal(cpu, there.world, rays_beside(9, 0.003f)) == 4 * 20000);
    // The largest hulls take the most rounds each.
    Hull ball;
    tests::Noise noise(3);
    while (ball.points.size() < 64)
        if (const vec3 point = noise.vector(); glm::length(point) > 0.1f) ball.points.push_back(glm::normalize(point) * 0.02f);
    const Scene hulls = line_of(ball, 600);
    World hulls_on_cpu(hulls, {}, 1);
    CastingWorld hulls_there(hulls, watched.device);
    REQUIRE(hulls_on_cpu.scene().bodies.size() == 600);
    REQUIRE(require_equal(hulls_on_cpu, hulls_there.world, rays_beside(16, 0.001f)) == 16 * 600);
    Scene planes;
    for (int i = 0; i < 9000; ++i) {
        Body plane;
        plane.shape = Plane{vec3(0, 0, 1), -0.01f * static_cast<float>(i)};
        plane.motion = Motion::fixed;
        planes.bodies.push_back(plane);
    }
    World planes_on_cpu(planes, {}, 1);
    CastingWorld planes_there(planes, watched.device);
    std::vector<RayQuery> above = rays_beside(9, 1);
    for (RayQuery& ray : above) ray.from.z = 1;
    REQUIRE(require_equal(planes_on_cpu, planes_there.world, above) == 9 * 9000);
}

TEST_CASE("more hits than a device lists at once are listed all the same", "[vulkan][process:runs]") {
    Watched watched;
    const Scene scene = line_of(Sphere{0.02f}, 1500);
    World cpu(scene, {}, 2);
    CastingWorld there(scene, watched.device);
    const std::vector<RayQuery> rays = rays_beside(1000, 1e-5f);
    const auto all = cpu.cast_rays_through(rays), all_there = there.world.cast_rays_through(rays);
    REQUIRE(all.items.size() == 1500 * 1000);
    REQUIRE(all.starts == all_there.starts);
    REQUIRE(std::equal(all.items.begin(), all.items.end(), all_there.items.begin(), same));
}

TEST_CASE("rays on a device follow bodies reordered in memory, buffers that grow, states brought back and quarantine",
          "[vulkan][process:runs]") {
    Watched watched;
    Scene scene = tests::heap(300);
    for (const float x : {40.0f, 42.0f}) {
        scene.bodies.push_back(scene.bodies.back());
        scene.bodies.back().position = {x, 20, 0};
    }
    const std::vector<std::size_t> lost{301, 302};
    World cpu(scene, {}, std::make_unique<tests::Poisoned<ReferenceRunner>>(lost, 1, 2e15f, 2));
    CastingWorld there(scene, watched.device, lost);
    const auto both = [&](const auto& act) { act(cpu), act(there.world); };
    const auto compare = [&](std::uint32_t seed) {
        REQUIRE(cpu.state_hash() == there.world.state_hash());
        return require_equal(cpu, there.world, rays_around(cpu, 600, seed));
    };
    both([](World& one) { one.step(10); });
    REQUIRE_FALSE(cpu.quarantines().empty());
    REQUIRE(compare(1) > 100);
    there.world.reorder();
    both([](World& one) { one.step(10); });
    REQUIRE(there.world.reorderings() == 1);
    REQUIRE(compare(2) > 100);
    both([](World& one) { one.keep_state(); });
    const std::vector<std::byte> mark = cpu.save();
    std::vector<Body> many = tests::heap(1500, 7).bodies;
    std::erase_if(many, [](const Body& body) { return body.motion == Motion::fixed; });
    for (Body& body : many) body.position += vec3(0, 40, 0);
    both([&](World& one) { one.add_bodies(many); });
    REQUIRE(compare(3) > 100);
    both([](World& one) { one.step(3); });
    REQUIRE(compare(4) > 100);
    both([](World& one) { one.roll_back(3); });
    REQUIRE(compare(5) > 100);
    both([](World& one) { one.step(40); });
    REQUIRE(compare(6) > 100);
    both([&](World& one) { one.restore(mark); });
    REQUIRE(compare(7) > 100);
}

TEST_CASE("a device leaves few rays, and those of copies of a scene, to the host", "[vulkan][process:runs]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    World world(tests::heap(50), {}, make_device_runner(device));
    REQUIRE_FALSE(world.runner().casts(1));
    auto made = std::make_unique<DeviceRunner>(device);
    made->cast_rays_from(1);
    World copies(tests::heap(20), {}, std::move(made), 3);
    REQUIRE_FALSE(copies.runner().casts(1000));
    World cpu(tests::heap(20), {}, 1);
    std::vector<RayQuery> rays = rays_around(cpu, 200, 7);
    for (RayQuery& ray : rays) ray.copy = 2;
    const auto hits = copies.cast_rays(rays);
    for (RayQuery& ray : rays) ray.copy = 0;
    const auto alone = cpu.cast_rays(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) REQUIRE(hits[i].has_value() == alone[i].has_value());
}
