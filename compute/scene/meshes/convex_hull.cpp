// Quickhull (Barber, Dobkin and Huhdanpaa, 1996) over points that are moved by a ten millionth of their size, so that no
// three lie on a line and no four in a plane: all decisions are then far above rounding.
#include "compute/scene/meshes/convex_hull.h"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

using glm::dvec3;

constexpr std::uint32_t none = ~0u;
constexpr double jitter = 1e-7;
constexpr double flattest = 1e-5;

// -1 to 1, by the point's number.
double scattered(std::uint64_t number) {
    std::uint64_t x = (number + 1) * 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-52 - 1;
}

struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> beside{none, none, none};  // faces over the edges from corner k to the next
    dvec3 normal;
    double offset = 0;
    std::vector<std::uint32_t> outside;  // points
    double most = 0;                     // distance of the farthest of them
    std::uint32_t farthest = none;
    bool alive = true;
};

class Quickhull {
public:
    Quickhull(std::span<const dvec3> points, double within) : within_(within) {
        at_.reserve(points.size());
        for (std::uint64_t i = 0; i < points.size(); ++i)
            at_.push_back(points[i] + jitter * dvec3(scattered(3 * i), scattered(3 * i + 1), scattered(3 * i + 2)));
    }

    bool begin() {
        if (at_.size() < 4) return false;
        std::array<std::uint32_t, 4> first{};
        if (!simplex(first)) return false;
        const auto [a, b, c, d] = first;
        for (const std::array<std::uint32_t, 3> corners :
             {std::array{a, b, c}, std::array{a, d, b}, std::array{b, d, c}, std::array{c, d, a}})
            add_face(corners);
        for (std::uint32_t f = 0; f < 4; ++f)
            for (std::size_t k = 0; k < 3; ++k)
                for (std::uint32_t g = 0; g < 4; ++g)
                    for (std::size_t m = 0; m < 3; ++m)
                        if (faces_[f].corners[k] == faces_[g].corners[(m + 1) % 3] &&
                            faces_[f].corners[(k + 1) % 3] == faces_[g].corners[m])
                            faces_[f].beside[k] = g;
        corners_ = {a, b, c, d};
        const std::array<std::uint32_t, 4> fresh{0, 1, 2, 3};
        for (std::uint32_t i = 0; i < at_.size(); ++i) give(i, fresh);
        return true;
    }

    void grow(std::size_t most) {
        while (corners_.size() < most) {
            std::uint32_t best = none;
            for (std::uint32_t f = 0; f < faces_.size(); ++f)
                if (faces_[f].alive && faces_[f].farthest != none && (best == none || faces_[f].most > faces_[best].most))
                    best = f;
            if (best == none) return;
            add_point(best);
        }
    }

    ConvexHull made(std::span<const dvec3> points) {
        ConvexHull hull;
        std::sort(corners_.begin(), corners_.end());
        hull.corners = corners_;
        for (const Face& face : faces_) {
            if (!face.alive) continue;
            hull.faces.push_back(face.corners);
            hull.planes.push_back({face.normal, face.offset});
            const dvec3 from = points[corners_[0]];
            const dvec3 a = points[face.corners[0]] - from, b = points[face.corners[1]] - from,
                        c = points[face.corners[2]] - from;
            hull.volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
        return hull;
    }

private:
    double above(const Face& face, std::uint32_t point) const { return glm::dot(face.normal, at_[point]) - face.offset; }

    void add_face(const std::array<std::uint32_t, 3>& corners) {
        Face& face = faces_.emplace_back();
        face.corners = corners;
        const dvec3 a = at_[corners[0]];
        const dvec3 across = glm::cross(at_[corners[1]] - a, at_[corners[2]] - a);
        face.normal = across / std::sqrt(glm::dot(across, across));
        face.offset = glm::dot(face.normal, a);
    }

    template <class Measure>
    std::uint32_t farthest(const Measure& measure, double& most) const {
        std::uint32_t best = 0;
        most = -1;
        for (std::uint32_t i = 0; i < at_.size(); ++i)
            if (const double m = measure(at_[i]); m > most) most = m, best = i;
        return best;
    }

    bool simplex(std::array<std::uint32_t, 4>& first) const {
        double length = 0, width = 0, depth = 0;
        const std::uint32_t a = farthest([&](const dvec3& p) { return glm::dot(p - at_[0], p - at_[0]); }, length);
        const std::uint32_t b = farthest([&](const dvec3& p) { return glm::dot(p - at_[a], p - at_[a]); }, length);
        length = std::sqrt(length);
        if (length < flattest) return false;
        const dvec3 along = (at_[b] - at_[a]) / length;
        const auto across = [&](const dvec3& p) { return glm::cross(p - at_[a], along); };
        const std::uint32_t c = farthest([&](const dvec3& p) { return glm::dot(across(p), across(p)); }, width);
        if (std::sqrt(width) < flattest) return false;
        dvec3 normal = glm::cross(at_[b] - at_[a], at_[c] - at_[a]);
        normal /= std::sqrt(glm::dot(normal, normal));
        const std::uint32_t d = farthest([&](const dvec3& p) { return std::abs(glm::dot(p - at_[a], normal)); }, depth);
        if (depth < flattest) return false;
        first = {a, b, c, d};
        if (glm::dot(at_[d] - at_[a], normal) > 0) std::swap(first[1], first[2]);
        return true;
    }

    // To the face of these that it lies farthest outside of.
    void give(std::uint32_t point, std::span<const std::uint32_t> faces) {
        double most = within_;
        std::uint32_t best = none;
        for (const std::uint32_t f : faces)
            if (const double distance = above(faces_[f], point); distance > most) most = distance, best = f;
        if (best == none) return;
        Face& face = faces_[best];
        face.outside.push_back(point);
        if (most > face.most) face.most = most, face.farthest = point;
    }

    void forget(std::uint32_t f, std::uint32_t point) {
        Face& face = faces_[f];
        std::erase(face.outside, point);
        face.most = 0;
        face.farthest = none;
        for (const std::uint32_t other : face.outside)
            if (const double distance = above(face, other); distance > face.most) face.most = distance, face.farthest = other;
    }

    void add_point(std::uint32_t from) {
        const std::uint32_t point = faces_[from].farthest;
        std::vector<std::uint32_t> seen{from};
        std::vector<bool> visible(faces_.size());
        visible[from] = true;
        struct Edge {
            std::uint32_t a, b, over;
        };
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (const std::uint32_t other : faces_[seen[i]].beside)
                if (!visible[other] && above(faces_[other], point) > 0) {
                    visible[other] = true;
                    seen.push_back(other);
                }
        std::vector<Edge> horizon;
        for (const std::uint32_t f : seen)
            for (std::size_t k = 0; k < 3; ++k)
                if (!visible[faces_[f].beside[k]])
                    horizon.push_back({faces_[f].corners[k], faces_[f].corners[(k + 1) % 3], faces_[f].beside[k]});
        // Once around, from each edge to the one that begins where it ends.
        std::vector<Edge> ring{horizon[0]};
        while (ring.size() < horizon.size()) {
            const auto next = std::find_if(horizon.begin(), horizon.end(), [&](const Edge& e) { return e.a == ring.back().b; });
            if (next == horizon.end() || next->a == ring[0].a) break;
            ring.push_back(*next);
        }
        if (ring.size() != horizon.size() || ring.back().b != ring[0].a) return forget(from, point);
        const auto first = static_cast<std::uint32_t>(faces_.size()), count = static_cast<std::uint32_t>(ring.size());
        std::vector<std::uint32_t> fresh;
        for (std::uint32_t i = 0; i < count; ++i) {
            add_face({ring[i].a, ring[i].b, point});
            faces_.back().beside = {ring[i].over, first + (i + 1) % count, first + (i + count - 1) % count};
            Face& over = faces_[ring[i].over];
            for (std::size_t k = 0; k < 3; ++k)
                if (over.corners[k] == ring[i].b && over.corners[(k + 1) % 3] == ring[i].a) over.beside[k] = first + i;
            fresh.push_back(first + i);
        }
        corners_.push_back(point);
        for (const std::uint32_t f : seen) {
            faces_[f].alive = false;
            std::vector<std::uint32_t> homeless;
            homeless.swap(faces_[f].outside);
            for (const std::uint32_t other : homeless)
                if (other != point) give(other, fresh);
        }
        // Corners that are now inside.
        std::erase_if(corners_, [&](std::uint32_t corner) {
            const bool was = std::any_of(seen.begin(), seen.end(), [&](std::uint32_t f) {
                return std::find(faces_[f].corners.begin(), faces_[f].corners.end(), corner) != faces_[f].corners.end();
            });
            return was && corner != point &&
                   std::none_of(ring.begin(), ring.end(), [&](const Edge& edge) { return edge.a == corner; });
        });
    }

    double within_;
    std::vector<dvec3> at_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

ConvexHull convex_hull(std::span<const dvec3> points, std::size_t most, double within) {
    Quickhull quickhull(points, within);
    if (!quickhull.begin()) return {};
    quickhull.grow(std::max<std::size_t>(most, 4));
    return quickhull.made(points);
}

}  // namespace scree
