// Records into groups and back.
#include "compute/device/record_groups.h"

#include <algorithm>
#include <cstring>

#include "shaders/physics/base/record_groups.h"

namespace scree {

namespace {

constexpr std::size_t group = physics::RECORDS_OF_GROUP, quad_bytes = 16;
static_assert(physics::RECORDS_OF_GROUP == 1u << physics::GROUP_SHIFT);

// Calls copy(offset of a quad among records one after the other, offset in groups).
template <class Copy>
void for_each_quad(std::size_t records, std::size_t record_bytes, const Copy& copy) {
    const std::size_t quads = record_bytes / quad_bytes;
    for (std::size_t first = 0; first < records; first += group)
        for (std::size_t k = 0; k < quads; ++k)
            for (std::size_t i = first; i < std::min(first + group, records); ++i)
                copy(i * record_bytes + k * quad_bytes, first * record_bytes + (k * group + i - first) * quad_bytes);
}

}  // namespace

std::size_t bytes_in_groups(std::size_t records, std::size_t record_bytes) {
    return (records + group - 1) / group * group * record_bytes;
}

void to_groups(std::span<const std::byte> records, std::size_t record_bytes, std::span<std::byte> groups) {
    const std::size_t count = records.size() / record_bytes, whole = count / group * group * record_bytes;
    std::fill(groups.begin() + static_cast<std::ptrdiff_t>(whole), groups.end(), std::byte{});
    for_each_quad(count, record_bytes, [&](std::size_t in_turn, std::size_t in_group) {
        std::memcpy(&groups[in_group], &records[in_turn], quad_bytes);
    });
}

void from_groups(std::span<const std::byte> groups, std::size_t record_bytes, std::span<std::byte> records) {
    for_each_quad(records.size() / record_bytes, record_bytes, [&](std::size_t in_turn, std::size_t in_group) {
        std::memcpy(&records[in_turn], &groups[in_group], quad_bytes);
    });
}

}  // namespace scree
