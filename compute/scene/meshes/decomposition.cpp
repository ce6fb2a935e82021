// Convex parts of a mesh.
//
// 1. Cut: of the part with the greatest error, by the best of a few planes through the place of that error: along the axes, in
//    the surface nearest to it, and across that. Best is the plane that leaves the least volume between the halves and their
//    hulls; of equal ones the most even.
// 2. Merge: the two parts whose common hull adds the least volume, while that hull's error is allowed.
// The error of a hull is the greater of how far its points lie from the solid, and how deep the solid's surface lies in it.
#include "compute/scene/meshes/decomposition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "compute/scene/meshes/convex_hull.h"
#include "compute/scene/meshes/decomposition_solid.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/hull_judge.h"
#include "compute/scene/meshes/solid_pieces.h"

namespace scree {

namespace {

using namespace decomposition;

constexpr std::size_t most_pieces = 256, most_corners = 64;
constexpr std::uint64_t corner_effort = 64;  // of a point of a hull that is made, in distances

// A finer wish may take more.
std::uint64_t most_for(const Decomposition& wanted, std::uint64_t most) {
    constexpr double usual = 0.02;
    const double error = static_cast<double>(wanted.error);
    return error < usual ? static_cast<std::uint64_t>(static_cast<double>(most) * (usual / error)) : most;
}

struct PartOfSolid {
    SolidPiece piece;
    double volume = 0;
    std::vector<dvec3> points;  // the hull's corners
    ConvexHull hull;            // of these
    Error error;
};

class Decomposer {
public:
    Decomposer(const Solid& solid, const Decomposition& wanted, Effort& effort)
        : wanted_(wanted),
          effort_(effort),
          error_(static_cast<double>(wanted.error)),
          points_(solid.points),
          judge_(solid, static_cast<double>(wanted.error), effort) {
        SolidPiece all;
        for (const uvec3& t : solid.triangles) all.add(normal_of(solid, t), {{t.x, t.y}, {t.y, t.z}, {t.z, t.x}});
        whole_ = all;
    }

    double error_of_hull() {
        const PartOfSolid one = part_of(whole_);
        return one.hull.empty() ? 0 : judge_.of_all({one.hull}, {one.points});
    }

    void cut_up() {
        for (SolidPiece& piece : connected(whole_, points_)) add(std::move(piece));
        double worst = error_;
        while (parts_.size() < most_pieces) {
            const auto next = std::max_element(parts_.begin(), parts_.end(), [](const PartOfSolid& a, const PartOfSolid& b) {
                return a.error.most < b.error.most;
            });
            if (next == parts_.end() || next->error.most <= error_) break;
            worst = std::max(worst, next->error.most);
            effort_.reach(0.8 *
                          std::max(double(parts_.size()) / most_pieces, (worst - next->error.most) / (worst - error_ + 1e-9)));
            const std::optional<CuttingPlane> plane = best_cut(*next);
            if (!plane) {
                next->error.most = 0;  // nothing cuts it
                continue;
            }
            auto [below, above] = cut(next->piece, *plane, points_);
            parts_.erase(next);
            for (SolidPiece* side : {&below, &above})
                for (SolidPiece& piece : connected(std::move(*side), points_)) add(std::move(piece));
        }
        std::erase_if(parts_, [](const PartOfSolid& part) { return part.hull.empty(); });
    }

    void merge() {
        if (wanted_.vertices < most_corners)
            for (PartOfSolid& part : parts_) {
                std::vector<dvec3> all;
                all.swap(part.points);
                give_hull(part, all, wanted_.vertices);
            }
        while (merge_best(error_)) {
        }
        enough_ = parts_.size() <= wanted_.parts;
        for (double limit = error_; parts_.size() > wanted_.parts && limit < 1;) {
            limit *= 1.2;
            while (parts_.size() > wanted_.parts && merge_best(limit)) {
            }
        }
        while (parts_.size() > wanted_.parts && merge_best(1e300)) {
        }
    }

    // In place of parts.
    void take_hull() {
        std::vector<dvec3> all;
        parts_.assign(1, part_of(whole_));
        all.swap(parts_[0].points);
        give_hull(parts_[0], all, wanted_.vertices);
        enough_ = true;
    }

    std::vector<PartOfSolid>& parts() { return parts_; }
    bool enough() const { return enough_; }
    double error_of_all() const {
        std::vector<ConvexHull> hulls;
        std::vector<std::vector<dvec3>> points;
        for (const PartOfSolid& part : parts_) hulls.push_back(part.hull), points.push_back(part.points);
        return judge_.of_all(hulls, points);
    }

private:
    PartOfSolid part_of(SolidPiece piece) const {
        PartOfSolid part;
        std::vector<dvec3> all;
        for (const std::uint32_t point : points_of(piece)) all.push_back(points_[point]);
        part.volume = volume_of(piece, points_);
        give_hull(part, all, most_corners);
        part.piece = std::move(piece);
        return part;
    }

    void give_hull(PartOfSolid& part, const std::vector<dvec3>& all, std::size_t most) const {
        effort_.spend(all.size() * corner_effort);
        const ConvexHull rough = convex_hull(all, most);
        for (const std::uint32_t corner : rough.corners) part.points.push_back(all[corner]);
        part.hull = convex_hull(part.points, most, 0);
    }

    void add(SolidPiece piece) {
        PartOfSolid part = part_of(std::move(piece));
        if (part.hull.volume > 1e-7) part.error = judge_.of(part.hull, part.points, 1e300);
        parts_.push_back(std::move(part));
    }

    // Volume between what it cuts and the hulls of that; none if it cuts nothing off.
    std::optional<double> left_over(const PartOfSolid& part, const CuttingPlane& plane) {
        effort_.spend(part.piece.edges.size() * corner_effort);
        const std::size_t before = points_.size();
        auto [below, above] = cut(part.piece, plane, points_);
        double left = 0, volumes[2] = {0, 0};
        for (int side = 0; side < 2; ++side)
            for (const SolidPiece& piece : connected(std::move(side == 0 ? below : above), points_)) {
                std::vector<dvec3> all;
                for (const std::uint32_t point : points_of(piece)) all.push_back(points_[point]);
                const double solid = volume_of(piece, points_), hull = convex_hull(all, most_corners).volume;
                left += std::max(hull - solid, 0.0);
                volumes[side] += hull;
            }
        points_.resize(before);
        if (volumes[0] <= 0 || volumes[1] <= 0) return std::nullopt;
        return left + 0.03 * std::abs(volumes[0] - volumes[1]);
    }

    // Moved by a little, so that few points lie in it.
    CuttingPlane beside_points(const SolidPiece& piece, CuttingPlane plane) const {
        const double step = 0.013 * error_;
        for (const double shift : {0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0}) {
            const double offset = plane.offset + shift * step;
            const bool clear = std::none_of(piece.edges.begin(), piece.edges.end(), [&](const SolidPiece::Edge& edge) {
                return std::abs(glm::dot(plane.normal, points_[edge.from]) - offset) < 1e-7;
            });
            if (clear) return {plane.normal, offset};
        }
        return plane;
    }

    std::optional<CuttingPlane> best_cut(const PartOfSolid& part) {
        const dvec3 at = part.error.at;
        std::vector<CuttingPlane> planes;
        const auto through = [&](dvec3 normal) {
            const double length = std::sqrt(glm::dot(normal, normal));
            if (length < 0.1) return;
            normal /= length;
            const bool known = std::any_of(planes.begin(), planes.end(), [&](const CuttingPlane& plane) {
                return std::abs(glm::dot(plane.normal, normal)) > 0.999 &&
                       std::abs(glm::dot(plane.normal, at) - plane.offset) < 1e-4;
            });
            if (!known) planes.push_back({normal, glm::dot(normal, at)});
        };
        const std::array<dvec3, 3> axes{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
        CuttingPlane surface = judge_.surface_near(at);
        for (const dvec3& axis : axes) through(axis);
        for (const dvec3& axis : axes) through(glm::cross(axis, surface.normal));
        through(surface.normal);
        // Off the surface by a little: what lies in it stays with the solid below.
        surface.offset += 0.05 * error_;
        planes.push_back(surface);
        std::optional<CuttingPlane> best;
        double least = 1e300;
        for (const CuttingPlane& one : planes) {
            const CuttingPlane plane = beside_points(part.piece, one);
            const std::optional<double> left = left_over(part, plane);
            if (left && *left < least) least = *left, best = plane;
        }
        return best;
    }

    // ---- merging
    struct Pair {
        double cost;  // volume that the common hull adds; beyond the allowed error that of the hull
        Error error;
        PartOfSolid merged;
    };

    static bool apart(const PartOfSolid& a, const PartOfSolid& b, double by) {
        dvec3 low[2] = {dvec3(1e300), dvec3(1e300)}, high[2] = {dvec3(-1e300), dvec3(-1e300)};
        for (int k = 0; k < 2; ++k)
            for (const dvec3& p : (k == 0 ? a : b).points) low[k] = glm::min(low[k], p), high[k] = glm::max(high[k], p);
        for (int k = 0; k < 3; ++k)
            if (low[0][k] > high[1][k] + by || low[1][k] > high[0][k] + by) return true;
        return false;
    }

    std::optional<Pair> pair_of(const PartOfSolid& a, const PartOfSolid& b, double limit) const {
        if (apart(a, b, limit > error_ ? limit : 0.3 * error_)) return std::nullopt;
        Pair pair;
        std::vector<dvec3> all = a.points;
        all.insert(all.end(), b.points.begin(), b.points.end());
        give_hull(pair.merged, all, wanted_.vertices);
        if (pair.merged.hull.empty()) return std::nullopt;
        pair.merged.volume = a.volume + b.volume;
        const double added = pair.merged.hull.volume - a.hull.volume - b.hull.volume;
        pair.error = pair.merged.error = judge_.of(pair.merged.hull, pair.merged.points, limit);
        if (pair.error.most > limit) return std::nullopt;
        pair.cost = limit > error_ ? pair.error.most : added;
        return pair;
    }

    bool merge_best(double limit) {
        if (limit != limit_) pairs_.clear(), limit_ = limit, numbers_.clear();
        while (numbers_.size() < parts_.size()) numbers_.push_back(next_number_++);
        effort_.reach(0.8 + 0.2 * std::min(1.0, double(wanted_.parts) / double(parts_.size())));
        std::optional<std::pair<std::size_t, std::size_t>> best;
        double least = 1e300;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            for (std::size_t k = i + 1; k < parts_.size(); ++k) {
                const auto [found, fresh] = pairs_.try_emplace({numbers_[i], numbers_[k]});
                if (fresh) {
                    const std::optional<Pair> pair = pair_of(parts_[i], parts_[k], limit);
                    found->second = pair ? pair->cost : 1e300;
                }
                if (found->second < least) least = found->second, best = {i, k};
            }
        if (!best) return false;
        std::optional<Pair> pair = pair_of(parts_[best->first], parts_[best->second], limit);
        for (const std::size_t gone : {best->second, best->first}) {
            parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(gone));
            numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(gone));
        }
        parts_.push_back(std::move(pair->merged));
        return true;
    }

    const Decomposition& wanted_;
    Effort& effort_;
    double error_;
    std::vector<dvec3> points_;
    Judge judge_;
    SolidPiece whole_;
    std::vector<PartOfSolid> parts_;
    bool enough_ = true;
    std::map<std::pair<std::size_t, std::size_t>, double> pairs_;  // costs, by numbers of parts
    std::vector<std::size_t> numbers_;                             // of the parts
    std::size_t next_number_ = 0;
    double limit_ = 0;
};

}  // namespace

ConvexParts decompose(std::span<const vec3> vertices, std::span<const uvec3> triangles, const Decomposition& wanted,
                      const std::function<void(double)>& tell, std::uint64_t most) {
    const Solid solid = solid_of(vertices, triangles);
    ConvexParts made;
    integrate(solid, made);
    Effort effort(tell);
    Decomposer decomposer(solid, wanted, effort);
    made.hull_error = decomposer.error_of_hull();
    try {
        effort.limit(most_for(wanted, most));
        decomposer.cut_up();
        decomposer.merge();
    } catch (const TooMuch&) {
        made.given_up = true;
    }
    effort.limit(unlimited_effort);
    if (made.given_up) decomposer.take_hull();
    std::erase_if(decomposer.parts(), [&](const PartOfSolid& part) {
        std::vector<vec3> corners;
        for (const dvec3& p : part.points) corners.push_back(vec3(solid.middle + p * solid.size));
        try {
            hull_form(corners);
        } catch (const HullError&) {
            ++made.thin;
            return true;
        }
        made.parts.push_back(std::move(corners));
        return false;
    });
    if (made.parts.empty()) throw DecompositionError("its parts are thinner than 0.001 m, or than a thousandth of their length");
    made.error = decomposer.error_of_all();
    made.enough = decomposer.enough();
    return made;
}

double hull_error(std::span<const vec3> vertices, std::span<const uvec3> triangles) {
    const Solid solid = solid_of(vertices, triangles);
    const Decomposition usual;
    const std::function<void(double)> tell;
    Effort effort(tell);
    return Decomposer(solid, usual, effort).error_of_hull();
}

}  // namespace scree
