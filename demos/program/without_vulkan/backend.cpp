// Choice of the backend in a build without Vulkan: the CPU.
#include "demos/program/backend.h"

#include <utility>

#include "compute/distributed/distributed.h"
#include "demos/program/exit_status.h"
#include "host/copy_speed.h"
#include "host/device_error.h"

namespace scree::demos {

namespace {
constexpr const char* cure = "this scree was built without Vulkan; configure it with -DSCREE_VULKAN=ON";
}

std::unique_ptr<Runner> Backend::make_runner() const {
    return make_reference_runner(options.threads);
}

std::unique_ptr<Runner> Backend::make_runner(std::shared_ptr<Exchange> exchange) const {
    return make_distributed_runner(std::move(exchange), options.threads);
}

std::vector<PipelineFigures> Backend::pipelines(Runner&) const {
    return {};
}

double Backend::copy_speed() const {
    return host::processor_copy_speed(options.threads);
}

std::string Backend::driver() const {
    return "";
}

bool Backend::draws() const {
    return false;
}

bool Backend::has_own_memory() const {
    return false;
}

std::string Backend::arithmetic_fault() const {
    return "";
}

void Backend::require_valid() const {}

std::string device_of_rank(int) {
    throw UsageError(std::string("--backend vulkan: ") + cure);
}

Backend choose_machine(const MachineOptions& options, Choice, const std::vector<const char*>&) {
    if (options.backend == "vulkan") throw UsageError(std::string("--backend vulkan: ") + cure);
    if (!options.device.empty()) throw UsageError(std::string("--device: ") + cure);
    return {options, nullptr, ""};
}

std::unique_ptr<host::Canvas> make_vulkan_canvas(const Backend&, const host::ShapeInstances&, const host::CanvasOptions&) {
    throw host::DeviceError(std::string("Vulkan: ") + cure);
}

host::BodyTables tables_on_device(Runner&) {
    return {};
}

vec3 position_on_device(Runner&, std::size_t) {
    return vec3(0);
}

}  // namespace scree::demos
