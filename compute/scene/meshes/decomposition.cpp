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
#include <numeric>
#include <optional>

#include "compute/scene/meshes/convex_hull.h"
#include "compute/scene/meshes/distance_grid.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene/meshes/solid_pieces.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;
using glm::uvec3;

constexpr std::size_t most_pieces = 256, most_corners = 64;
constexpr std::uint64_t corner_effort = 64;  // of a point of a hull that is made, in distances
constexpr double nearly_flat = 1e-6;         // volume of a mesh that encloses nothing, over that of its box

// A finer wish may take more.
std::uint64_t most_for(const Decomposition& wanted, std::uint64_t most) {
    constexpr double usual = 0.02;
    const double error = static_cast<double>(wanted.error);
    return error < usual ? static_cast<std::uint64_t>(static_cast<double>(most) * (usual / error)) : most;
}

// A mesh of size 1 about the middle of its box, without open edges.
struct Solid {
    std::vector<dvec3> points;
    std::vector<uvec3> triangles;
    dvec3 middle{0};
    double size = 1;  // m
    std::size_t closed = 0;
    bool inside_out = false;
};

dvec3 normal_of(const Solid& solid, const uvec3& t) {
    const dvec3 across = glm::cross(solid.points[t.y] - solid.points[t.x], solid.points[t.z] - solid.points[t.x]);
    const double length = std::sqrt(glm::dot(across, across));
    return length > 0 ? across / length : dvec3(0, 1, 0);
}

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

struct Sample {
    dvec3 at, normal;
};

// Calls visit(point) over a triangle, at most `spacing` apart.
template <class Visit>
void sample(const dvec3& a, const dvec3& b, const dvec3& c, double spacing, const Visit& visit) {
    const double longest = std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
    const int n = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, 400);
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n - i; ++k) visit(a + (b - a) * (double(i) / n) + (c - a) * (double(k) / n));
}

// Counts what is done, and ends it beyond a limit.
struct TooMuch {};
constexpr std::uint64_t unlimited_effort = ~std::uint64_t{0};
class Effort {
public:
    explicit Effort(const std::function<void(double)>& tell) : tell_(tell) {}
    void limit(std::uint64_t more) { most_ = more, spent_ = 0; }
    void spend(std::uint64_t distances) {
        spent_ += distances;
        if (spent_ > most_) throw TooMuch{};
        if (tell_) tell_(share_);
    }
    void reach(double share) { share_ = share; }

private:
    std::uint64_t most_ = unlimited_effort, spent_ = 0;
    const std::function<void(double)>& tell_;
    double share_ = 0;  // of all that is to be done
};

struct Error {
    double most = 0;
    dvec3 at{0};
    bool within = false;  // of the surface's depth, not of what lies outside the solid
};

// Measures hulls against the solid.
class Judge {
public:
    Judge(const Solid& solid, double error, Effort& effort)
        : solid_(solid),
          effort_(effort),
          grid_(solid.points, solid.triangles, std::clamp(error * 0.8, 1.0 / 110, 1.0 / 50)),
          spacing_(error * 0.8) {
        for (const uvec3& t : solid.triangles) {
            const dvec3 a = solid.points[t.x], b = solid.points[t.y], c = solid.points[t.z], normal = normal_of(solid, t);
            const double area = glm::length(glm::cross(b - a, c - a)) / 2;
            // Of small triangles some, so that as many points fall on a surface of them as on one large one.
            owed_ += area / (spacing_ * spacing_ * 0.5);
            const auto take = [&](const dvec3& p) {
                if (grid_.at(p + normal * (0.7 * grid_.cell())) > 0) surface_.push_back({p, normal});
            };
            if (owed_ < 1) continue;
            if (area < spacing_ * spacing_)
                take((a + b + c) / 3.0);
            else
                sample(a, b, c, spacing_, [&](const dvec3& p) { take(p + ((a + b + c) / 3.0 - p) * 1e-3); });
            owed_ = 0;
        }
    }

    // Stops beyond `enough`.
    Error of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough) const {
        std::uint64_t looked_at = 0;
        const Error error = of(hull, points, enough, looked_at);
        effort_.spend(looked_at);
        return error;
    }
    Error of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough, std::uint64_t& looked_at) const {
        Error error;
        dvec3 lower(1e300), upper(-1e300);
        for (const std::uint32_t corner : hull.corners) {
            lower = glm::min(lower, points[corner]);
            upper = glm::max(upper, points[corner]);
        }
        const auto depth = [&](const dvec3& p, double least) {
            double depth = 1e300;
            for (const ConvexHull::Plane& plane : hull.planes) {
                ++looked_at;
                depth = std::min(depth, plane.offset - glm::dot(plane.normal, p));
                if (depth <= least) break;
            }
            return depth;
        };
        const auto outside = [&](const dvec3& p, double distance) {
            ++looked_at;
            if (distance > error.most) distance = std::min(distance, exact(p));
            if (distance > error.most) error = {distance, p, false};
        };
        for (const auto& face : hull.faces) {
            sample(points[face[0]], points[face[1]], points[face[2]], spacing_, [&](const dvec3& p) { outside(p, grid_.at(p)); });
            if (error.most > enough) return error;
        }
        const ivec3 from = grid_.cell_of(lower), to = grid_.cell_of(upper) + 1, cells = to - from + 1;
        looked_at += static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y * cells.z);
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x)
                    if (const double distance = grid_.value(x, y, z); distance > error.most)
                        if (const dvec3 p = grid_.place(x, y, z); depth(p, 0) > 0) outside(p, distance);
        if (error.most > enough) return error;
        looked_at += surface_.size();
        for (const Sample& one : surface_) {
            const dvec3 p = one.at;
            if (p.x < lower.x || p.y < lower.y || p.z < lower.z || p.x > upper.x || p.y > upper.y || p.z > upper.z) continue;
            if (const double deep = depth(p, error.most); deep > error.most) error = {deep, p + one.normal * 1e-4, true};
        }
        return error;
    }

    // Of all hulls together: also how far the surface lies outside of all.
    double of_all(const std::vector<ConvexHull>& hulls, const std::vector<std::vector<dvec3>>& points) const {
        double most = 0;
        for (std::size_t i = 0; i < hulls.size(); ++i) most = std::max(most, of(hulls[i], points[i], 1e300).most);
        for (const Sample& one : surface_) {
            double least = 1e300;
            for (const ConvexHull& hull : hulls) {
                double above = -1e300;
                for (const ConvexHull::Plane& plane : hull.planes) {
                    above = std::max(above, glm::dot(plane.normal, one.at) - plane.offset);
                    if (above >= least) break;
                }
                least = std::min(least, above);
                if (least <= most) break;
            }
            most = std::max(most, least);
        }
        return most;
    }

    // From the triangles nearest to the corners of its cell: interpolation is too large at edges.
    double exact(const dvec3& p) const {
        double least = 1e300;
        for (const std::uint32_t n : grid_.nearest_around(p)) {
            const uvec3& t = solid_.triangles[n];
            least = std::min(least, squared_distance(p, solid_.points[t.x], solid_.points[t.y], solid_.points[t.z]));
        }
        return std::sqrt(least);
    }

    CuttingPlane surface_near(const dvec3& at) const {
        const uvec3& t = solid_.triangles[grid_.nearest(at)];
        const dvec3 normal = normal_of(solid_, t);
        return {normal, glm::dot(normal, solid_.points[t.x])};
    }

private:
    const Solid& solid_;
    Effort& effort_;
    DistanceGrid grid_;
    double spacing_, owed_ = 0;
    std::vector<Sample> surface_;
};

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
