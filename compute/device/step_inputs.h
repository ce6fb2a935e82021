// What the host gives a step: its parameters and actions. They are copied on the device's queue ahead of the step, from memory
// of the step's parity, so nothing waits for the step before and nothing is allocated.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "shaders/physics/base/records.h"

namespace scree {

class StepInputs {
public:
    struct Place {
        const host::Buffer* buffer;
        std::size_t offset, bytes;
    };
    StepInputs(const std::shared_ptr<host::Device>& device, Place parameters, Place actions);

    // Of a step of this parity, whose predecessor of the same parity has completed. `actions` fit into their table.
    void give(std::size_t parity, const physics::Parameters& parameters, std::span<const physics::Action> actions);
    VkCommandBuffer copies(std::size_t parity) const { return copies_[parity]->handle(); }

private:
    std::size_t of_a_parity_;  // bytes
    host::Buffer given_;
    std::array<std::unique_ptr<host::CommandBuffer>, 2> copies_;
};

}  // namespace scree
