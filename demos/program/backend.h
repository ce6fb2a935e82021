// The simulation backend: a Vulkan device or the CPU.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/runner.h"
#include "compute/scene.h"
#include "demos/program/options/options.h"
#include "host/canvas/canvas.h"

namespace scree::host {
class Device;
}

namespace scree::demos {

struct PipelineFigures {
    std::string stage;
    std::vector<std::pair<std::string, double>> figures;  // such as registers of a thread
};

struct Backend {
    MachineOptions options;
    std::shared_ptr<host::Device> device;            // null for the CPU
    std::string remark;                              // reason for an unexpected choice; may be empty
    std::shared_ptr<host::Device> screen = nullptr;  // the device that presents a window; null unless requested

    std::unique_ptr<Runner> make_runner() const;
    std::unique_ptr<Runner> make_runner(std::shared_ptr<Exchange> exchange) const;  // of a rank
    std::string driver() const;   // of the device, with its version; empty: the CPU
    bool draws() const;           // whether it is a device with graphics
    bool has_own_memory() const;  // whether it is a device whose memory is not this process's
    // Where the device's arithmetic gives other bits than the CPU's (compute/device/arithmetic_check.h); empty: nowhere.
    std::string arithmetic_fault() const;
    // What the driver tells of each stage's pipeline, in its words; empty: nothing, or not asked for (MachineOptions::pipelines).
    std::vector<PipelineFigures> pipelines(Runner& runner) const;
    double copy_speed() const;  // bytes per second, reads plus writes (host/copy_speed.h); takes a moment
    // Throws WorkFailed with the validation layers' messages, if there are any.
    void require_valid() const;
};

// Throws host::DeviceError when the requested backend or device does not exist, or when no device can present with
// `window_extensions` (host::Display::extensions; empty without a window).
enum class Choice {
    fastest,   // default: a GPU, else a software device or the CPU, whichever measures faster
               // (demos/program/backend_timing.h)
    a_device,  // default: a device, if there is any
};
// Which device the rank at this place among those of its machine takes: ranks take the usable ones of the best kind in turn. Its
// index, for MachineOptions::device. Throws as choose_machine does.
std::string device_of_rank(int place);
Backend choose_machine(const MachineOptions& options, Choice choice, const std::vector<const char*>& window_extensions = {});

// A canvas on the backend's device, else on any. Throws host::DeviceError naming the package to install.
std::unique_ptr<host::Canvas> make_vulkan_canvas(const Backend& machine, const host::ShapeInstances& instances,
                                                 const host::CanvasOptions& options);

// Body tables and positions in device memory.
host::BodyTables tables_on_device(Runner& runner);
vec3 position_on_device(Runner& runner, std::size_t row);

}  // namespace scree::demos
