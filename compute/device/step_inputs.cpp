// Parameters and actions on their way to the device.
#include "compute/device/step_inputs.h"

#include <cstring>

namespace scree {

StepInputs::StepInputs(const std::shared_ptr<host::Device>& device, Place parameters, Place actions)
    : of_a_parity_(sizeof(physics::Parameters) + actions.bytes),
      given_(device, "inputs of a step", 2 * of_a_parity_, host::BufferUse::upload) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
        const std::size_t begin = parity * of_a_parity_;
        copies_[parity] = std::make_unique<host::CommandBuffer>(device);
        host::CommandBuffer& commands = *copies_[parity];
        commands.barrier();
        commands.copy(given_, *parameters.buffer, sizeof(physics::Parameters), begin, parameters.offset);
        commands.copy(given_, *actions.buffer, actions.bytes, begin + sizeof(physics::Parameters), actions.offset);
        commands.barrier();
        commands.end();
    }
}

void StepInputs::give(std::size_t parity, const physics::Parameters& parameters, std::span<const physics::Action> actions) {
    std::byte* to = static_cast<std::byte*>(given_.mapped()) + parity * of_a_parity_;
    std::memcpy(to, &parameters, sizeof parameters);
    if (!actions.empty()) std::memcpy(to + sizeof parameters, actions.data(), actions.size_bytes());
}

}  // namespace scree
