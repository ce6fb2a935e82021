// Lockstep: the CPU and a device execute the same plan; after every stage the tables it wrote are compared bit by bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "compute/compile/state_editor.h"
#include "compute/plan/lockstep_result.h"
#include "compute/scene.h"
#include "compute/settings.h"

namespace scree {

namespace host {
class Device;
}
class DeviceRunner;  // compute/device/device_runner.h

// Stepping both, for tests that edit between steps.
class Lockstep {
public:
    // Throws like World. `copies`: of the scene, which `vary` changes, as of World; 0: the scene itself.
    Lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device, int threads,
             std::size_t copies = 0, const std::function<void(std::size_t, Scene&)>& vary = {});
    ~Lockstep();
    bool step();  // false: a difference, described by result()
    // The same edit of both, between steps; the device receives the ranges that the editor returns.
    void edit(const std::function<TableRanges(const StateEditor&)>& needed, const std::function<TableRanges(StateEditor&)>& make);
    // Brings both to a checkpoint of a world of the same scene (compute/checkpoint.h). Throws CheckpointError.
    void restore(std::span<const std::byte> saved);
    // Any other change to both; the device downloads all lasting tables and is attached anew.
    void change(const std::function<void(State&)>& make);
    const LockstepResult& result() const;
    DeviceRunner& device();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Runs until `steps` steps are done, with those of the checkpoint `from` (empty: from the start), until a difference or until
// `progress` (argument: steps done) returns false. Throws like World.
LockstepResult compare_in_lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device,
                                   int threads, int steps, const std::function<bool(int)>& progress = {}, std::size_t copies = 0,
                                   std::span<const std::byte> from = {});

}  // namespace scree
