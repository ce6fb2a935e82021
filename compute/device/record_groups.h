// Conversion of records between the host's tables, one after the other, and a device's tables in groups
// (shaders/physics/base/record_groups.h).
#pragma once

#include <cstddef>
#include <span>

namespace scree {

// Bytes of so many records, in whole groups.
std::size_t bytes_in_groups(std::size_t records, std::size_t record_bytes);
// `groups` has bytes_in_groups() of the records; those behind the last one become 0.
void to_groups(std::span<const std::byte> records, std::size_t record_bytes, std::span<std::byte> groups);
void from_groups(std::span<const std::byte> groups, std::size_t record_bytes, std::span<std::byte> records);

}  // namespace scree
