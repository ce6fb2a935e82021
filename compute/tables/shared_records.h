// Records that bodies share or leave: where they are, and which are free.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

// Indices of shared records in the tables.
struct ShapePlaces {
    std::map<std::shared_ptr<const HullForm>, physics::uint> hulls;
    std::map<std::pair<float, float>, physics::uint> tyres;
    std::map<std::array<physics::uint, 12>, physics::uint> surfaces;  // by their words
    std::map<std::shared_ptr<const Cut>, physics::uint> cuts;         // in the table of pieces
};

// Records of removed bodies, for new ones.
struct SpareRecords {
    std::map<std::uint32_t, std::uint32_t> parts;  // runs of part rows: offset behind first_part, count
    std::vector<physics::uint> fractures, surfaces;
    std::vector<std::uint32_t> surface_users;  // rows with each surface
    void add_parts(std::uint32_t offset, std::uint32_t count);
    std::optional<std::uint32_t> take_parts(std::uint32_t count);  // a run of that length; none if there is none
};

}  // namespace scree
