// World: queries in batches, against all bodies at their present poses.
#include "compute/queries.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "compute/parallel/threads.h"
#include "compute/scene/bounds_tree.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/validator.h"
#include "compute/world/query_check.h"
#include "compute/world/query_scene.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/distance.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/ray.h"

namespace scree {

namespace {

constexpr float touching = 1e-4f;  // m, at which a cast shape has arrived
constexpr int most_advances = 64;

void check_shape(const char* kind, std::size_t index, const SimpleShape& shape) {
    if (std::holds_alternative<Plane>(shape) || std::holds_alternative<Hull>(shape))
        refuse_query(kind, index, "its shape must be a sphere, capsule, box, cylinder, cone or ellipsoid");
    std::visit(
        [&](const auto& one) {
            for_each_shape_field<decltype(one)>([&](const auto& field) {
                const auto& value = one.*field.member;
                const auto within = [&](float v) { return v >= field.range.least && v <= field.range.most; };
                bool right = true;
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, float>) right = within(value);
                if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, vec3>)
                    right = within(value.x) && within(value.y) && within(value.z);
                if (!right) refuse_query(kind, index, std::string(field.name) + " is out of range");
            });
        },
        shape);
}

vec4 checked_turn(const char* kind, std::size_t index, vec4 q) {
    const double squared = glm::dot(glm::dvec4(q), glm::dvec4(q));
    if (!std::isfinite(squared) || squared < 1e-12)
        refuse_query(kind, index, "its orientation must be finite and not of length 0");
    return std::abs(squared - 1) <= 2.5e-7 ? q : vec4(glm::dvec4(q) / std::sqrt(squared));
}

}  // namespace

float QueryScene::reach_of(const RayQuery& ray) {
    return std::min(ray.reach, physics::LONGEST_RAY);
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

bool QueryScene::sees(const Leaf& leaf, std::uint32_t mask) const {
    const std::uint32_t category = state_.filters.empty() ? 1u : state_.filters[leaf.row].x;
    return (category & mask) != 0;
}

std::optional<QueryHit> QueryScene::hit(const Leaf& leaf, const RayQuery& ray, float near) const {
    if (!sees(leaf, ray.mask)) return std::nullopt;
    const physics::RayMeeting met = physics::met_in_box(physics::meet_row(state_.properties[leaf.row], state_.poses[leaf.row],
                                                                          ray.from, ray.along, ray.solid, state_.hull_table()),
                                                        near, reach_of(ray));
    if (met.distance < 0) return std::nullopt;
    return QueryHit{leaf.body, leaf.part, met.distance, met.distance > 0 ? ray.from + ray.along * met.distance : ray.from,
                    met.normal};
}

std::optional<QueryHit> QueryScene::nearest(const RayQuery& ray, bool any) const {
    const Bodies& in = of_[ray.copy];
    std::optional<QueryHit> best;
    float reach = reach_of(ray);
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
    in.tree.for_each_met(ray.from, ray.along, vec3(0), reach_of(ray),
                         [&](std::uint32_t leaf, float near) { offer(in.leaves[leaf], near); });
    std::sort(found.begin(), found.end(), nearer);
    return found;
}

physics::BodyProperties QueryScene::probe_of(const SimpleShape& shape) {
    physics::BodyProperties probe{};
    probe.shape = static_cast<physics::uint>(shape.index());
    probe.size = record_size(shape);
    return probe;
}

float QueryScene::gap(const Leaf& leaf, const physics::BodyProperties& probe, const physics::Pose& pose, vec3* normal) const {
    const physics::DistanceBound bound = physics::distance_between_shapes(state_.properties[leaf.row], state_.poses[leaf.row],
                                                                          probe, pose, 1e30f, state_.hull_table());
    if (normal) *normal = bound.normal;
    return bound.distance;
}

std::vector<QueryPart> QueryScene::overlapping(const ShapeOverlap& query, vec4 orientation) const {
    const Bodies& in = of_[query.copy];
    const physics::BodyProperties probe = probe_of(query.shape);
    const physics::Pose pose{query.position, 0, orientation};
    const vec3 half = physics::half_extents_of(probe, orientation) * 1.00001f + 1e-6f;
    std::vector<QueryPart> found;
    const auto offer = [&](const Leaf& leaf) {
        if (sees(leaf, query.mask) && gap(leaf, probe, pose) <= 0) found.push_back({leaf.body, leaf.part});
    };
    for (const Leaf& plane : in.planes) offer(plane);
    in.tree.for_each_overlap({query.position - half, query.position + half}, [&](std::uint32_t leaf) { offer(in.leaves[leaf]); });
    std::sort(found.begin(), found.end(),
              [](const QueryPart& x, const QueryPart& y) { return std::tie(x.body, x.part) < std::tie(y.body, y.part); });
    return found;
}

// A point is a ball without a radius, whose distances are exact. The box that is looked through shrinks to the nearest so far,
// so first to a tenth of the reach.
std::optional<QueryHit> QueryScene::closest(const ClosestQuery& query) const {
    const Bodies& in = of_[query.copy];
    physics::BodyProperties probe{};
    probe.shape = physics::SHAPE_SPHERE;
    const physics::Pose pose{query.point, 0, vec4(0, 0, 0, 1)};
    std::optional<QueryHit> best;
    const auto offer = [&](const Leaf& leaf) {
        if (!sees(leaf, query.mask)) return;
        vec3 normal(0);
        const float distance = std::max(0.0f, gap(leaf, probe, pose, &normal));
        if (!(distance <= query.reach)) return;
        const QueryHit found{leaf.body, leaf.part, distance, query.point - normal * distance, normal};
        if (!best || nearer(found, *best)) best = found;
    };
    for (const Leaf& plane : in.planes) offer(plane);
    for (const float share : {0.01f, 0.1f, 1.0f}) {
        const float reach = best ? std::min(best->distance, query.reach) : share * query.reach;
        in.tree.for_each_overlap({query.point - vec3(reach), query.point + vec3(reach)},
                                 [&](std::uint32_t leaf) { offer(in.leaves[leaf]); });
        if (best && best->distance <= reach) break;
    }
    return best;
}

// Conservative advancement (Mirtich 1996) along a line: the separation along a fixed axis never exceeds the distance.
std::optional<QueryHit> QueryScene::cast_at(const Leaf& leaf, const ShapeCast& cast, const physics::BodyProperties& probe,
                                            vec4 orientation, float reach) const {
    if (!sees(leaf, cast.mask)) return std::nullopt;
    float way = 0;
    vec3 normal(0);
    for (int round = 0; round < most_advances; ++round) {
        const physics::Pose pose{cast.from + cast.along * way, 0, orientation};
        const float distance = gap(leaf, probe, pose, &normal);
        if (distance <= (round == 0 ? 0 : touching)) {
            if (round == 0) return QueryHit{leaf.body, leaf.part, 0, cast.from, -cast.along};
            return QueryHit{leaf.body, leaf.part, way, pose.position, normal};
        }
        const float closing = -glm::dot(normal, cast.along);  // of the probe towards the body
        if (!(closing > 1e-6f)) return std::nullopt;
        way += std::max(distance - 0.5f * touching, 0.25f * touching) / closing;
        if (!(way <= reach)) return std::nullopt;
    }
    return std::nullopt;
}

std::optional<QueryHit> QueryScene::nearest(const ShapeCast& cast, vec4 orientation) const {
    const Bodies& in = of_[cast.copy];
    const physics::BodyProperties probe = probe_of(cast.shape);
    std::optional<QueryHit> best;
    float reach = cast.reach;
    const auto offer = [&](const Leaf& leaf) {
        const std::optional<QueryHit> found = cast_at(leaf, cast, probe, orientation, reach);
        if (!found || (best && !nearer(*found, *best))) return;
        best = found;
        reach = found->distance;
    };
    for (const Leaf& plane : in.planes) offer(plane);
    in.tree.for_each_met(cast.from, cast.along, physics::half_extents_of(probe, orientation) + touching, reach,
                         [&](std::uint32_t leaf, float) { offer(in.leaves[leaf]); });
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
    std::vector<vec4> turns;
    for (std::size_t i = 0; i < casts.size(); ++i) {
        const ShapeCast& cast = casts[i];
        check_copy("cast", i, cast.copy, copies());
        check_shape("cast", i, cast.shape);
        turns.push_back(checked_turn("cast", i, cast.orientation));
        if (!is_finite(cast.from)) refuse_query("cast", i, "its origin must be finite");
        if (!is_unit(cast.along)) refuse_query("cast", i, "its direction must be of length 1");
        if (!(cast.reach >= 0 && cast.reach <= 1e6f)) refuse_query("cast", i, "its reach must be between 0 and 1000000 m");
    }
    const QueryScene& bodies = whole().query_scene();
    std::vector<std::optional<QueryHit>> hits(casts.size());
    whole().runner->threads().for_each(casts.size(), [&](std::size_t i) { hits[i] = bodies.nearest(casts[i], turns[i]); });
    return hits;
}

std::vector<std::optional<QueryHit>> World::closest_points(std::span<const ClosestQuery> points) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
        check_copy("point", i, points[i].copy, copies());
        if (!is_finite(points[i].point)) refuse_query("point", i, "it must be finite");
        if (!(points[i].reach > 0 && points[i].reach <= 1e6f))
            refuse_query("point", i, "its reach must be above 0 and at most 1000000 m");
    }
    const QueryScene& bodies = whole().query_scene();
    std::vector<std::optional<QueryHit>> found(points.size());
    whole().runner->threads().for_each(points.size(), [&](std::size_t i) { found[i] = bodies.closest(points[i]); });
    return found;
}

QueryLists<QueryPart> World::overlaps(std::span<const ShapeOverlap> queries) const {
    std::vector<vec4> turns;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        check_copy("overlap", i, queries[i].copy, copies());
        check_shape("overlap", i, queries[i].shape);
        turns.push_back(checked_turn("overlap", i, queries[i].orientation));
        if (!is_finite(queries[i].position)) refuse_query("overlap", i, "its position must be finite");
    }
    const QueryScene& bodies = whole().query_scene();
    std::vector<std::vector<QueryPart>> lists(queries.size());
    whole().runner->threads().for_each(queries.size(),
                                       [&](std::size_t i) { lists[i] = bodies.overlapping(queries[i], turns[i]); });
    return joined_lists(std::move(lists));
}

}  // namespace scree
