// World: the table of hulls is used again where bodies were removed.
#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "compute/world/world_impl.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/seam.h"
#include "shaders/physics/collide/shape_data.h"
#include "shaders/physics/collide/triangle.h"

namespace scree {

namespace {

bool has_records(const physics::BodyProperties& row) {
    return row.shape == physics::SHAPE_HULL || row.shape == physics::SHAPE_TRIANGLE;
}

// Quads of a hull (shape_data.h) or triangle.
std::uint32_t records_of(const State& state, const physics::BodyProperties& row) {
    if (row.shape == physics::SHAPE_TRIANGLE) return physics::TRIANGLE_RECORDS;
    const physics::uvec4* const hull = state.hulls.data() + row.shape_data;
    const std::uint32_t vertices = hull->x, faces = hull->y, across = hull->z;
    const physics::uvec4 last = hull[1 + vertices + 2 * faces - 1];  // first corner and number of corners of the last face
    const std::uint32_t corners = last.x + last.y;
    return 1 + vertices + 2 * faces + 2 * 6 * across * across + (corners + 15) / 16;
}

// Of a part, plus 1; 0: none.
physics::uint seams_of(const State& state, std::uint32_t row) {
    return row >= state.fixed().first_part && physics::is_part(state.properties[row]) ? state.part_in(row).seams : 0;
}

// Calls `note` with the place and length of the records of a row that lie behind `first`.
template <class Note>
void for_records_of(const State& state, std::uint32_t row, std::size_t first, const Note& note) {
    const physics::BodyProperties& properties = state.properties[row];
    if (has_records(properties) && properties.shape_data >= first) note(properties.shape_data, records_of(state, properties));
    const physics::uint seams = seams_of(state, row);
    if (seams > first) note(seams - 1, physics::quads_of_seams(state.hull_table(), seams - 1));
}

}  // namespace

std::map<std::uint32_t, std::uint32_t> World::Impl::hulls_of_added(const std::vector<std::uint32_t>& bodies) const {
    std::set<std::uint32_t> rows;
    for (const std::uint32_t body : bodies) rows.insert(state.row_of(body));
    std::map<std::uint32_t, std::uint32_t> found;
    const auto note = [&](std::uint32_t place, std::uint32_t count) { found[place] = count; };
    for (const std::uint32_t row : rows) for_records_of(state, row, shapes_at_start.hulls, note);
    for (std::uint32_t row = state.fixed().first_part; row < state.fixed().bodies; ++row)
        if (physics::is_part(state.properties[row]) && rows.contains(state.properties[row].owner))
            for_records_of(state, row, shapes_at_start.hulls, note);
    return found;
}

void World::Impl::free_hulls(std::map<std::uint32_t, std::uint32_t> records) {
    if (records.empty()) return;
    const auto keep = [&](std::uint32_t place, std::uint32_t) { records.erase(place); };  // shared with a body that stays
    for (std::uint32_t row = 0; row < state.fixed().bodies; ++row) for_records_of(state, row, shapes_at_start.hulls, keep);
    std::erase_if(state.shape_places.hulls, [&](const auto& one) { return records.contains(one.second); });
    TableRanges emptied;
    for (const auto& [place, count] : records) {
        add_run(spare_hulls, place, count);
        // Or an equal hull that comes later would be found there (SceneCompiler::place_of), and another one written over it.
        std::fill_n(state.hulls.begin() + place, count, physics::uvec4(0));
        emptied.push_back({Table::hulls, place, count});
    }
    runner->upload(emptied);
}

// What a new body appended moves to where others were.
void World::Impl::pack_hulls(std::size_t before, std::uint32_t body, TableRanges& changed) {
    const auto count = static_cast<std::uint32_t>(state.hulls.size() - before);
    if (count == 0) return;
    const std::optional<std::uint32_t> taken = take_run(spare_hulls, count);
    if (!taken) return;
    const std::uint32_t place = *taken;
    std::copy(state.hulls.begin() + static_cast<std::ptrdiff_t>(before), state.hulls.end(), state.hulls.begin() + place);
    state.hulls.resize(before);
    const auto moved = [&](physics::uint& at) {
        if (at >= before) at = static_cast<physics::uint>(at - before + place);
    };
    const std::uint32_t row = state.row_of(body);
    if (has_records(state.properties[row])) moved(state.properties[row].shape_data);
    if (state.properties[row].shape == physics::SHAPE_NONE)
        for (std::uint32_t part = state.fixed().first_part; part < state.fixed().bodies; ++part) {
            if (!physics::is_part(state.properties[part]) || state.properties[part].owner != row) continue;
            if (has_records(state.properties[part])) moved(state.properties[part].shape_data);
            physics::uint& seams = state.parts[part - state.fixed().first_part].seams;
            if (seams > before) seams = static_cast<physics::uint>(seams - before + place);
        }
    for (auto& [form, at] : state.shape_places.hulls) moved(at);
    std::erase_if(changed, [&](const TableRange& range) { return range.table == Table::hulls && range.first >= before; });
    changed.push_back({Table::hulls, place, count});
}

// After a checkpoint: what no body uses behind the hulls of the start.
void World::Impl::find_spare_hulls() {
    std::map<std::uint32_t, std::uint32_t> used;
    const auto note = [&](std::uint32_t place, std::uint32_t count) { used[place] = count; };
    for (std::uint32_t row = 0; row < state.fixed().bodies; ++row) for_records_of(state, row, shapes_at_start.hulls, note);
    spare_hulls.clear();
    auto place = static_cast<std::uint32_t>(shapes_at_start.hulls);
    for (const auto& [first, count] : used) {
        if (first > place) spare_hulls[place] = first - place;
        place = first + count;
    }
    if (state.hulls.size() > place) spare_hulls[place] = static_cast<std::uint32_t>(state.hulls.size()) - place;
}

}  // namespace scree
