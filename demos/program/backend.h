// Where a world is simulated: the choice between a Vulkan device and the processor.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compute/runner.h"
#include "compute/scene.h"
#include "demos/program/options.h"
#include "host/canvas/canvas.h"

namespace scree::host {
class Device;
}

namespace scree::demos {

struct Backend {
    MachineOptions options;
    std::shared_ptr<host::Device> device;            // null on the processor
    std::string remark;                              // why it is not what one might expect; may be empty
    std::shared_ptr<host::Device> screen = nullptr;  // shows a window; null unless one was asked for

    std::unique_ptr<Runner> make_runner() const;
    double copy_speed() const;  // bytes read and written a second (host/copy_speed.h); takes a moment
    // Throws WorkFailed with what the validation layers said, if they were asked for and said anything.
    void require_valid() const;
};

// Throws host::DeviceError when the user named a backend or a device that is not there.
// `window_extensions`: for a machine with a screen (host::Display::extensions); it throws when no device can be that.
enum class Choice {
    fastest,   // by itself: a GPU, else a software device or the processor, whichever measures faster
               // (demos/program/backend_timing.h)
    a_device,  // by itself: a device, if there is any
};
Backend choose_machine(const MachineOptions& options, Choice choice, const std::vector<const char*>& window_extensions = {});

// A canvas on the machine's own device, else on any. Throws host::DeviceError that says what to install.
std::unique_ptr<host::Canvas> make_vulkan_canvas(const Backend& machine, const host::ShapeInstances& instances,
                                                 const host::CanvasOptions& options);

// What a machine with a device keeps there.
host::BodyTables tables_on_device(Runner& runner);
vec3 position_on_device(Runner& runner, std::size_t row);

}  // namespace scree::demos
