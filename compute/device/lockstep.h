// The CPU and a device walk the same plan side by side; after every stage what it wrote is compared bit by bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/step/state_editor.h"

namespace scree {

namespace host {
class Device;
}
class DeviceRunner;  // compute/device/device_runner.h

struct LockstepResult {
    bool equal = true;
    int step = 0;             // whole steps walked and found equal
    std::string stage;        // the first that differs
    std::string buffer;       // what it wrote there
    std::size_t element = 0;  // the first record that differs
    std::string detail;       // byte of the record, and both values
    std::uint64_t hash = 0;   // of the common state at the end
};

// The two side by side, for who wants to look between steps.
class Lockstep {
public:
    // Throws as World does.
    Lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device, int threads);
    ~Lockstep();
    bool step();  // false: something differs, and result() says what
    // The same edit of both, between steps; the device is sent what the editor says.
    void edit(const std::function<TableRanges(const StateEditor&)>& needed, const std::function<TableRanges(StateEditor&)>& make);
    // Any other change to the tables of both: the device gives all that lasts, and is attached anew.
    void change(const std::function<void(State&)>& make);
    const LockstepResult& result() const;
    DeviceRunner& device();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Walks `steps` steps, or until something differs or `progress` (told the steps done) says false. Throws as World does.
LockstepResult compare_in_lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device,
                                   int threads, int steps, const std::function<bool(int)>& progress = {});

}  // namespace scree
