// Memory order of bodies: neighbours in space become neighbours in memory, so that a contact finds its bodies, and a
// body its neighbours, in a cache.
//
// A body's id is its index in the scene; its row in the tables may differ, and only State knows both. All that decides
// a bit, which body of a pair is A and the order of sums, goes by ids (shaders/stages/lib/ids.glsl): rows may change
// between any two steps, and results do not.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/parallel/threads.h"
#include "compute/scene.h"
#include "compute/tables/state.h"

namespace scree {

// Rows of the bodies, by id, along a Morton curve through the grid's finest cells. Fragments keep the rows of their
// ids. Needs the poses.
std::vector<std::uint32_t> rows_by_place(const Scene& scene, const State& state, const Threads& threads);

// A position's place on the curve: interleaved bits of the cells of three coordinates (Morton 1966).
std::uint64_t place_on_curve(vec3 position, float inverse_cell);

// Mean distance of each dynamic body from the next one in memory, m, each at most 64 cells; with `rows` instead of the
// state's, if given.
double stride_in_space(const Scene& scene, const State& state, const std::vector<std::uint32_t>& rows = {});

// The contacts of the last step in the order they have if every row equals its id: for lists and sums over all
// contacts.
std::vector<std::uint32_t> contacts_by_id(const State& state);

}  // namespace scree
