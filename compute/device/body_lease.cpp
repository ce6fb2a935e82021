// Leases of the device runner's tables.
#include "compute/device/body_lease.h"

#include <stdexcept>

#include "compute/device/device_runner.h"

namespace scree {

namespace {

DeviceRunner& on_device(Runner& runner) {
    if (auto* found = dynamic_cast<DeviceRunner*>(&runner)) return *found;
    throw std::invalid_argument("the runner \"" + runner.backend() + "\" has no tables on a device to be leased");
}

LeasedTable member_of(const DeviceRunner::Range& range, std::size_t member, std::size_t stride, std::uint32_t rows) {
    return {range.buffer->handle(), range.offset + member, rows == 0 ? 0 : rows * stride - member,
            static_cast<std::uint32_t>(stride)};
}

}  // namespace

host::Submission::Moment DeviceRunner::next_ready() {
    if (ready_.timeline) ++ready_.value;
    return ready_;
}

void DeviceRunner::wait_for_returned() {
    if (returned_.timeline) device_->wait_for(returned_.timeline, returned_.value);
    returned_ = {};
}

BodyLease DeviceRunner::lease_bodies() {
    if (!device_->has_timelines())
        throw host::DeviceError(device_->report().name + " has no timeline semaphores, which leases need");
    if (!ready_.timeline) {
        VkSemaphoreTypeCreateInfo type{};
        type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
        type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
        VkSemaphoreCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        info.pNext = &type;
        host::check_made(device_->vk().vkCreateSemaphore(device_->handle(), &info, nullptr, &ready_.timeline),
                         "creating a timeline semaphore", ready_.timeline);
    }
    const Range poses = range(Table::poses), velocities = range(Table::velocities);
    const std::uint32_t rows = state_->fixed().bodies;
    const auto of_pose = [&](std::size_t member) { return member_of(poses, member, sizeof(physics::Pose), rows); };
    const auto of_velocity = [&](std::size_t member) { return member_of(velocities, member, sizeof(physics::Velocity), rows); };
    return {of_pose(offsetof(physics::Pose, position)),
            of_pose(offsetof(physics::Pose, orientation)),
            of_velocity(offsetof(physics::Velocity, linear)),
            of_velocity(offsetof(physics::Velocity, angular)),
            rows,
            ready_.timeline,
            ready_.value,
            buffers_made_};
}

BodyLease lease_bodies(Runner& runner) {
    return on_device(runner).lease_bodies();
}

void return_bodies(Runner& runner, VkSemaphore timeline, std::uint64_t value) {
    on_device(runner).return_bodies(timeline, value);
}

}  // namespace scree
