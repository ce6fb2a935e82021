// Rays on a device: a tree over the rows of a step, built there from their poses, and batches of rays through it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene/ray_task.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/pipeline.h"

namespace scree {

class RayCaster {
public:
    RayCaster(std::shared_ptr<host::Device> device, std::uint32_t group_size);

    // Tables of a step, which must be bindable.
    struct Tables {
        const host::Buffer *parameters, *properties, *poses, *quads, *words;
        std::uint32_t rows;
        bool filters, reordered;
        std::uint64_t made;  // changes with the buffers
        bool operator==(const Tables&) const = default;
    };
    // Whether a device has room for that many rows and all hits may be bound.
    bool takes(const Tables& tables) const;
    // Throws host::DeviceError when memory is short; it is then good for nothing more.
    void cast(const Tables& tables, RayTask& task);

private:
    struct Push {
        std::uint32_t items, leaves, step, flags, rounds, first;
    };
    void make_room(host::Buffer& buffer, const char* name, std::size_t bytes);
    void build(const Tables& tables);
    void bind();
    void run(host::CommandBuffer& commands, const char* shader, std::uint32_t threads, std::uint32_t items, std::uint32_t step,
             std::uint32_t first = 0);
    void submit_cast(std::uint32_t first, std::uint32_t end, std::uint32_t step);
    // Of the uploaded rays; the first of them is that ray of the task.
    void cast_nearest(std::uint32_t rays, RayTask& task, std::size_t first);
    void cast_through(std::uint32_t rays, RayTask& task, std::size_t first);

    std::shared_ptr<host::Device> device_;
    std::uint32_t group_size_;
    std::shared_ptr<host::BindingSetLayout> layout_;
    std::map<std::string, host::Pipeline> pipelines_;
    std::optional<Tables> tables_;
    std::pair<std::uint64_t, std::uint64_t> built_at_{};
    std::uint32_t leaves_ = 1;
    host::Buffer sorted_, sorted_next_, digits_, row_boxes_, node_boxes_, rays_, meetings_, starts_;
    std::unique_ptr<host::BindingSet> bound_;
};

}  // namespace scree
