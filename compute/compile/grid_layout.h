// The layout of the broadphase's grid for a scene: the width of the finest cells, and which bodies are listed apart from it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shaders/physics/base/records.h"
#include "shaders/physics/collide/grid.h"

namespace scree {

// All rows of one copy of a scene are noted twice, before the cell and before the levels are chosen.
class GridLayout {
public:
    void note_width(const physics::BodyProperties& row, const physics::Parameters& p);
    void choose_cell(physics::Parameters& p);  // sets the width of cells
    void note_level(const physics::BodyProperties& row);
    void choose_levels();
    // Whether a row, which is not marked yet, is to be listed among the large ones.
    bool is_large(const physics::BodyProperties& row) const;

private:
    std::vector<float> widths_;  // of dynamic bodies, m
    float inverse_cell_ = 1;
    std::array<std::size_t, physics::LEVELS> population_{};
    std::array<bool, physics::LEVELS> is_listed_{};  // levels that are scanned as a list
};

}  // namespace scree
