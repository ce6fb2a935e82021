// What changes in the tables of a state between two steps: dials, bodies, joints.
#pragma once

#include <cstddef>
#include <optional>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/step/table_ranges.h"

namespace scree {

// Of tables that lie on a runner, only what an edit needs must be here, and only what it changed must be sent: before, the caller
// downloads the ranges that needed_to_... names; behind, it lets the runner adapt, and uploads the ranges that are returned.
class StateEditor {
public:
    explicit StateEditor(State& state) : state_(state) {}

    // What may change between steps, into the parameters (grips, which depend on the substeps, are the caller's to make anew).
    // Impulses that last are those of a substep; those of the last step are brought to the new length of one.
    TableRanges needed_to_tune(const Settings& settings) const;
    TableRanges tune(vec3 gravity, const Settings& settings);
    // One more body, the last, into a row before those of parts. When the rows there are used up, the parts move, and leave room
    // for half as many bodies again.
    TableRanges needed_to_add() const;
    TableRanges add(const Body& body);
    // The joints are the scene's: those that were here, but for the one at `without`, and then others.
    TableRanges needed_to_rejoin() const;
    TableRanges rejoin(const Scene& scene, std::optional<std::size_t> without = std::nullopt);

private:
    bool has_room_for_a_body() const;
    TableRanges make_room_for_bodies();
    TableRanges rows_added(std::uint32_t first, std::uint32_t count);

    State& state_;
};

}  // namespace scree
