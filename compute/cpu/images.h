// Bodies as others meet them, in scenes with a periodic cell: at their nearest image.
#pragma once

#include "compute/tables/state.h"
#include "shaders/physics/body/periodic_cell.h"

namespace scree::reference {

// Of scenes with a cell, the image of B that A meets, of two rows whose bodies they are.
inline physics::Image image_met(const State& state, std::uint32_t row_a, std::uint32_t row_b) {
    const physics::Pose &a = state.poses[state.body_of(row_a)], &b = state.poses[state.body_of(row_b)];
    return physics::image_of_b(state.properties[row_a], state.properties[row_b], b.position - a.position, state.fixed());
}
// B as A meets it. Without a cell nothing is added, which could change the sign of a zero.
struct MetBody {
    physics::Pose pose;
    physics::Velocity velocity;
};
inline MetBody as_met(const State& state, std::uint32_t row_a, std::uint32_t row_b) {
    const std::uint32_t b = state.body_of(row_b);
    MetBody met{state.poses[b], state.velocities[b]};
    if (!state.is_periodic()) return met;
    const physics::Image image = image_met(state, row_a, row_b);
    return {physics::at_image(met.pose, image), physics::at_image(met.velocity, image)};
}

}  // namespace scree::reference
