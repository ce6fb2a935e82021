// The compute pipelines that a device has made, shared by all worlds on it.
#include "host/vulkan/shared_pipelines.h"

#include <utility>

namespace scree::host {

std::shared_ptr<const MadePipeline> SharedPipelines::find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return nullptr;
    by_use_.splice(by_use_.begin(), by_use_, found->second);
    return found->second->pipeline;
}

void SharedPipelines::keep(const Key& key, std::shared_ptr<const MadePipeline> pipeline) {
    const std::lock_guard lock(mutex_);
    if (by_key_.contains(key)) return;
    by_use_.push_front({key, std::move(pipeline)});
    by_key_.emplace(key, by_use_.begin());
    if (by_use_.size() <= most_) return;
    by_key_.erase(by_use_.back().key);
    by_use_.pop_back();
}

std::size_t SharedPipelines::size() const {
    const std::lock_guard lock(mutex_);
    return by_use_.size();
}

}  // namespace scree::host
