// Cutting facets edge by edge: crossings of a facet's outline with the plane, sorted along their line, pair to new edges,
// and all of these together bound the section, which is a facet itself. Each point lies on one side, for all facets.
#include "compute/scene/meshes/solid_pieces.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace scree {

namespace {

using glm::dvec3;
using Edge = SolidPiece::Edge;

struct Crossing {
    double along;
    std::uint32_t point;
    bool rises;  // from below to above
};

// Which pairs of crossings are edges: from the rising one to the falling one they close what is below.
void pair_up(std::vector<Crossing>& crossings, std::vector<Edge>& closing) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& x, const Crossing& y) {
        return std::tie(x.along, x.point, x.rises) < std::tie(y.along, y.point, y.rises);
    });
    std::vector<Crossing> waiting;
    for (const Crossing& one : crossings) {
        if (waiting.empty() || waiting.back().rises == one.rises) {
            waiting.push_back(one);
            continue;
        }
        const Crossing other = waiting.back();
        waiting.pop_back();
        closing.push_back(one.rises ? Edge{one.point, other.point} : Edge{other.point, one.point});
    }
}

}  // namespace

void SolidPiece::add(const dvec3& normal, const std::vector<Edge>& outline) {
    if (outline.empty()) return;
    edges.insert(edges.end(), outline.begin(), outline.end());
    ends.push_back(static_cast<std::uint32_t>(edges.size()));
    normals.push_back(normal);
}

std::pair<SolidPiece, SolidPiece> cut(const SolidPiece& piece, const CuttingPlane& plane, std::vector<dvec3>& points) {
    SolidPiece below, above;
    std::unordered_map<std::uint64_t, std::uint32_t> made;
    const auto height = [&](std::uint32_t point) { return glm::dot(plane.normal, points[point]) - plane.offset; };
    const auto crossing_of = [&](std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const auto [found, fresh] =
            made.try_emplace((std::uint64_t{low} << 32) | high, static_cast<std::uint32_t>(points.size()));
        if (fresh) {
            const double of_low = height(low), of_high = height(high);
            points.push_back(points[low] + (points[high] - points[low]) * (of_low / (of_low - of_high)));
        }
        return found->second;
    };
    std::vector<Edge> low, high, closing, section;
    std::vector<Crossing> crossings;
    std::uint32_t begin = 0;
    for (std::size_t f = 0; f < piece.ends.size(); begin = piece.ends[f++]) {
        low.clear(), high.clear(), crossings.clear(), closing.clear();
        const dvec3 line = glm::cross(piece.normals[f], plane.normal);
        for (std::uint32_t e = begin; e < piece.ends[f]; ++e) {
            const Edge edge = piece.edges[e];
            const bool from_above = height(edge.from) >= 0, to_above = height(edge.to) >= 0;
            if (from_above == to_above) {
                (from_above ? high : low).push_back(edge);
                continue;
            }
            const std::uint32_t at = crossing_of(edge.from, edge.to);
            (from_above ? high : low).push_back({edge.from, at});
            (to_above ? high : low).push_back({at, edge.to});
            crossings.push_back({glm::dot(line, points[at]), at, to_above});
        }
        pair_up(crossings, closing);
        for (const Edge& edge : closing) {
            low.push_back(edge);
            high.push_back({edge.to, edge.from});
            section.push_back({edge.to, edge.from});
        }
        below.add(piece.normals[f], low);
        above.add(piece.normals[f], high);
    }
    below.add(plane.normal, section);
    for (Edge& edge : section) std::swap(edge.from, edge.to);
    above.add(-plane.normal, section);
    return {std::move(below), std::move(above)};
}

// Gauss's theorem: a facet's share is its area times its distance from a point.
double volume_of(const SolidPiece& piece, const std::vector<dvec3>& points) {
    if (piece.edges.empty()) return 0;
    double six = 0;
    const dvec3 from = points[piece.edges[0].from];
    std::uint32_t begin = 0;
    for (std::size_t f = 0; f < piece.ends.size(); begin = piece.ends[f++]) {
        const dvec3 base = points[piece.edges[begin].from];
        dvec3 area(0);
        for (std::uint32_t e = begin; e < piece.ends[f]; ++e)
            area += glm::cross(points[piece.edges[e].from] - base, points[piece.edges[e].to] - base);
        six += glm::dot(area, base - from);
    }
    return six / 6;
}

std::vector<std::uint32_t> points_of(const SolidPiece& piece) {
    std::vector<std::uint32_t> all;
    for (const Edge& edge : piece.edges) all.push_back(edge.from);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

std::vector<SolidPiece> connected(SolidPiece piece, const std::vector<dvec3>& points) {
    const std::vector<std::uint32_t> used = points_of(piece);
    const auto place = [&](std::uint32_t point) {
        return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), point) - used.begin());
    };
    std::vector<std::uint32_t> root(used.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto root_of = [&](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    std::vector<std::uint32_t> first_of(piece.ends.size());
    std::uint32_t begin = 0;
    for (std::size_t f = 0; f < piece.ends.size(); begin = piece.ends[f++]) {
        first_of[f] = place(piece.edges[begin].from);
        for (std::uint32_t e = begin; e < piece.ends[f]; ++e) {
            const std::uint32_t a = root_of(first_of[f]), b = root_of(place(piece.edges[e].from));
            root[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<SolidPiece> parts;
    std::unordered_map<std::uint32_t, std::size_t> part_of;
    begin = 0;
    for (std::size_t f = 0; f < piece.ends.size(); begin = piece.ends[f++]) {
        const auto [found, fresh] = part_of.try_emplace(root_of(first_of[f]), parts.size());
        if (fresh) parts.emplace_back();
        parts[found->second].add(piece.normals[f],
                                 {piece.edges.begin() + begin, piece.edges.begin() + static_cast<std::ptrdiff_t>(piece.ends[f])});
    }
    if (parts.size() == 1) return parts;
    std::vector<SolidPiece> whole{std::move(piece)};
    for (const SolidPiece& part : parts)
        if (volume_of(part, points) < -1e-9) return whole;  // a cavity
    return parts;
}

}  // namespace scree
