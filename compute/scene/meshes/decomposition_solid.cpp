// Meshes as closed solids.
#include "compute/scene/meshes/decomposition_solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "compute/scene/meshes/mesh.h"

namespace scree::decomposition {

namespace {

using glm::dmat3;

constexpr double nearly_flat = 1e-6;  // volume of a mesh that encloses nothing, over that of its box

// Fans from the middle of each rim.
void close(Solid& solid) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;  // of each edge from its lower to its higher point
    for (const uvec3& t : solid.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            runs[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
    std::map<std::uint32_t, std::uint32_t> root;
    const auto root_of = [&](std::uint32_t point) {
        root.try_emplace(point, point);
        while (root[point] != point) point = root[point];
        return point;
    };
    for (const auto& [edge, net] : runs)
        for (int n = 0; n < std::abs(net); ++n) {
            open.push_back(net > 0 ? edge : std::pair(edge.second, edge.first));
            const std::uint32_t a = root_of(edge.first), b = root_of(edge.second);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::uint32_t, std::pair<dvec3, double>> rims;
    for (const auto& [a, b] : open) {
        auto& [sum, count] = rims.try_emplace(root_of(a), dvec3(0), 0.0).first->second;
        sum += solid.points[a] + solid.points[b];
        count += 2;
    }
    std::map<std::uint32_t, std::uint32_t> middles;
    for (const auto& [rim, of] : rims) {
        middles[rim] = static_cast<std::uint32_t>(solid.points.size());
        solid.points.push_back(of.first / of.second);
    }
    for (const auto& [a, b] : open) {
        solid.triangles.emplace_back(b, a, middles[root_of(a)]);
        const uvec3& t = solid.triangles.back();
        const dvec3 across = glm::cross(solid.points[t.y] - solid.points[t.x], solid.points[t.z] - solid.points[t.x]);
        if (glm::dot(across, across) > 1e-12) ++solid.closed;  // else where a triangle without area was
    }
}

double six_volumes(const Solid& solid, const std::vector<std::uint32_t>& of) {
    double six = 0;
    for (const std::uint32_t i : of) {
        const uvec3& t = solid.triangles[i];
        six += glm::dot(solid.points[t.x], glm::cross(solid.points[t.y], solid.points[t.z]));
    }
    return six;
}

// Triangles that hang together, by their lowest point.
std::vector<std::vector<std::uint32_t>> shells_of(const Solid& solid) {
    std::vector<std::uint32_t> root(solid.points.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto root_of = [&](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const uvec3& t : solid.triangles)
        for (const std::uint32_t other : {t.y, t.z}) {
            const std::uint32_t a = root_of(t.x), b = root_of(other);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::uint32_t, std::vector<std::uint32_t>> shells;
    for (std::uint32_t i = 0; i < solid.triangles.size(); ++i) shells[root_of(solid.triangles[i].x)].push_back(i);
    std::vector<std::vector<std::uint32_t>> all;
    for (auto& [first, shell] : shells) all.push_back(std::move(shell));
    return all;
}

// How often a shell winds around a point: crossings of a ray along x.
int winding(const Solid& solid, const std::vector<std::uint32_t>& shell, const dvec3& at) {
    int winds = 0;
    for (const std::uint32_t i : shell) {
        const uvec3& t = solid.triangles[i];
        int inside = 0;
        for (int k = 0; k < 3; ++k) {
            const dvec3 a = solid.points[std::min(t[k], t[(k + 1) % 3])], b = solid.points[std::max(t[k], t[(k + 1) % 3])];
            const double turn = (b.y - a.y) * (at.z - a.z) - (b.z - a.z) * (at.y - a.y);
            inside += ((turn >= 0) == (t[k] < t[(k + 1) % 3])) ? 1 : -1;
        }
        if (inside != 3 && inside != -3) continue;
        const dvec3 a = solid.points[t.x], normal = glm::cross(solid.points[t.y] - a, solid.points[t.z] - a);
        if (normal.x != 0 && a.x - ((at.y - a.y) * normal.y + (at.z - a.z) * normal.z) / normal.x > at.x)
            winds += inside > 0 ? 1 : -1;
    }
    return winds;
}

// Turns shells that face inwards and are no cavity of another one.
void turn_out(Solid& solid) {
    const std::vector<std::vector<std::uint32_t>> shells = shells_of(solid);
    std::vector<bool> inward;
    for (const auto& shell : shells) inward.push_back(six_volumes(solid, shell) < 0);
    for (std::size_t i = 0; i < shells.size(); ++i) {
        if (!inward[i]) continue;
        // Places on triangles, off their middles, so that their rays meet no edge of others. A cavity has all of them inside.
        bool cavity = true;
        for (std::size_t n = 0; n < 16 && cavity; ++n) {
            const uvec3& t = solid.triangles[shells[i][n * shells[i].size() / 16]];
            const dvec3 at = solid.points[t.x] * 0.41 + solid.points[t.y] * 0.33 + solid.points[t.z] * 0.26;
            int winds = 0;
            for (std::size_t k = 0; k < shells.size(); ++k)
                if (k != i && !inward[k]) winds += winding(solid, shells[k], at);
            cavity = winds > 0;
        }
        if (cavity) continue;
        solid.inside_out = true;
        for (const std::uint32_t n : shells[i]) std::swap(solid.triangles[n].y, solid.triangles[n].z);
    }
}

}  // namespace

dvec3 normal_of(const Solid& solid, const uvec3& t) {
    const dvec3 across = glm::cross(solid.points[t.y] - solid.points[t.x], solid.points[t.z] - solid.points[t.x]);
    const double length = std::sqrt(glm::dot(across, across));
    return length > 0 ? across / length : dvec3(0, 1, 0);
}

Solid solid_of(std::span<const vec3> vertices, std::span<const uvec3> given) {
    Solid solid;
    const std::vector<uvec3> triangles = welded_triangles(vertices, given);
    dvec3 lower(1e300), upper(-1e300);
    std::map<std::uint32_t, std::uint32_t> place;
    for (const uvec3& t : triangles)
        for (int k = 0; k < 3; ++k) {
            place.try_emplace(t[k], 0);
            lower = glm::min(lower, dvec3(vertices[t[k]]));
            upper = glm::max(upper, dvec3(vertices[t[k]]));
        }
    const dvec3 extent = upper - lower;
    solid.size = std::max({extent.x, extent.y, extent.z});
    solid.middle = (lower + upper) * 0.5;
    if (!(solid.size >= 1e-3)) throw DecompositionError("all its points lie within 0.001 m");
    for (auto& [vertex, at] : place) {
        at = static_cast<std::uint32_t>(solid.points.size());
        solid.points.push_back((dvec3(vertices[vertex]) - solid.middle) / solid.size);
    }
    for (const uvec3& t : triangles) solid.triangles.emplace_back(place[t.x], place[t.y], place[t.z]);
    close(solid);
    turn_out(solid);
    std::vector<std::uint32_t> all(solid.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    if (!(six_volumes(solid, all) / 6 > nearly_flat))
        throw DecompositionError(
            solid.closed > 0
                ? "it is a sheet that encloses no volume (" + std::to_string(solid.closed) +
                      " open edges); give it a thickness, or use its hull"
                : "it encloses no volume: it is flat, or its faces cancel out; give it a thickness, or use its hull");
    return solid;
}

// Eberly, Polyhedral mass properties, summed over tetrahedra from the middle.
void integrate(const Solid& solid, ConvexParts& made) {
    double volume = 0;
    dvec3 first(0);
    dmat3 second(0);
    for (const uvec3& t : solid.triangles) {
        const dvec3 a = solid.points[t.x], b = solid.points[t.y], c = solid.points[t.z], sum = a + b + c;
        const double six = glm::dot(a, glm::cross(b, c));
        volume += six / 6;
        first += sum * (six / 24);
        second += (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) + glm::outerProduct(sum, sum)) *
                  (six / 120);
    }
    const dvec3 centre = first / volume;
    second -= glm::outerProduct(centre, centre) * volume;
    const double size = solid.size, cube = size * size * size;
    made.volume = volume * cube;
    made.centre = solid.middle + centre * size;
    made.inertia = (dmat3(second[0][0] + second[1][1] + second[2][2]) - second) * (cube * size * size);
    made.closed = solid.closed;
    made.inside_out = solid.inside_out;
}

}  // namespace scree::decomposition
