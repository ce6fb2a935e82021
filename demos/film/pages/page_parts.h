// What recordings and live streams have alike: their look, head, units, events, and the packing of blocks.
#pragma once

#include <cstddef>
#include <string>

#include "demos/film/pages/chunk_bytes.h"
#include "demos/film/pages/frame_encoder.h"
#include "demos/film/pages/page_recording.h"
#include "demos/film/pages/world_chunks.h"
#include "demos/program/loaded_scene.h"

namespace scree::demos {

// Bodies of which all contacts are recorded unasked.
constexpr std::size_t most_with_contacts = 2000;
// Colours, light and the corners of the action, as pictures of `subject` in page.style have them. `rehearses`: as color_range().
void take_look(PageOptions& page, const LoadedScene& subject, const Settings& settings, bool rehearses);

// A block as it is sent: 1, and the chunks as a zlib stream.
std::string packed_block(const std::string& chunks);
// Likewise of one frame, whose columns have few words that come again: by runs and Huffman codes alone, which takes half the time
// and is smaller.
std::string packed_frame(const std::string& chunks);

// For frames that are `seconds` apart.
FrameUnits units_of(const World& world, const PageOptions& options, double seconds, bool crowd = false);

// The JSON of the chunk "head". `start`: the world's time at the first frame, s.
std::string head_of(World& world, const PageOptions& options, const FrameUnits& units, double seconds, double start);

// Asks the world for what add_events tells.
void ask_for_events(World& world);
// Appends the strongest hits and everything that broke since the last call, without their number, which it returns.
std::size_t add_events(ChunkBytes& to, World& world, const WorldChunks& chunks, double start);

}  // namespace scree::demos
