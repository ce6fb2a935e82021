// Lockstep of every stage on device and CPU, with ellipsoids among all other shapes.
#include <catch2/catch.hpp>
#include <random>

#include "compute/device/lockstep.h"
#include "host/vulkan/device.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors for ellipsoids among all other shapes, on planes and on triangles",
          "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    for (const bool rough : {false, true}) {
        std::mt19937 chance(rough ? 6 : 5);
        const auto any = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(chance); };
        Scene scene;
        scene.bodies.resize(1);
        scene.bodies[0].motion = Motion::fixed;
        scene.bodies[0].shape = Plane{};
        if (rough) {
            HeightField ground{.columns = 12, .rows = 12, .spacing = 0.6f};
            for (int k = 0; k < 144; ++k) ground.heights.push_back(any(0, 0.5f));
            scene.bodies[0].shape = ground;
        }
        Hull hull;
        for (int k = 0; k < 20; ++k) hull.points.push_back({any(-0.4f, 0.4f), any(-0.4f, 0.4f), any(-0.4f, 0.4f)});
        for (int k = 0; k < 90; ++k) {
            const Ellipsoid stone{{any(0.1f, 0.4f), any(0.1f, 0.4f), any(0.1f, 0.4f)}};
            const Shape shapes[] = {stone,
                                    Cylinder{0.3f, any(0.1f, 0.4f)},
                                    stone,
                                    Cone{0.3f, any(0.4f, 0.8f)},
                                    hull,
                                    Sphere{0.3f},
                                    Capsule{0.2f, 0.2f},
                                    Box{{0.3f, 0.2f, 0.25f}},
                                    Compound{{{stone, {-0.2f, 0, 0}}, {Ellipsoid{{0.2f, 0.3f, 0.15f}}, {0.25f, 0.1f, 0}}}}};
            Body& body = scene.bodies.emplace_back();
            body.shape = shapes[k % 9];
            body.position = {any(-1, 1), 0.9f + 0.25f * static_cast<float>(k), any(-1, 1)};
            body.orientation = {any(-1, 1), any(-1, 1), any(-1, 1), any(0.1f, 1)};
            body.velocity = {0, k % 7 == 0 ? -40.0f : -1.0f, 0};
        }
        tests::require_equal(compare_in_lockstep(scene, tests::coarse(), device, 1, 40));
    }
}
