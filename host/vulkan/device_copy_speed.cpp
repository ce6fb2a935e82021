// Copy bandwidth between buffers of a device: the better of its copy command and a shader.
#include <algorithm>
#include <chrono>

#include "host/copy_speed.h"
#include "host/vulkan/command_buffer.h"
#include "shaders/embedded.h"

namespace scree::host {

double device_copy_speed(const std::shared_ptr<Device>& device) {
    // Larger than the caches: those of servers' GPUs hold 50 MB and more.
    const std::size_t wanted = std::size_t{device->report().is_processor ? 128u : 512u} << 20;
    const std::size_t bytes =
        std::min<std::size_t>({wanted, device->report().largest_binding, device->report().memory_bytes / 8});
    const Buffer from(device, "copied_from", bytes), to(device, "copied_to", bytes);
    constexpr int copies = 6;
    constexpr std::uint32_t threads = 128;
    const auto layout = std::make_shared<BindingSetLayout>(device, 2, 0);
    const Pipeline pipeline(layout, "copy_quads", shaders::find("copy_quads.query"), {threads});
    const BindingSet buffers(layout, {&from, &to});
    const std::size_t groups =
        std::min<std::size_t>(bytes / 16 / threads, std::min(device->limits().maxComputeWorkGroupCount[0], 1u << 20));
    CommandBuffer commands(device, 2 * copies + 1);
    commands.timestamp();
    for (int i = 0; i < copies; ++i) {
        commands.copy(from, to, bytes);
        commands.barrier();
        commands.timestamp();
        commands.bind(pipeline, buffers);
        commands.dispatch(static_cast<std::uint32_t>(groups));
        commands.barrier();
        commands.timestamp();
    }
    commands.end();
    const auto start = std::chrono::steady_clock::now();
    device->submit_and_wait({commands.handle()});
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double best = 0;
    for (const double seconds : commands.timestamp_seconds())
        if (seconds > 0) best = std::max(best, 2 * static_cast<double>(bytes) / seconds);
    return best > 0 ? best : 2 * static_cast<double>(bytes) * 2 * copies / whole;
}

}  // namespace scree::host
