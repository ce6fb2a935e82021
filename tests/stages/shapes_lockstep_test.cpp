// Lockstep of every stage on device and CPU, with all shapes mixed.
#include <catch2/catch.hpp>
#include <random>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/plan/memory_traffic.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors for cylinders, cones and hulls among all other shapes",
          "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    std::mt19937 chance(5);
    const auto any = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(chance); };
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].motion = Motion::fixed;
    scene.bodies[0].shape = Plane{};
    std::vector<Hull> hulls(3);
    for (Hull& hull : hulls)
        for (int k = 0; k < 20; ++k) hull.points.push_back({any(-0.4f, 0.4f), any(-0.4f, 0.4f), any(-0.4f, 0.4f)});
    for (int k = 0; k < 90; ++k) {
        const Shape shapes[] = {Cylinder{0.3f, any(0.1f, 0.4f)},
                                Cone{0.3f, any(0.4f, 0.8f)},
                                hulls[static_cast<std::size_t>(k) % 3],
                                Sphere{0.3f},
                                Capsule{0.2f, 0.2f},
                                Box{{0.3f, 0.2f, 0.25f}}};
        Body& body = scene.bodies.emplace_back();
        body.shape = shapes[k % 6];
        body.position = {any(-1, 1), 0.3f + 0.25f * static_cast<float>(k), any(-1, 1)};
        body.orientation = {any(-1, 1), any(-1, 1), any(-1, 1), any(0.1f, 1)};
        body.velocity = {0, k % 7 == 0 ? -40.0f : -1.0f, 0};
    }
    tests::require_equal(compare_in_lockstep(scene, tests::coarse(), device, 1, 40));
}

TEST_CASE("hulls that touch in thousands of ways come out alike on both processors", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    std::mt19937 chance(8);
    const auto any = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(chance); };
    const auto any_turn = [&] { return vec4{any(-1, 1), any(-1, 1), any(-1, 1), any(0.1f, 1)}; };
    for (const int corners : {6, 8, 12, 32}) {
        Hull hull;
        for (int k = 0; k < corners; ++k) {
            const vec3 way{any(-1, 1), any(-1, 1), any(-1, 1)};
            hull.points.push_back(0.5f * glm::normalize(way));
        }
        Scene scene;
        scene.gravity = vec3(0);
        for (int k = 0; k < 2000; ++k) {
            Body first, second;
            first.motion = Motion::kinematic;
            first.shape = second.shape = hull;
            first.position = 3.0f * vec3(k % 13, k / 13 % 13, k / 169);
            first.orientation = any_turn();
            const float apart = any(0.4f, 0.95f);
            second.position = first.position + apart * glm::normalize(vec3{any(-1, 1), any(-1, 1), any(0.1f, 1)});
            second.orientation = any_turn();
            scene.bodies.push_back(first);
            scene.bodies.push_back(second);
        }
        const LockstepResult result = compare_in_lockstep(scene, tests::coarse(), device, 1, 1);
        INFO(corners << " corners: step " << result.step << ", stage " << result.stage << ", " << result.buffer << "["
                     << result.element << "], " << result.detail);
        REQUIRE(result.equal);
    }
}

TEST_CASE("a step is said to move as many bytes on the device as on the processor", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    for (const bool solids : {false, true}) {
        Scene scene = tests::packed(40);
        if (solids) scene.bodies.back().shape = Hull{.points = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
        World there(scene, tests::coarse(), make_device_runner(device)), here(scene, tests::coarse(), 1);
        there.step(3);
        here.step(3);
        const std::vector<Traffic> a = traffic_of(there.state()), b = traffic_of(here.state());
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(a[i].stage);
            CHECK(a[i].read == b[i].read);
            CHECK(a[i].written == b[i].written);
        }
    }
}
