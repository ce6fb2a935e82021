// Cleaning a mesh and computing contact limits from neighbouring triangles.
#include "compute/scene/meshes/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace scree {

namespace {

using glm::dvec3;
using glm::uvec3;
using glm::vec3;

// Relative to the mesh's size: closer vertices are welded. Programs write equal positions with rounding errors.
constexpr double same_place = 1e-7;
// Relative to a triangle's longest edge: flatter, and its normal is rounding.
constexpr double least_height = 1e-5;
// Sine of half a degree: smaller bends count as flat.
constexpr double flat_bend = 0.0087;

// Cells of a spatial hash.
using Cell = std::array<std::int64_t, 3>;
struct HashOfCell {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t at : cell)
            hash = (hash ^ static_cast<std::uint64_t>(at)) * 0x9E3779B97F4A7C15u, hash ^= hash >> 29;
        return hash;
    }
};
constexpr std::uint32_t none = ~0u;

// For each vertex the first one at the same position, by a spatial hash; neighbouring cells are searched too. Cells count
// from the lower corner of the mesh: a number of cells from the origin could exceed what a double counts exactly.
std::vector<std::uint32_t> welded(std::span<const vec3> vertices) {
    dvec3 lower(1e300), upper(-1e300);
    for (const vec3& v : vertices) {
        lower = glm::min(lower, dvec3(v));
        upper = glm::max(upper, dvec3(v));
    }
    const double tolerance = vertices.empty() ? 0 : same_place * glm::length(upper - lower);
    const double inverse = tolerance > 0 ? 0.5 / tolerance : 1e9;
    const auto cell_at = [](const dvec3& place) {
        return Cell{static_cast<std::int64_t>(place.x), static_cast<std::int64_t>(place.y), static_cast<std::int64_t>(place.z)};
    };
    std::unordered_map<Cell, std::uint32_t, HashOfCell> last_in;  // the last vertex of each cell,
    std::vector<std::uint32_t> before_it(vertices.size(), none);  // and the one before each in its cell
    last_in.reserve(vertices.size());
    std::vector<std::uint32_t> first(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const dvec3 v = dvec3(vertices[i]) - lower;
        const auto low = glm::floor((v - tolerance) * inverse), high = glm::floor((v + tolerance) * inverse);
        first[i] = i;
        for (double x = low.x; x <= high.x && first[i] == i; ++x)
            for (double y = low.y; y <= high.y && first[i] == i; ++y)
                for (double z = low.z; z <= high.z && first[i] == i; ++z) {
                    const auto at = last_in.find(cell_at({x, y, z}));
                    for (std::uint32_t other = at == last_in.end() ? none : at->second; other != none; other = before_it[other])
                        if (glm::length(dvec3(vertices[other]) - dvec3(vertices[i])) <= tolerance)
                            first[i] = std::min(first[i], other);
                }
        if (first[i] != i) continue;
        const auto [own, fresh] = last_in.try_emplace(cell_at(glm::floor(v * inverse)), i);
        if (!fresh) before_it[i] = std::exchange(own->second, i);
    }
    return first;
}

dvec3 normal_of(std::span<const vec3> vertices, const uvec3& t) {
    const dvec3 a(vertices[t[0]]), b(vertices[t[1]]), c(vertices[t[2]]);
    return glm::normalize(glm::cross(b - a, c - a));
}

bool has_area(std::span<const vec3> vertices, const uvec3& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    const dvec3 a(vertices[t[0]]), b(vertices[t[1]]), c(vertices[t[2]]);
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return glm::length(glm::cross(b - a, c - a)) > least_height * longest * longest;
}

uvec3 rotated_to_least(uvec3 t) {
    while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
    return t;
}

// The triangles that are the first with their corners.
std::vector<bool> first_of_equal(const std::vector<uvec3>& triangles) {
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::tuple(triangles[i][0], triangles[i][1], triangles[i][2]); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t x, std::uint32_t y) { return std::tuple(key(x), x) < std::tuple(key(y), y); });
    std::vector<bool> is_first(triangles.size());
    for (std::size_t k = 0; k < order.size(); ++k) is_first[order[k]] = k == 0 || key(order[k]) != key(order[k - 1]);
    return is_first;
}

struct Edges {
    std::vector<std::array<std::uint32_t, 3>> neighbours;  // by triangle, of each edge; none
    std::size_t open = 0, branching = 0;
};

// An edge's neighbour: if it has one triangle on each side, of the same orientation.
Edges edges_of(const std::vector<uvec3>& triangles) {
    struct Side {
        std::uint32_t low, high, triangle;
        std::uint8_t corner, along;  // along: from the lower to the higher vertex index
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[i][k], triangles[i][(k + 1) % 3]);
            sides.push_back({low, high, i, k, triangles[i][k] == low});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return std::tie(x.low, x.high, x.along, x.triangle) < std::tie(y.low, y.high, y.along, y.triangle);
    });
    Edges edges;
    edges.neighbours.assign(triangles.size(), {none, none, none});
    for (auto one = sides.begin(); one != sides.end();) {
        const auto end = std::find_if(one, sides.end(), [&](const Side& o) { return o.low != one->low || o.high != one->high; });
        if (end - one == 2 && one[0].along != one[1].along) {
            edges.neighbours[one[0].triangle][one[0].corner] = one[1].triangle;
            edges.neighbours[one[1].triangle][one[1].corner] = one[0].triangle;
        } else {
            ++(end - one == 1 ? edges.open : edges.branching);
        }
        one = end;
    }
    return edges;
}

vec3 limit_of(dvec3 own, dvec3 outward, const dvec3* neighbours) {
    if (!neighbours) return vec3(outward);
    return glm::dot(*neighbours, outward) > flat_bend ? vec3(*neighbours) : vec3(own);
}

}  // namespace

std::vector<uvec3> welded_triangles(std::span<const vec3> vertices, std::span<const uvec3> given) {
    if (given.empty()) throw MeshError("/triangles", "there are none");
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(vertices[i][k])) throw MeshError("/vertices/" + std::to_string(i), "is not finite");
    for (std::size_t i = 0; i < given.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (given[i][k] >= vertices.size())
                throw MeshError("/triangles/" + std::to_string(i), "vertex " + std::to_string(given[i][k]) + " of " +
                                                                       std::to_string(vertices.size()) + " (they count from 0)");
    const std::vector<std::uint32_t> first = welded(vertices);
    std::vector<uvec3> triangles, all;
    for (const uvec3& t : given) all.push_back(rotated_to_least({first[t[0]], first[t[1]], first[t[2]]}));
    const std::vector<bool> is_first = first_of_equal(all);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (is_first[i] && has_area(vertices, all[i])) triangles.push_back(all[i]);
    if (triangles.empty()) throw MeshError("/triangles", "all of them are degenerate");
    return triangles;
}

MeshForm mesh_form(std::span<const vec3> vertices, std::span<const uvec3> given) {
    MeshForm form;
    const std::vector<uvec3> triangles = welded_triangles(vertices, given);
    form.dropped = given.size() - triangles.size();

    const Edges edges = edges_of(triangles);
    form.open = edges.open;
    form.branching = edges.branching;
    form.triangles.reserve(triangles.size());
    std::vector<dvec3> normals;
    for (const uvec3& t : triangles) normals.push_back(normal_of(vertices, t));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const uvec3& t = triangles[i];
        MeshForm::Triangle made;
        const vec3 corners[3] = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        const vec3 lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
        const vec3 upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
        made.middle = (lower + upper) * 0.5f;
        made.normal = vec3(normals[i]);
        made.half_extents = vec3(0);
        for (int k = 0; k < 3; ++k) {
            made.corners[static_cast<std::size_t>(k)] = corners[k] - made.middle;
            made.half_extents = glm::max(made.half_extents, glm::abs(corners[k] - made.middle));
            form.reach = std::max(form.reach, glm::length(corners[k]));
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            const std::uint32_t other = edges.neighbours[i][static_cast<std::size_t>(k)];
            const dvec3 outward = glm::normalize(glm::cross(dvec3(vertices[to]) - dvec3(vertices[from]), normals[i]));
            made.limits[static_cast<std::size_t>(k)] = limit_of(normals[i], outward, other != none ? &normals[other] : nullptr);
        }
        made.distance = glm::dot(made.normal, made.corners[0]);
        form.triangles.push_back(made);
    }
    return form;
}

MeshForm mesh_form(const HeightField& field) {
    std::vector<vec3> vertices;
    std::vector<uvec3> triangles;
    const float half_x = 0.5f * static_cast<float>(field.columns - 1), half_z = 0.5f * static_cast<float>(field.rows - 1);
    for (std::uint32_t row = 0; row < field.rows; ++row) {
        for (std::uint32_t column = 0; column < field.columns; ++column) {
            const std::uint32_t here = row * field.columns + column;
            vertices.emplace_back((static_cast<float>(column) - half_x) * field.spacing, field.heights[here],
                                  (static_cast<float>(row) - half_z) * field.spacing);
            if (row + 1 == field.rows || column + 1 == field.columns) continue;
            const std::uint32_t below = here + field.columns;
            triangles.emplace_back(here, below, here + 1);
            triangles.emplace_back(here + 1, below, below + 1);
        }
    }
    return mesh_form(vertices, triangles);
}

// Of a closed surface, m^3; below 0 if its normals point inward.
double volume_of(const MeshForm& form) {
    double volume = 0;
    for (const MeshForm::Triangle& t : form.triangles) {
        dvec3 corners[3];
        for (std::size_t k = 0; k < 3; ++k) corners[k] = dvec3(t.corners[k]) + dvec3(t.middle);
        volume += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6;
    }
    return volume;
}

std::string oddities(const MeshForm& form) {
    std::string text;
    const auto say = [&](std::size_t count, const char* one, const char* many, const char* what) {
        if (count == 0) return;
        text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + (count == 1 ? one : many) + what;
    };
    say(form.dropped, "triangle", "triangles", " without area, or repeated, left out");
    say(form.open, "open edge", "open edges", ": bodies that roll over one leave the mesh");
    say(form.branching, "edge", "edges",
        " with more than two triangles, or two of opposite orientation; bodies may catch on these edges");
    say(crossing_triangles(form), "triangle", "triangles",
        " that cut through another: bodies between their faces are pushed both ways");
    if (form.open == 0 && form.branching == 0 && volume_of(form) < 0)
        text += (text.empty() ? "" : "; ") +
                std::string("inside out: its faces point inward, and hold bodies inside; exchange two corners of each triangle");
    return text;
}

const MeshForm* mesh_form_of(const Shape& shape) {
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->form.get();
    if (const auto* field = std::get_if<HeightField>(&shape)) return field->form.get();
    return nullptr;
}

}  // namespace scree
