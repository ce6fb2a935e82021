// Moves bodies to other rows of a device's tables, contacts and all that refers to bodies with them, without a copy on the host.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/pipeline.h"

namespace scree {

class RowMover {
public:
    RowMover(std::shared_ptr<host::Device> device, std::uint32_t group_size);

    // A table in a buffer, all in words.
    struct Records {
        const host::Buffer* buffer;
        std::size_t begin, length, count;  // begin of the table, length of a record, number of records
        bool is_grouped = false;           // shaders/physics/base/record_groups.h
    };
    struct Tables {
        std::uint32_t rows, bodies;  // all; those that move are below `bodies`
        Records first_contacts;      // of each row, and the end of all
        std::vector<Records> of_bodies;
        std::vector<std::pair<Records, std::size_t>> with_rows;            // and which word of a record is a row
        std::vector<std::pair<Records, const host::Buffer*>> of_contacts;  // and where they move to
    };
    // Row r shall hold what is in row from[r]. Allocates and uploads; throws host::DeviceError if memory is short or a table is
    // longer than a binding, and has then changed nothing.
    void prepare(const Tables& tables, std::span<const std::uint32_t> from);
    void move();  // what was prepared

private:
    struct Push {
        std::uint32_t step, items, rows, length, begin, first, bodies, shift;
    };
    const host::BindingSet& bound(const host::Buffer& table, const host::Buffer& moved);
    void run(std::uint32_t step, std::size_t items, const Records& of, std::size_t first, const host::BindingSet& set);

    std::shared_ptr<host::Device> device_;
    std::uint32_t group_size_;
    std::shared_ptr<host::BindingSetLayout> layout_;
    std::vector<host::Pipeline> pipelines_;  // of steps without and with sums over rows
    Tables tables_{};
    host::Buffer moves_, scratch_;
    std::map<std::pair<const host::Buffer*, const host::Buffer*>, host::BindingSet> sets_;
    std::unique_ptr<host::CommandBuffer> commands_;
};

}  // namespace scree
