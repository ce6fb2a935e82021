// Edits of a state between steps: settings, bodies, joints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/tables/table_ranges.h"

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
    TableRanges needed_to_add(std::uint32_t count = 1, bool with_parts = false) const;
    // The width of the grid's cells, for the bodies that there are by now. Levels follow from it, and the order of contacts from
    // levels.
    void choose_cell();
    // Before several are added, of which some have parts.
    TableRanges make_room(std::uint32_t count, bool with_parts = false);
    TableRanges add(const Body& body) { return put(body, state_.body_count); }
    // The same in the row of a removed body, or of the next one.
    TableRanges put(const Body& body, std::uint32_t id);
    // Empties the rows of bodies and of their parts; contacts end with the next step (the caller sets
    // Parameters::removed). Needs their properties.
    TableRanges remove(std::span<const std::uint32_t> ids);
    // Material, mass and motion of a body and its parts. Needs their properties.
    TableRanges change(const Body& body, std::uint32_t id);
    TableRanges place_parts(std::uint32_t id);  // of a body that does not move by itself
    TableRanges set_fields(const Scene& scene);
    // The filters of all rows, and the excluded pairs.
    TableRanges filter(const Scene& scene);
    // Replaces the joints by the scene's: the present ones without `without`, but for `fresh` ones, which are new.
    TableRanges needed_to_rejoin(const Scene& scene, std::span<const std::size_t> fresh) const;
    TableRanges rejoin(const Scene& scene, std::optional<std::size_t> without = std::nullopt,
                       std::span<const std::size_t> fresh = {});

private:
    bool has_room_for(std::uint32_t bodies, bool with_parts) const;
    std::pair<std::uint32_t, std::uint32_t> parts_of(std::uint32_t row) const;  // first row, count
    TableRanges surface_ranges(std::uint32_t first, std::uint32_t count) const;
    void clear_row(std::uint32_t row);
    void empty_row(std::uint32_t row, std::uint32_t owner);  // of a body that is not there
    TableRanges rows_added(std::uint32_t first, std::uint32_t count);

    State& state_;
};

}  // namespace scree
