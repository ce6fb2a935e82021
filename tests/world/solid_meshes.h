// Meshes of solids made by code: cups, rings, gears, bowls, chairs.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "compute/scene.h"
#include "compute/scene/portable_math.h"

namespace scree::tests {

inline void append(Mesh& to, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const glm::uvec3& t : other.triangles) to.triangles.push_back(t + first);
}

// A closed outline of radius and height, counter-clockwise with the radius to the right, turned around y. An outline that begins
// and ends on the axis is closed there.
inline Mesh lathe(const std::vector<glm::vec2>& outline, std::uint32_t sides) {
    Mesh mesh;
    std::vector<std::vector<std::uint32_t>> rings;
    for (const glm::vec2& at : outline) {
        std::vector<std::uint32_t>& ring = rings.emplace_back();
        for (std::uint32_t k = 0; k < sides; ++k) {
            if (k == 0 || at.x > 0) {
                const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(sides);
                mesh.vertices.emplace_back(at.x * portable::cos(angle), at.y, at.x * portable::sin(angle));
            }
            ring.push_back(static_cast<std::uint32_t>(mesh.vertices.size() - 1));
        }
    }
    const bool on_axis = outline.front().x == 0 && outline.back().x == 0;
    for (std::size_t i = 0; i + (on_axis ? 1 : 0) < rings.size(); ++i) {
        const auto &low = rings[i], &high = rings[(i + 1) % rings.size()];
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t l = (k + 1) % sides;
            if (low[k] != low[l]) mesh.triangles.emplace_back(high[l], low[l], low[k]);
            if (high[k] != high[l]) mesh.triangles.emplace_back(high[k], high[l], low[k]);
        }
    }
    return mesh;
}

// Its base at y = 0.
inline Mesh cup_mesh(float radius, float height, float wall, float floor, std::uint32_t sides = 48) {
    const float inner = radius - wall;
    return lathe({{0, 0}, {radius, 0}, {radius, height}, {inner, height}, {inner, floor}, {0, floor}}, sides);
}

inline Mesh ring_mesh(float radius, float thickness, std::uint32_t sides = 48, std::uint32_t around = 24) {
    std::vector<glm::vec2> outline;
    for (std::uint32_t i = 0; i < around; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(around);
        outline.emplace_back(radius + thickness * portable::cos(angle), thickness * portable::sin(angle));
    }
    return lathe(outline, sides);
}

// About z; `half`: its thickness.
inline Mesh gear_mesh(std::uint32_t teeth, float root, float tip, float half, float bore) {
    std::vector<glm::vec2> rim, hole;
    const float pitch = 2 * std::numbers::pi_v<float> / static_cast<float>(teeth);
    for (std::uint32_t i = 0; i < teeth; ++i)
        for (const auto& [turn, radius] :
             std::array<std::pair<float, float>, 4>{std::pair{-0.27f, root}, {-0.11f, tip}, {0.11f, tip}, {0.27f, root}}) {
            const float angle = pitch * (static_cast<float>(i) + turn);
            const glm::vec2 along{portable::cos(angle), portable::sin(angle)};
            rim.push_back(along * radius);
            hole.push_back(along * bore);
        }
    const auto count = static_cast<std::uint32_t>(rim.size());
    Mesh mesh;
    for (const auto* outline : {&rim, &hole})
        for (const float z : {-half, half})
            for (const glm::vec2& at : *outline) mesh.vertices.emplace_back(at.x, at.y, z);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count, h = 2 * count;
        const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
            mesh.triangles.emplace_back(a, b, c);
            mesh.triangles.emplace_back(a, c, d);
        };
        quad(i, j, count + j, count + i);                          // rim
        quad(h + j, h + i, h + count + i, h + count + j);          // bore
        quad(count + i, count + j, h + count + j, h + count + i);  // front
        quad(j, i, h + i, h + j);                                  // back
    }
    return mesh;
}

inline Mesh box_mesh(vec3 centre, vec3 half) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.vertices.push_back(centre + half * vec3(i & 4 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1));
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                      {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return mesh;
}

inline double volume_of(const Mesh& mesh) {
    double six = 0;
    for (const glm::uvec3& t : mesh.triangles)
        six +=
            glm::dot(glm::dvec3(mesh.vertices[t.x]), glm::cross(glm::dvec3(mesh.vertices[t.y]), glm::dvec3(mesh.vertices[t.z])));
    return six / 6;
}

}  // namespace scree::tests
