// The book's example of a device that the program owns (demos/docs/guide/threads.md) compiles; tests/host/vulkan runs such
// devices.
#include <cstdint>
#include <mutex>

#include "compute/device/body_lease.h"
#include "compute/device/make_device_runner.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "host/vulkan/host_device.h"

namespace {

// What a program does with the tables.
template <class Draw>
[[maybe_unused]] void as_in_the_guide(VkInstance instance, VkPhysicalDevice gpu, VkDevice device, VkQueue queue,
                                      std::uint32_t family, const VkDeviceCreateInfo& device_create_info, std::mutex& queue_mutex,
                                      const scree::Scene& scene, const scree::Settings& settings, VkSemaphore done,
                                      std::uint64_t frame, std::uint64_t drawn_generation, const Draw& submit_drawing,
                                      void (*describe_buffers_again)(const scree::BodyLease&)) {
    const scree::host::HostDevice mine{.instance = instance,  // host/vulkan/host_device.h
                                       .physical = gpu,
                                       .device = device,
                                       .queue = queue,
                                       .queue_family = family,
                                       .made_with = &device_create_info,
                                       .queue_mutex = &queue_mutex};
    scree::World world(scene, settings, scree::make_device_runner(scree::host::Device::adopt(mine)));
    world.step();
    const scree::BodyLease bodies = scree::lease_bodies(world.runner());        // compute/device/body_lease.h
    if (bodies.generation != drawn_generation) describe_buffers_again(bodies);  // they have grown
    submit_drawing(bodies.ready, bodies.ready_value, done, ++frame);            // waits for the step, brings `done` to `frame`
    scree::return_bodies(world.runner(), done, frame);                          // the next step waits for it, on the device
}

using Drawing = void (*)(VkSemaphore, std::uint64_t, VkSemaphore, std::uint64_t);
[[maybe_unused]] const auto compiled = &as_in_the_guide<Drawing>;

}  // namespace
