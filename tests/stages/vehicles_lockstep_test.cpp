// Vehicles in lockstep: equal bits on device and CPU, driven by the user or by routes.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/vehicle_presets.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"

using namespace scree;

TEST_CASE("cars that brake, drift, follow a route, turn on the spot and sleep give the same bits on both processors",
          "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    const auto controlled = [&](std::size_t vehicle, const Controls& controls) { scene.vehicles[vehicle].controls = controls; };
    controlled(add_car(scene, {.position = {0, 0, 0}, .speed = 12}), {.brake = 1, .steer = 0.5f});
    controlled(add_car(scene, {.position = {6, 0, 0}, .speed = 10}), {.throttle = 1, .steer = -1});
    controlled(add_car(scene, {.position = {12, 0, 0}}), {.hand_brake = 1});
    controlled(add_cart(scene, {.position = {18, 0, 0}}), {.throttle = 0.5f, .steer = 0.6f});
    const std::size_t routed = add_car(scene, {.position = {-6, 0, 0}, .heading = 0.3f, .speed = 6});
    scene.vehicles[routed].route = {{{-6, 0, 0}, 6}, {{-5, 0, 4}, 8}, {{-8, 0, 8}, 3}};
    Settings settings = tests::coarse();
    settings.sleep_time = 0.2f;
    settings.pairs_at_first = 40;  // so that the first step overflows and is repeated
    Lockstep lockstep(scene, settings, device, 2);
    for (int i = 0; i < 60 && lockstep.step(); ++i) continue;
    tests::require_equal(lockstep.result());
}

TEST_CASE("a brake that is let go and pulled again gives the same bits on both processors", "[process:kinds]") {
    // Wheels that are not driven have no motor between: the CPU path went on adding the last change to its impulse.
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    add_car(scene, {.speed = 1});
    const Watched watched;
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(watched.device));
    for (int step = 0; step < 40; ++step) {
        for (World* world : {&cpu, &there}) {
            if (step % 10 == 0) world->drive(0, {.brake = step % 20 == 0 ? 1.0f : 0.0f});
            world->step();
        }
        CAPTURE(step);
        REQUIRE(cpu.state_hash() == there.state_hash());
    }
}
