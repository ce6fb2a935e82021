// Edits of a state between steps: settings, bodies, joints.
#pragma once

#include <cstddef>
#include <optional>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/step/table_ranges.h"

namespace scree {

// For tables on a runner, only data that an edit needs is downloaded, and only changes are uploaded: the caller first
// downloads the ranges of needed_to_...(), and after the edit lets the runner adapt and uploads the returned ranges.
class StateEditor {
public:
    explicit StateEditor(State& state) : state_(state) {}

    // Changes gravity and settings in the parameters (the caller updates grips, which depend on substeps). Accumulated
    // impulses are those of a substep; they are scaled to the new substep length.
    TableRanges needed_to_tune(const Settings& settings) const;
    TableRanges tune(vec3 gravity, const Settings& settings);
    // Appends a body, in a row before those of parts. When rows run out, parts move up, leaving room for half as many
    // bodies again.
    TableRanges needed_to_add() const;
    TableRanges add(const Body& body);
    // Replaces the joints by the scene's: the present ones without `without`, then new ones.
    TableRanges needed_to_rejoin() const;
    TableRanges rejoin(const Scene& scene, std::optional<std::size_t> without = std::nullopt);

private:
    bool has_room_for_a_body() const;
    TableRanges make_room_for_bodies();
    TableRanges rows_added(std::uint32_t first, std::uint32_t count);

    State& state_;
};

}  // namespace scree
