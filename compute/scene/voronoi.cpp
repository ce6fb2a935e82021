// Each cell is the region's box, cut by the region's planes and by those halfway to the other points, nearest first, until the
// next is too far to cut. Sums are in one order and nothing is left to a library's rounding: the cells have the same bits
// everywhere.
#include "compute/scene/voronoi.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

namespace scree {

namespace {

using glm::dvec3;

class Polyhedron {
public:
    explicit Polyhedron(dvec3 half)
        : faces_{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}},
          touching_(1e-12 * glm::length(half)) {
        for (int k = 0; k < 8; ++k) corners_.push_back(half * dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    }

    // Leaves the part where dot(normal, x) <= distance.
    void cut(dvec3 normal, double distance) {
        std::vector<bool> gone;
        for (const dvec3& corner : corners_) gone.push_back(glm::dot(normal, corner) - distance > touching_);
        if (std::find(gone.begin(), gone.end(), true) == gone.end()) return;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;  // of edges, from the corner that stays
        const auto crossing = [&](std::uint32_t stays, std::uint32_t goes) {
            const auto [found, is_new] = crossings.try_emplace({stays, goes}, static_cast<std::uint32_t>(corners_.size()));
            if (is_new) {
                const dvec3 from = corners_[stays], way = corners_[goes] - from;
                const double part = (distance - glm::dot(normal, from)) / glm::dot(normal, way);
                corners_.push_back(from + way * std::clamp(part, 0.0, 1.0));
            }
            return found->second;
        };
        std::map<std::uint32_t, std::uint32_t> rim;  // of the new face: each corner's next
        for (Face& face : faces_) {
            Face left;
            std::uint32_t leaves = 0, enters = 0;
            for (std::size_t k = 0; k < face.size(); ++k) {
                const std::uint32_t one = face[k], next = face[(k + 1) % face.size()];
                if (!gone[one]) left.push_back(one);
                if (!gone[one] && gone[next]) left.push_back(leaves = crossing(one, next));
                if (gone[one] && !gone[next]) left.push_back(enters = crossing(next, one));
            }
            if (leaves != enters) rim.emplace(enters, leaves);
            face = std::move(left);
        }
        std::erase_if(faces_, [](const Face& face) { return face.size() < 3; });
        Face& made = faces_.emplace_back();
        for (std::uint32_t at = rim.empty() ? 0 : rim.begin()->first; rim.contains(at); at = rim.extract(at).mapped())
            made.push_back(at);
        if (!rim.empty() || made.size() < 3) faces_.clear();  // rounding left no closed surface, or nothing is left
        forget_unused();
    }

    double farthest_from(dvec3 point) const {
        double most = 0;
        for (const dvec3& corner : corners_) most = std::max(most, glm::length(corner - point));
        return most;
    }

    Cell cell() const {
        Cell made{corners_, dvec3(0)};
        double volume = 0;
        for (const Face& face : faces_)
            for (std::size_t k = 1; k + 1 < face.size(); ++k) {
                const dvec3 a = corners_[face[0]], b = corners_[face[k]], c = corners_[face[k + 1]], o = corners_[0];
                const double part = glm::dot(a - o, glm::cross(b - o, c - o));
                volume += part;
                made.centre += part * 0.25 * (a + b + c + o);
            }
        if (!(volume > 0)) return {};
        made.centre /= volume;
        return made;
    }

private:
    using Face = std::vector<std::uint32_t>;  // corners, counter-clockwise from outside

    void forget_unused() {
        constexpr std::uint32_t unused = ~0u;
        std::vector<std::uint32_t> place(corners_.size(), unused);
        for (const Face& face : faces_)
            for (const std::uint32_t corner : face) place[corner] = 0;
        std::vector<dvec3> kept;
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            if (place[k] == unused) continue;
            place[k] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(corners_[k]);
        }
        corners_ = std::move(kept);
        for (Face& face : faces_)
            for (std::uint32_t& corner : face) corner = place[corner];
    }

    std::vector<dvec3> corners_;
    std::vector<Face> faces_;
    double touching_;  // corners this close to a plane lie in it, m
};

}  // namespace

bool Region::holds(dvec3 point) const {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const glm::dvec4& plane) { return glm::dot(dvec3(plane), point) < 0.999 * plane.w; });
}

std::vector<Cell> cells_of(const Region& region, std::span<const dvec3> points) {
    Polyhedron whole(1.001 * region.half);
    for (const glm::dvec4& plane : region.planes) whole.cut(dvec3(plane), plane.w);
    std::vector<Cell> cells;
    std::vector<std::size_t> others(points.size());
    std::vector<double> distances(points.size());
    for (const dvec3& point : points) {
        std::iota(others.begin(), others.end(), std::size_t{0});
        std::transform(points.begin(), points.end(), distances.begin(),
                       [&](const dvec3& other) { return glm::length(other - point); });
        std::stable_sort(others.begin(), others.end(), [&](auto one, auto other) { return distances[one] < distances[other]; });
        Polyhedron left = whole;
        for (const std::size_t other : others) {
            if (&points[other] == &point) continue;
            if (distances[other] > 2 * left.farthest_from(point)) break;
            const dvec3 normal = (points[other] - point) / distances[other];
            left.cut(normal, glm::dot(normal, 0.5 * (points[other] + point)));
        }
        const Cell made = left.cell();
        if (made.corners.size() >= 4) cells.push_back(made);
    }
    return cells;
}

}  // namespace scree
