// Choice of the backend, with Vulkan.
#include "demos/program/backend.h"

#include <fmt/format.h>

#include "compute/device/arithmetic_check.h"
#include "compute/device/device_runner.h"
#include "compute/distributed/distributed.h"
#include "demos/program/backend_timing.h"
#include "demos/program/exit_status.h"
#include "host/copy_speed.h"
#include "host/vulkan/device.h"
#include "shaders/physics/base/record_groups.h"
#include "shaders/physics/base/records.h"

namespace scree::demos {

std::unique_ptr<Runner> Backend::make_runner() const {
    return device ? make_device_runner(device) : make_reference_runner(options.threads);
}

std::unique_ptr<Runner> Backend::make_runner(std::shared_ptr<Exchange> exchange) const {
    return device ? make_distributed_runner(std::move(exchange), device)
                  : make_distributed_runner(std::move(exchange), options.threads);
}

std::vector<PipelineFigures> Backend::pipelines(Runner& runner) const {
    std::vector<PipelineFigures> all;
    if (!device || !device->tells_statistics()) return all;
    for (const auto& [stage, statistics] : dynamic_cast<DeviceRunner&>(runner).pipeline_statistics()) {
        all.push_back({stage, {}});
        for (const host::PipelineStatistic& one : statistics) all.back().figures.emplace_back(one.name, one.value);
    }
    return all;
}

double Backend::copy_speed() const {
    return device ? host::device_copy_speed(device) : host::processor_copy_speed(options.threads);
}

std::string Backend::driver() const {
    return device ? device->report().driver : "";
}

bool Backend::draws() const {
    return device && device->report().has_graphics;
}

bool Backend::has_own_memory() const {
    return device && !device->report().is_processor;
}

std::string Backend::arithmetic_fault() const {
    return device ? check_arithmetic(device).fault : "";
}

void Backend::require_valid() const {
    const std::shared_ptr<host::Device>& watched = device ? device : screen;
    if (!watched || !options.validate) return;
    const std::vector<std::string> messages = watched->validation_messages();
    if (messages.empty()) return;
    throw WorkFailed("Vulkan validation: " + std::to_string(messages.size()) + " messages, the first: " + messages.front());
}

namespace {

// Replaces a software device by the CPU backend if that is faster: both use the same cores.
void take_the_faster(Backend& machine) {
    const host::DeviceReport& device = machine.device->report();
    const std::string key = fmt::format("{}, {}, {} threads", device.name, device.driver, machine.options.threads);
    const Paces paces = paces_of(key, [&] {
        return measure_paces([&] { return make_device_runner(machine.device); },
                             [&] { return make_reference_runner(machine.options.threads); });
    });
    const bool leave = paces.processor < paces.device;
    if (!paces.known)
        machine.remark = fmt::format(
            "simulating {}: a step of {} resting boxes took {:.1f} ms on {} and {:.1f} ms on the processor",
            leave ? "on the processor" : "on " + device.name, heap_bodies, paces.device, device.name, paces.processor);
    if (leave) machine.device = nullptr;
}

}  // namespace

std::string device_of_rank(int place) {
    std::vector<host::DeviceReport> best;
    for (const host::DeviceReport& report : host::list_devices()) {
        if (!report.lacks.empty()) continue;
        if (!best.empty() && report.kind < best.front().kind) best.clear();
        if (best.empty() || report.kind == best.front().kind) best.push_back(report);
    }
    // None: opening the default one says why.
    return best.empty() ? "" : std::to_string(best[static_cast<std::size_t>(place) % best.size()].index);
}

Backend choose_machine(const MachineOptions& options, Choice choice, const std::vector<const char*>& window_extensions) {
    Backend machine{options, nullptr, ""};
    const bool shows = !window_extensions.empty();
    const auto open = [&] {
        return host::Device::open({.which = options.device,
                                   .validation = options.validate,
                                   .statistics = options.pipelines,
                                   .window_extensions = window_extensions,
                                   .on_message = {}});
    };
    if (options.backend == "cpu") {
        if (!options.device.empty())
            throw UsageError("--device: the backend cpu has no devices; use --threads, or --backend vulkan");
        if (shows) machine.screen = open();
        return machine;
    }
    if (options.backend == "vulkan" && options.threads > 0)
        throw UsageError("--threads: the backend vulkan has none to choose; leave it out, or say --backend cpu");
    const bool insist = options.backend == "vulkan" || !options.device.empty() || options.validate || shows;
    try {
        machine.device = open();
        if (shows) machine.screen = machine.device;
        if (choice == Choice::fastest && options.backend == "auto" && options.device.empty() && !options.validate &&
            machine.device->report().is_processor)
            take_the_faster(machine);
        else if (options.threads > 0)
            machine.remark = "--threads is for --backend cpu; simulating on " + machine.device->report().name;
    } catch (const host::DeviceError& error) {
        if (insist) throw;
        machine.remark = std::string("no Vulkan device (") + error.what() + "); simulating on the processor";
    }
    return machine;
}

std::unique_ptr<host::Canvas> make_vulkan_canvas(const Backend& machine, const host::ShapeInstances& instances,
                                                 const host::CanvasOptions& options) {
    std::shared_ptr<host::Device> device = machine.device ? machine.device : machine.screen;
    if (!device) device = host::Device::open({.which = "", .validation = machine.options.validate, .on_message = {}});
    return host::make_vulkan_canvas(std::move(device), instances, options);
}

host::BodyTables tables_on_device(Runner& runner) {
    const auto& device = dynamic_cast<DeviceRunner&>(runner);
    physics::Counts counts{};
    device.read(Table::counts, std::as_writable_bytes(std::span(&counts, 1)));
    const auto view = [&](Table table) {
        const DeviceRunner::Range range = device.range(table);
        return host::TableView(range.buffer, range.offset, range.bytes);
    };
    host::BodyTables tables{view(Table::properties), view(Table::poses),    view(Table::velocities),
                            view(Table::contacts),   view(Table::impulses), counts.contacts};
    tables.push_shift = physics::GROUP_SHIFT;
    tables.slot_ends = view(Table::slot_ends);
    tables.slot_sides = view(Table::slot_sides);
    tables.sleep_states = view(Table::sleep_states);
    tables.bounds = view(Table::bounds);
    tables.ids = view(Table::ids);
    tables.joints = view(Table::joints);
    tables.joint_count = device.joint_records();
    return tables;
}

vec3 position_on_device(Runner& runner, std::size_t row) {
    physics::Pose pose{};
    const auto bytes = std::as_writable_bytes(std::span(&pose, 1));
    dynamic_cast<DeviceRunner&>(runner).read(Table::poses, bytes, row * sizeof pose);
    return pose.position;
}

}  // namespace scree::demos
