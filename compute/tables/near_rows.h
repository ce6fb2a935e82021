// Which rows are near each other, kept from step to step: a cache of the CPU loops (compute/cpu/near_rows.h).
#pragma once

#include <cstdint>
#include <vector>

#include "shaders/physics/base/records.h"

namespace scree {

struct NearRows {
    struct Box {
        alignas(16) physics::vec3 lower;  // m; of four words each, as in an entry, for loads of four (cells.h)
        alignas(16) physics::vec3 upper;
    };
    // By row: its bounds of some step with a margin; of a row that was not in the grid, empty.
    std::vector<Box> boxes;
    // Rows whose boxes overlap, once each: of row i those from firsts[i] on, ends[i] - firsts[i].
    std::vector<std::uint32_t> firsts, ends, others;
    bool is_listed = false;  // for these boxes
    // By row, in this step.
    enum class Place : std::uint8_t { not_in_grid, in_box, outside };
    std::vector<Place> places;
    std::vector<physics::CellEntry> entries;  // by row, of those in their boxes; of others one that overlaps nothing
};

}  // namespace scree
