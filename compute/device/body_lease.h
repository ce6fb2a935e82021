// Leases: the tables of bodies on a device, for a program that draws or computes with them on the device, without a copy.
//
//     const BodyLease bodies = lease_bodies(world.runner());
//     // Command buffers that read them wait for bodies.ready to reach bodies.ready_value, and bring a timeline semaphore
//     // of the program to a value when they have ended:
//     return_bodies(world.runner(), semaphore, value);  // the next step waits for that, on the device
#pragma once

#include <cstdint>

#include "compute/runner.h"
#include "host/vulkan/device.h"

namespace scree {

// Records of `stride` bytes, one for each row, `bytes` in all from `offset` of a buffer (storage, vertex, transfer).
struct LeasedTable {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, bytes = 0;
    std::uint32_t stride = 0;  // bytes
};

// The state after the last step. Body `i` has the row World::row_of(i). Read only: the next step goes on from it.
struct BodyLease {
    LeasedTable positions;               // 3 floats, m: of the centres of mass
    LeasedTable orientations;            // 4 floats: unit quaternion x, y, z, w
    LeasedTable velocities;              // 3 floats, m/s
    LeasedTable angular_velocities;      // 3 floats, rad/s, world axes
    std::uint32_t rows = 0;              // with those of fragments and parts
    VkSemaphore ready = VK_NULL_HANDLE;  // a timeline semaphore of the runner, which every step brings to a higher value
    std::uint64_t ready_value = 0;       // when the tables are as of the last step
    // Rises whenever a buffer was made anew or tables have moved in it, because they grew: what names them is to be made anew.
    std::uint64_t generation = 0;
};

// Throws std::invalid_argument for a runner that is not on a device, host::DeviceError if the device has no timeline
// semaphores. Steps after the first call signal the semaphore.
BodyLease lease_bodies(Runner& runner);
// What the program has submitted reads the tables until `timeline` reaches `value`: the next step begins after that, on the
// device, and buffers live until then. Of several returns before a step the last one counts. Throws like lease_bodies.
void return_bodies(Runner& runner, VkSemaphore timeline, std::uint64_t value);

}  // namespace scree
