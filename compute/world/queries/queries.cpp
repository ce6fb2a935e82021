// World: queries in batches, against all bodies at their present poses.
#include "compute/queries.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "compute/parallel/threads.h"
#include "compute/scene/meshes/bounds_tree.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/validation/validator.h"
#include "compute/world/queries/least_depth.h"
#include "compute/world/queries/query_check.h"
#include "compute/world/queries/query_scene.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/distance.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/ray.h"

namespace scree {

namespace {

constexpr float touching = 1e-4f;  // m, at which a cast shape has arrived
constexpr float grazing = 1e-3f;   // slope of a way into a surface up to which a cast that is not solid slides along it
constexpr int most_advances = 64;
constexpr float widest = 1e6f;  // m, up to which what is nearest to a point is looked for in ever wider boxes

}  // namespace

float QueryScene::longest(float reach) {
    return std::min(reach, physics::LONGEST_RAY);
}
bool QueryScene::nearer(const QueryHit& x, const QueryHit& y) {
    return std::tie(x.distance, x.body, x.part) < std::tie(y.distance, y.body, y.part);
}

// ---- the bodies as a tree
QueryScene::QueryScene(const Scene& scene, const State& state) : scene_(scene), state_(state) {
    of_.resize(state.fixed().copies);
    std::vector<std::vector<BoundingBox>> boxes(of_.size());
    const physics::Parameters& p = state.fixed();
    const auto add = [&](std::uint32_t row, std::uint32_t body, std::uint32_t part) {
        const physics::BodyProperties& properties = state.properties[row];
        const vec3 centre = state.poses[row].position, half = physics::half_extents_of(properties, state.poses[row].orientation);
        if (!physics::is_seen(properties, centre, row < p.first_part)) return;
        const std::uint32_t copy = state.copy_of(row);
        if (properties.shape == physics::SHAPE_PLANE) {
            of_[copy].planes.push_back({row, body, part});
        } else {
            const vec3 reach = physics::half_box_of_query(centre, half);
            boxes[copy].push_back({centre - reach, centre + reach});
            of_[copy].leaves.push_back({row, body, part});
        }
    };
    for (std::uint32_t id = 0; id < state.body_count; ++id) add(state.row_of(id), id, 0);
    std::uint32_t owner = physics::NONE, part = 0;
    for (std::uint32_t row = p.first_part; row < p.bodies; ++row) {
        if (!physics::is_part(state.properties[row])) continue;
        part = state.properties[row].owner == owner ? part + 1 : 0;
        owner = state.properties[row].owner;
        add(row, state.id_of(owner), part);
    }
    for (std::size_t copy = 0; copy < of_.size(); ++copy) of_[copy].tree = BoundsTree(boxes[copy]);
}

bool QueryScene::sees(const Leaf& leaf, std::uint32_t mask, std::size_t ignored) const {
    if (leaf.body == ignored) return false;
    const std::uint32_t category = state_.filters.empty() ? 1u : state_.filters[leaf.row].x;
    return (category & mask) != 0;
}

std::optional<QueryHit> QueryScene::hit(const Leaf& leaf, const RayQuery& ray, float near) const {
    if (!sees(leaf, ray.mask)) return std::nullopt;
    const physics::RayMeeting met = physics::met_in_box(physics::meet_row(state_.properties[leaf.row], state_.poses[leaf.row],
                                                                          ray.from, ray.along, ray.solid, state_.hull_table()),
                                                        near, longest(ray.reach));
    if (met.distance < 0) return std::nullopt;
    return QueryHit{leaf.body, leaf.part, met.distance, met.distance > 0 ? ray.from + ray.along * met.distance : ray.from,
                    met.normal};
}

std::optional<QueryHit> QueryScene::nearest(const RayQuery& ray, bool any) const {
    const Bodies& in = of_[ray.copy];
    std::optional<QueryHit> best;
    float reach = longest(ray.reach);
    const auto offer = [&](const Leaf& leaf, float near) {
        const std::optional<QueryHit> found = hit(leaf, ray, near);
        if (!found || (best && !nearer(*found, *best))) return;
        best = found;
        reach = any ? -1 : found->distance;  // equally near ones are still met
    };
    for (const Leaf& plane : in.planes) offer(plane, 0);
    if (!(any && best))
        in.tree.for_each_met(ray.from, ray.along, vec3(0), reach,
                             [&](std::uint32_t leaf, float near) { offer(in.leaves[leaf], near); });
    return best;
}

std::vector<QueryHit> QueryScene::all(const RayQuery& ray) const {
    const Bodies& in = of_[ray.copy];
    std::vector<QueryHit> found;
    const auto offer = [&](const Leaf& leaf, float near) {
        if (const std::optional<QueryHit> one = hit(leaf, ray, near)) found.push_back(*one);
    };
    for (const Leaf& plane : in.planes) offer(plane, 0);
    in.tree.for_each_met(ray.from, ray.along, vec3(0), longest(ray.reach),
                         [&](std::uint32_t leaf, float near) { offer(in.leaves[leaf], near); });
    std::sort(found.begin(), found.end(), nearer);
    return found;
}

float QueryScene::gap(const Leaf& leaf, const QueryShapes::Piece& piece, physics::Hulls hulls, vec3* normal) const {
    const physics::DistanceBound bound = physics::distance_between_shapes(state_.properties[leaf.row], state_.poses[leaf.row],
                                                                          piece.form, piece.pose, 1e30f, hulls);
    if (normal) *normal = bound.normal;
    return bound.distance;
}

std::vector<Penetration> QueryScene::penetrated(const ShapeOverlap& query, Pieces pieces, physics::Hulls hulls,
                                                bool with_depths) const {
    const Bodies& in = of_[query.copy];
    std::vector<Penetration> found;
    for (const QueryShapes::Piece& piece : pieces) {
        const vec3 half = physics::half_extents_of(piece.form, piece.pose.orientation) * 1.00001f + 1e-6f;
        const auto offer = [&](const Leaf& leaf) {
            physics::DistanceBound bound{};
            if (!sees(leaf, query.mask, query.ignored)) return;
            bound.distance = gap(leaf, piece, hulls, &bound.normal);
            if (!(bound.distance <= 0)) return;
            if (with_depths)
                bound = least_depth(state_.properties[leaf.row], state_.poses[leaf.row], piece.form, piece.pose, bound, hulls);
            found.push_back({leaf.body, leaf.part, std::max(0.0f, -bound.distance), bound.normal});
        };
        for (const Leaf& plane : in.planes) offer(plane);
        in.tree.for_each_overlap({piece.pose.position - half, piece.pose.position + half},
                                 [&](std::uint32_t leaf) { offer(in.leaves[leaf]); });
    }
    const auto place = [](const Penetration& one) { return std::tie(one.body, one.part); };
    std::stable_sort(found.begin(), found.end(), [&](const Penetration& x, const Penetration& y) {
        return place(x) < place(y) || (place(x) == place(y) && x.depth > y.depth);
    });
    found.erase(
        std::unique(found.begin(), found.end(), [&](const Penetration& x, const Penetration& y) { return place(x) == place(y); }),
        found.end());
    return found;
}

// A point is a ball without a radius, whose distances are exact. The box that is looked through grows until it holds something,
// and then shrinks to the nearest so far.
std::optional<QueryHit> QueryScene::closest(const ClosestQuery& query) const {
    const Bodies& in = of_[query.copy];
    QueryShapes::Piece point{};
    point.form.shape = physics::SHAPE_SPHERE;
    point.pose = {query.point, 0, vec4(0, 0, 0, 1)};
    const float most = longest(query.reach);
    std::optional<QueryHit> best;
    const auto offer = [&](const Leaf& leaf) {
        if (!sees(leaf, query.mask)) return;
        vec3 normal(0);
        const float distance = std::max(0.0f, gap(leaf, point, state_.hull_table(), &normal));
        if (!(distance <= most)) return;
        const QueryHit found{leaf.body, leaf.part, distance, query.point - normal * distance, normal};
        if (!best || nearer(found, *best)) best = found;
    };
    for (const Leaf& plane : in.planes) offer(plane);
    for (float wide = std::clamp(0.01f * most, 1e-3f, 1.0f);; wide *= 10) {
        const float reach = best ? best->distance : (wide <= widest ? std::min(wide, most) : most);
        in.tree.for_each_overlap({query.point - vec3(reach), query.point + vec3(reach)},
                                 [&](std::uint32_t leaf) { offer(in.leaves[leaf]); });
        if (reach >= most || (best && best->distance <= reach)) return best;
    }
}

// Conservative advancement (Mirtich 1996) along a line: the separation along a fixed axis never exceeds the distance.
std::optional<QueryHit> QueryScene::cast_at(const Leaf& leaf, const ShapeCast& cast, const QueryShapes::Piece& piece,
                                            physics::Hulls hulls, float reach) const {
    if (!sees(leaf, cast.mask, cast.ignored)) return std::nullopt;
    float way = 0;
    vec3 normal(0);
    if (!cast.solid) {
        physics::DistanceBound bound{};
        bound.distance = gap(leaf, piece, hulls, &bound.normal);
        if (bound.distance <= touching) {
            bound = least_depth(state_.properties[leaf.row], state_.poses[leaf.row], piece.form, piece.pose, bound, hulls);
            if (-glm::dot(bound.normal, cast.along) <= grazing) return std::nullopt;
            if (bound.distance <= 0) return QueryHit{leaf.body, leaf.part, 0, cast.from, bound.normal};
        }
    }
    for (int round = 0; round < most_advances; ++round) {
        QueryShapes::Piece moved = piece;
        moved.pose.position = piece.pose.position + cast.along * way;
        const float distance = gap(leaf, moved, hulls, &normal);
        if (distance <= (round == 0 ? 0 : touching)) {
            if (round == 0) return QueryHit{leaf.body, leaf.part, 0, cast.from, -cast.along};
            return QueryHit{leaf.body, leaf.part, way, cast.from + cast.along * way, normal};
        }
        const float closing = -glm::dot(normal, cast.along);  // of the piece towards the body
        if (!(closing > 1e-6f)) return std::nullopt;
        way += std::max(distance - 0.5f * touching, 0.25f * touching) / closing;
        if (!(way <= reach)) return std::nullopt;
    }
    return std::nullopt;
}

std::optional<QueryHit> QueryScene::nearest(const ShapeCast& cast, Pieces pieces, physics::Hulls hulls) const {
    const Bodies& in = of_[cast.copy];
    std::optional<QueryHit> best;
    float reach = longest(cast.reach);
    for (const QueryShapes::Piece& piece : pieces) {
        const auto offer = [&](const Leaf& leaf) {
            const std::optional<QueryHit> found = cast_at(leaf, cast, piece, hulls, reach);
            if (!found || (best && !nearer(*found, *best))) return;
            best = found;
            reach = found->distance;
        };
        for (const Leaf& plane : in.planes) offer(plane);
        in.tree.for_each_met(piece.pose.position, cast.along,
                             physics::half_extents_of(piece.form, piece.pose.orientation) + touching, reach,
                             [&](std::uint32_t leaf, float) { offer(in.leaves[leaf]); });
    }
    return best;
}

// ---- World
const QueryScene& World::Impl::query_scene() const {
    if (queried && queried_at == std::pair(steps, changes)) return *queried;
    bring(body_ranges);
    queried = std::make_shared<const QueryScene>(scene, state);
    queried_at = {steps, changes};
    return *queried;
}

std::vector<std::optional<QueryHit>> World::cast_shapes(std::span<const ShapeCast> casts) const {
    QueryShapes shapes;
    for (std::size_t i = 0; i < casts.size(); ++i) {
        const ShapeCast& cast = casts[i];
        check_copy("cast", i, cast.copy, copies());
        shapes.add("cast", cast.shape, cast.from, cast.orientation);
        if (!is_unit(cast.along)) refuse_query("cast", i, "its direction must be of length 1");
        if (!(cast.reach >= 0)) refuse_query("cast", i, "its reach must be 0 m or more");
    }
    const QueryScene& bodies = whole().query_scene();
    shapes.join(whole().state);
    std::vector<std::optional<QueryHit>> hits(casts.size());
    whole().runner->threads().for_each(casts.size(),
                                       [&](std::size_t i) { hits[i] = bodies.nearest(casts[i], shapes.of(i), shapes.hulls()); });
    return hits;
}

std::vector<std::optional<QueryHit>> World::closest_points(std::span<const ClosestQuery> points) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
        check_copy("point", i, points[i].copy, copies());
        if (!is_finite(points[i].point)) refuse_query("point", i, "it must be finite");
        if (!(points[i].reach > 0)) refuse_query("point", i, "its reach must be above 0 m");
    }
    const QueryScene& bodies = whole().query_scene();
    std::vector<std::optional<QueryHit>> found(points.size());
    whole().runner->threads().for_each(points.size(), [&](std::size_t i) { found[i] = bodies.closest(points[i]); });
    return found;
}

QueryLists<Penetration> World::Impl::penetrations(std::span<const ShapeOverlap> queries, bool with_depths) const {
    QueryShapes shapes;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        check_copy("overlap", i, queries[i].copy, copies());
        shapes.add("overlap", queries[i].shape, queries[i].position, queries[i].orientation);
    }
    const QueryScene& bodies = query_scene();
    shapes.join(state);
    std::vector<std::vector<Penetration>> lists(queries.size());
    runner->threads().for_each(queries.size(), [&](std::size_t i) {
        lists[i] = bodies.penetrated(queries[i], shapes.of(i), shapes.hulls(), with_depths);
    });
    return joined_lists(std::move(lists));
}

QueryLists<Penetration> World::penetrations(std::span<const ShapeOverlap> shapes) const {
    return whole().penetrations(shapes, true);
}

QueryLists<QueryPart> World::overlaps(std::span<const ShapeOverlap> shapes) const {
    QueryLists<Penetration> found = whole().penetrations(shapes, false);
    QueryLists<QueryPart> lists{std::move(found.starts), {}};
    for (const Penetration& one : found.items) lists.items.push_back({one.body, one.part});
    return lists;
}

}  // namespace scree
