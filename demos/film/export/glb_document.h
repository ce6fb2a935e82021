// The JSON part of a .glb file, and the bytes of its meshes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "demos/film/export/glb_meshes.h"

namespace scree::demos {

enum GlbChannel : std::uint32_t { glb_translation, glb_rotation, glb_scale };
constexpr std::size_t glb_channels = 3;
// Bytes of a key's value: floats, and quaternions in normalised 16 bits (to 0.004 degrees).
constexpr std::array<std::size_t, glb_channels> glb_value_bytes{12, 8, 12};
// Colours: of momentum from none to the most; the next one is that of what does not move; then bodies' own. Those that nodes
// have are materials of the file.
constexpr std::size_t glb_colors = 24;

struct GlbNode {
    std::string name;
    std::size_t mesh = 0, color = 0;
    glm::vec3 position{0};  // m, at the start, as below
    glm::vec4 orientation{0, 0, 0, 1};
    glm::vec3 size{1};                             // its scale; 0: not there
    std::array<std::size_t, glb_channels> keys{};  // with fewer than two it stays as it is at the start
    std::array<float, glb_channels> last{};        // s, time of the last key; that of the first is 0
};

struct GlbDocument {
    std::string json;
    std::string mesh_bytes;
    // Behind those: node by node, channel by channel the times, then the values, of what has two keys or more.
    std::uint64_t animation_bytes = 0;
};
// `greatest`: the momentum of the last colour, kg m/s; `own`: further colours, linear.
GlbDocument glb_document(const std::vector<GlbNode>& nodes, const std::vector<Triangles>& meshes, double greatest,
                         const std::vector<glm::vec3>& own);

}  // namespace scree::demos
