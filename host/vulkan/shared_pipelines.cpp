// The compute pipelines that a device has made, shared by all worlds on it.
#include "host/vulkan/shared_pipelines.h"

namespace scree::host {

SharedPipelines::Made SharedPipelines::get(const Key& key, const std::function<Made()>& make) {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return !in_making_.contains(key); });
    if (const auto found = by_key_.find(key); found != by_key_.end()) {
        by_use_.splice(by_use_.begin(), by_use_, found->second);
        return found->second->pipeline;
    }
    in_making_.insert(key);
    lock.unlock();
    Made pipeline;
    try {
        pipeline = make();
    } catch (...) {
        lock.lock();
        in_making_.erase(key);
        ended_.notify_all();
        throw;
    }
    lock.lock();
    keep(key, pipeline);
    in_making_.erase(key);
    ended_.notify_all();
    return pipeline;
}

void SharedPipelines::keep(const Key& key, const Made& pipeline) {
    by_use_.push_front({key, pipeline});
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
