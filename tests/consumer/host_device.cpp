// A Vulkan device of the program's own: scree steps on it, and leases its tables; prints "ok", or what is wrong.
#include <scree/compute/device/body_lease.h>
#include <scree/compute/device/make_device_runner.h>
#include <scree/compute/world.h>
#include <scree/host/vulkan/host_device.h>

#include <cstdio>
#include <exception>

int main() {
    scree::Scene scene;
    scene.bodies.push_back({.motion = scree::Motion::fixed, .shape = scree::Plane{}});
    scene.bodies.push_back({.shape = scree::Sphere{0.5f}, .position = {0, 3, 0}});
    try {
        scree::World world(scene, {}, scree::make_device_runner(scree::host::Device::open())), on_cpu(scene);
        world.step(60);
        on_cpu.step(60);
        const scree::BodyLease bodies = scree::lease_bodies(world.runner());
        const bool right = world.state_hash() == on_cpu.state_hash() && bodies.positions.buffer && bodies.rows == 2;
        std::printf(right ? "ok\n" : "the device has other bits, or no tables\n");
        return right ? 0 : 1;
    } catch (const scree::host::DeviceError& error) {
        std::printf("ok: no device here: %s\n", error.what());
    }
    try {
        scree::host::Device::adopt({});
    } catch (const scree::host::DeviceError&) {
        return 0;
    }
    std::printf("a device that is none was adopted\n");
    return 1;
}
