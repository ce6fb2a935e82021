// The compute pipelines that a device has made, shared by all worlds on it: drivers compile for seconds what a small
// world needs. Internal to Device and Pipeline.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

// A compute pipeline, destroyed with its last owner, all of which the device outlives.
class MadePipeline {
public:
    MadePipeline(const VulkanFunctions& vk, VkDevice device, VkPipeline handle) : vk_(vk), device_(device), handle_(handle) {}
    ~MadePipeline() { vk_.vkDestroyPipeline(device_, handle_, nullptr); }
    MadePipeline(const MadePipeline&) = delete;
    MadePipeline& operator=(const MadePipeline&) = delete;
    VkPipeline handle() const { return handle_; }

private:
    const VulkanFunctions& vk_;
    VkDevice device_;
    VkPipeline handle_;
};

// The most recently used pipelines, by 128-bit hash of all that they are made from. Thread-safe.
class SharedPipelines {
public:
    using Key = std::array<std::uint64_t, 2>;
    using Made = std::shared_ptr<const MadePipeline>;

    explicit SharedPipelines(std::size_t most = 1024) : most_(most) {}
    // The pipeline of that key, by make() if there is none. One that another thread makes is waited for. Throws what make()
    // throws; who waited then makes it.
    Made get(const Key& key, const std::function<Made()>& make);
    std::size_t size() const;

private:
    struct Kept {
        Key key;
        Made pipeline;
    };
    void keep(const Key& key, const Made& pipeline);

    const std::size_t most_;
    mutable std::mutex mutex_;
    std::condition_variable ended_;  // the making of one, well or not
    std::set<Key> in_making_;
    std::list<Kept> by_use_;  // the most recently used first
    std::map<Key, std::list<Kept>::iterator> by_key_;
};

}  // namespace scree::host
