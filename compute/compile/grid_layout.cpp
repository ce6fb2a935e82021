// Choosing cells and levels of the grid.
#include "compute/compile/grid_layout.h"

#include <algorithm>

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/body/compound.h"

namespace scree {

namespace {

// Grid levels with fewer bodies than this are cheaper to scan as a list than to look up.
constexpr std::size_t few_bodies = 24;
constexpr std::size_t most_large = 64;

float width_of(const physics::BodyProperties& row) {
    return physics::widest(row.shape, row.size);
}

bool is_in_grid(const physics::BodyProperties& row) {
    return !physics::is_large(row) && row.shape != physics::SHAPE_NONE && !physics::is_apart(row);
}

}  // namespace

void GridLayout::note_width(const physics::BodyProperties& row, const physics::Parameters& p) {
    const bool may_move = row.motion == physics::MOTION_PENDING || physics::motion_of(row) == physics::MOTION_DYNAMIC;
    if (is_in_grid(row) && may_move) widths_.push_back(width_of(row) + physics::speculative_of(row, p));
}

// The finest cells fit the body at the tenth percentile of size: most bodies are then on the first levels, few per cell.
void GridLayout::choose_cell(physics::Parameters& p) {
    p.cell = 1;
    if (!widths_.empty()) {
        const auto tenth = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 10);
        std::nth_element(widths_.begin(), tenth, widths_.end());
        p.cell = 1.25f * (*tenth + glm::length(p.gravity) * p.dt * p.dt);
    }
    p.inverse_cell = inverse_cell_ = 1 / p.cell;
    std::vector<float>().swap(widths_);  // its memory, too
}

void GridLayout::note_level(const physics::BodyProperties& row) {
    if (is_in_grid(row)) ++population_[physics::level_of(width_of(row), inverse_cell_)];
}

// Bodies on levels with too few bodies join the planes in the list of large bodies.
void GridLayout::choose_levels() {
    std::size_t room = most_large;
    for (std::size_t l = population_.size(); l-- > 0;) {
        if (population_[l] == 0 || population_[l] > few_bodies || population_[l] > room) continue;
        room -= population_[l];
        is_listed_[l] = true;
    }
}

bool GridLayout::is_large(const physics::BodyProperties& row) const {
    return is_in_grid(row) && is_listed_[physics::level_of(width_of(row), inverse_cell_)];
}

}  // namespace scree
