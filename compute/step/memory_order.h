// Which bodies lie side by side in memory: those that are near each other in space, so that a contact finds both of its bodies,
// and a body its neighbours, where a cache has just been.
//
// Bodies are known by their ids, their indices in the scene; the row of a body in the tables is another number, and only the
// State knows both. Whatever decides a bit, which of two bodies comes first in a pair and in which order a sum is taken, goes by
// ids (shaders/stages/lib/ids.glsl): so rows may change between any two steps, and results do not.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "compute/step/state.h"
#include "compute/step/threads.h"

namespace scree {

// A row for each body of the scene, by id: bodies in the order of a Morton curve through the grid's finest cells. Pieces keep the
// rows of their ids. Poses must be here.
std::vector<std::uint32_t> rows_by_place(const Scene& scene, const State& state, const Threads& threads);

// How far each dynamic body is from the one behind it in memory, m, on average; what is farther than 64 cells counts as that
// far. With `rows` in place of those of the state, if there are any.
double stride_in_space(const Scene& scene, const State& state, const std::vector<std::uint32_t>& rows = {});

// The contacts of the last step in the order that they have where every body is in the row of its id: for whatever is listed or
// summed over all of them.
std::vector<std::uint32_t> contacts_by_id(const State& state);

}  // namespace scree
