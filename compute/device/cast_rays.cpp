// Device runner: which batches of rays it casts itself.
#include <limits>

#include "compute/device/device_runner.h"

namespace scree {

namespace {

// Fewer rays are cast sooner on the host. On lavapipe all are: 20 times as fast (scree_peers_rays --device).
std::size_t fewest_rays(const host::Device& device) {
    return device.report().is_processor ? std::numeric_limits<std::size_t>::max() : 4096;
}

}  // namespace

// Copies of a scene lie at the same places: one tree over all would be searched in vain.
bool DeviceRunner::casts(std::size_t rays) const {
    return rays > 0 && rays >= fewest_rays_.value_or(fewest_rays(*device_)) && !state_->has_copies();
}

bool DeviceRunner::cast(RayTask& task) {
    const auto table = [&](Table one) { return &buffer(one); };
    const RayCaster::Tables tables{table(Table::parameters), table(Table::properties),   table(Table::poses),
                                   table(Table::hulls),      table(Table::sleep_states), state_->fixed().bodies,
                                   !state_->filters.empty(), state_->reordered(),        buffers_made_};
    try {
        if (!rays_) rays_ = std::make_unique<RayCaster>(device_, group_size());
        if (!rays_->takes(tables)) return false;
        send_parameters();
        rays_->cast(tables, task);
        return true;
    } catch (const host::DeviceError&) {
        // Short of memory; or lost, which the host notices as it reads the bodies.
        rays_.reset();
        return false;
    }
}

}  // namespace scree
