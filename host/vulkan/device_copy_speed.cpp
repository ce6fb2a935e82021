// Copy bandwidth between buffers of a device.
#include <algorithm>
#include <chrono>

#include "host/copy_speed.h"
#include "host/vulkan/command_buffer.h"

namespace scree::host {

double device_copy_speed(const std::shared_ptr<Device>& device) {
    const std::size_t bytes = std::min<std::size_t>(std::size_t{128} << 20, device->report().largest_binding);
    const Buffer from(device, "copied_from", bytes), to(device, "copied_to", bytes);
    constexpr int copies = 6;
    double best = 0;
    CommandBuffer commands(device, copies + 1);
    commands.timestamp();
    for (int i = 0; i < copies; ++i) {
        commands.copy(from, to, bytes);
        commands.barrier();
        commands.timestamp();
    }
    commands.end();
    const auto start = std::chrono::steady_clock::now();
    device->submit_and_wait({commands.handle()});
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const double seconds : commands.timestamp_seconds())
        if (seconds > 0) best = std::max(best, 2 * static_cast<double>(bytes) / seconds);
    return best > 0 ? best : 2 * static_cast<double>(bytes) * copies / whole;
}

}  // namespace scree::host
