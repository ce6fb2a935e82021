// Records of removed bodies.
#include "compute/tables/shared_records.h"

#include <algorithm>

namespace scree {

void SpareRecords::add_parts(std::uint32_t offset, std::uint32_t count) {
    const auto next = parts.lower_bound(offset);
    if (next != parts.end() && next->first == offset + count) {
        count += next->second;
        parts.erase(next);
    }
    auto before = parts.lower_bound(offset);
    if (before != parts.begin() && (--before)->first + before->second == offset)
        before->second += count;
    else
        parts[offset] = count;
}

std::optional<std::uint32_t> SpareRecords::take_parts(std::uint32_t count) {
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& run) { return run.second >= count; });
    if (found == parts.end()) return std::nullopt;
    const auto [offset, length] = *found;
    parts.erase(found);
    if (length > count) parts[offset + count] = length - count;
    return offset;
}

}  // namespace scree
