// What overlaps the sensors of a world: exact tests of shapes against those near by, and what went through them within a step:
// conservative advancement along the straight ways from the poses before the step to those after it, which the contacts and
// times of impact of the step have bent and cut.
#include "compute/world/queries/sensors.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "compute/scene/meshes/bounds_tree.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/filter.h"
#include "shaders/physics/collide/distance.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/continuous/time_of_impact.h"

namespace scree {

namespace {

// A row, with the body and part that it is.
struct Collider {
    std::uint32_t row, body, part;
};
struct Colliders {
    std::vector<Collider> sensors, solids;
};

bool is_sensor(const physics::BodyProperties& row) {
    return (row.flags & physics::ROW_SENSOR) != 0;
}

Colliders colliders_of(const State& state) {
    Colliders found;
    const auto add = [&](const Collider& one) {
        const physics::BodyProperties& row = state.properties[one.row];
        if (is_sensor(row))
            found.sensors.push_back(one);
        else if (!physics::is_apart(row))
            found.solids.push_back(one);
    };
    for (std::uint32_t id = 0; id < state.body_count; ++id) {
        const std::uint32_t row = state.row_of(id);
        const physics::BodyProperties& properties = state.properties[row];
        if (!physics::is_absent(properties.motion) && properties.shape != physics::SHAPE_NONE) add({row, id, 0});
    }
    const physics::Parameters& p = state.fixed();
    std::uint32_t owner = physics::NONE, part = 0;
    for (std::uint32_t row = p.first_part; row < p.bodies; ++row) {
        const physics::BodyProperties& properties = state.properties[row];
        if (!physics::is_part(properties)) continue;
        part = properties.owner == owner ? part + 1 : 0;
        owner = properties.owner;
        // The triangles of a mesh count as one part.
        add({row, state.id_of(owner), properties.shape == physics::SHAPE_TRIANGLE ? 0 : part});
    }
    return found;
}

bool may_be_found(const State& state, const Collider& sensor, const Collider& solid) {
    const physics::BodyProperties &own = state.properties[sensor.row], &other = state.properties[solid.row];
    const bool still = physics::motion_of(own) == physics::MOTION_FIXED && physics::motion_of(other) == physics::MOTION_FIXED;
    if (sensor.body == solid.body || still) return false;
    if (own.shape == physics::SHAPE_PLANE && other.shape == physics::SHAPE_PLANE) return false;
    if (state.filters.empty()) return true;
    if (!physics::filters_allow(state.filters[sensor.row], state.filters[solid.row])) return false;
    for (std::uint32_t k = state.filters[sensor.row].w; k != physics::NONE; k = state.exclusions[k].y)
        if (state.exclusions[k].x == solid.body) return false;
    return true;
}

bool overlap_exactly(const State& state, const Collider& sensor, const Collider& solid) {
    return physics::distance_between_shapes(state.properties[solid.row], state.poses[solid.row], state.properties[sensor.row],
                                            state.poses[sensor.row], 1e30f, state.hull_table())
               .distance <= 0;
}

// The poses before a step, if they are asked for.
using Before = std::span<const physics::Pose>;

physics::Pose start_of(const State& state, std::uint32_t row, Before before) {
    const std::uint32_t owner = state.body_of(row);
    const physics::Pose& start = before.empty() ? state.poses[owner] : before[owner];
    if (owner == row) return start;
    // Parts of what is fixed are where they are; those of others may have been put elsewhere with their body.
    if (physics::motion_of(state.properties[row]) == physics::MOTION_FIXED) return state.poses[row];
    return physics::pose_of_part(state.part_in(row), start);
}
// How far its centre has moved in the step, m. 0 for what was not there.
vec3 way_of(const State& state, std::uint32_t row, Before before) {
    if (before.empty() || state.properties[row].shape == physics::SHAPE_PLANE) return vec3(0);
    const vec3 way = state.poses[row].position - start_of(state, row, before).position;
    return way == way ? way : vec3(0);
}

physics::MotionPath path_in_step(const State& state, std::uint32_t row, Before before) {
    const std::uint32_t owner = state.body_of(row);
    const physics::Pose& start = before[owner];
    const physics::MotionPath body =
        physics::path_of(state.properties[owner], start.position, start.orientation, state.poses[owner], 1);
    if (owner == row) return body;
    return physics::path_of_part(state.properties[row], state.part_in(row), body);
}

// Whether two that are apart at the end of the step met within it. Only what moves past the other by more than the thickness of
// either can pass unseen.
bool met_on_the_way(const State& state, const Collider& sensor, const Collider& solid, Before before) {
    const physics::BodyProperties &own = state.properties[sensor.row], &other = state.properties[solid.row];
    if (before.empty() || own.shape == physics::SHAPE_PLANE || other.shape == physics::SHAPE_PLANE) return false;
    constexpr std::uint32_t most_rounds = 64;
    const physics::MotionPath a = path_in_step(state, solid.row, before), b = path_in_step(state, sensor.row, before);
    const float thin = std::min(physics::min_half_width(own), physics::min_half_width(other));
    if (!(glm::length(a.way - b.way) + a.most + b.most > thin)) return false;
    const float slop = 1e-3f * std::max(physics::min_half_width(own), physics::min_half_width(other));
    float t = 0;
    for (std::uint32_t k = 0; k < most_rounds; ++k) {
        const physics::DistanceBound gap = physics::distance_between_shapes(
            other, physics::pose_along_path(a, t), own, physics::pose_along_path(b, t), 1e30f, state.hull_table());
        if (gap.distance <= 0) return k > 0;  // what was there at the start has begun before
        const float closing =
            physics::dot3(gap.normal, a.way - b.way) + physics::arc_along(a, gap.normal) + physics::arc_along(b, gap.normal);
        if (!(closing * (1 - t) > gap.distance)) return false;
        t = std::min(1.0f, t + (gap.distance + slop) / closing);
    }
    return false;
}

BoundingBox box_around(const State& state, std::uint32_t row, Before before) {
    const physics::BodyProperties& properties = state.properties[row];
    const vec3 centre = state.poses[row].position, way = way_of(state, row, before);
    vec3 half(1e30f);
    if (properties.shape != physics::SHAPE_PLANE) half = physics::half_extents_of(properties, state.poses[row].orientation);
    // As it turns on its way, it may need as much room as its bounding sphere.
    if (way != vec3(0)) half = glm::max(half, vec3(physics::bounding_radius(properties)));
    half += 1e-5f * (glm::abs(centre) + half) + 1e-6f;
    return {glm::min(centre, centre - way) - half, glm::max(centre, centre - way) + half};
}

// Few sensors go through all rows by bounding spheres, many through a tree.
constexpr std::size_t few_sensors = 8;

// Of each copy of the scene.
std::vector<Colliders> apart_by_copies(Colliders&& all, const State& state) {
    std::vector<Colliders> found(state.fixed().copies);
    if (found.size() == 1) {
        found[0] = std::move(all);
        return found;
    }
    for (const Collider& sensor : all.sensors) found[state.copy_of(sensor.row)].sensors.push_back(sensor);
    for (const Collider& solid : all.solids) found[state.copy_of(solid.row)].solids.push_back(solid);
    return found;
}

bool may_reach(const State& state, const BoundingBox& around, const Collider& solid, Before before) {
    const physics::BodyProperties& properties = state.properties[solid.row];
    if (properties.shape == physics::SHAPE_PLANE) return true;
    const vec3 centre = state.poses[solid.row].position;
    const vec3 apart = glm::max(glm::max(around.lower - centre, centre - around.upper), vec3(0));
    const float reach = 1.0001f * (physics::bounding_radius(properties) + glm::length(way_of(state, solid.row, before)));
    return glm::dot(apart, apart) <= reach * reach;
}

// For each sensor.
std::vector<Sensed> overlaps_among(const Colliders& found, const State& state, Before before, const Threads& threads) {
    std::vector<Sensed> lists(found.sensors.size());
    const auto offer = [&](std::size_t i, const Collider& solid) {
        const Collider& sensor = found.sensors[i];
        if (!may_be_found(state, sensor, solid)) return;
        const SensorOverlap both{sensor.body, sensor.part, solid.body, solid.part};
        if (overlap_exactly(state, sensor, solid))
            lists[i].now.push_back(both);
        else if (met_on_the_way(state, sensor, solid, before))
            lists[i].passed.push_back(both);
    };
    if (found.sensors.size() <= few_sensors) {
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const BoundingBox around = box_around(state, found.sensors[i].row, before);
            for (const Collider& solid : found.solids)
                if (may_reach(state, around, solid, before)) offer(i, solid);
        }
    } else {
        std::vector<BoundingBox> boxes;
        for (const Collider& solid : found.solids) boxes.push_back(box_around(state, solid.row, before));
        const BoundsTree tree(boxes);
        threads.for_each(lists.size(), [&](std::size_t i) {
            tree.for_each_overlap(box_around(state, found.sensors[i].row, before),
                                  [&](std::uint32_t k) { offer(i, found.solids[k]); });
        });
    }
    return lists;
}

}  // namespace

bool has_sensors(const State& state) {
    return std::any_of(state.properties.begin(), state.properties.end(), is_sensor);
}

Sensed sensed_in_step(const State& state, Before before, const Threads& threads) {
    Sensed all;
    for (const Colliders& found : apart_by_copies(colliders_of(state), state))
        for (const Sensed& one : overlaps_among(found, state, before, threads)) {
            all.now.insert(all.now.end(), one.now.begin(), one.now.end());
            all.passed.insert(all.passed.end(), one.passed.begin(), one.passed.end());
        }
    for (std::vector<SensorOverlap>* list : {&all.now, &all.passed}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    // Of a mesh one triangle may be passed and another one not.
    std::erase_if(all.passed, [&](const SensorOverlap& one) { return std::binary_search(all.now.begin(), all.now.end(), one); });
    return all;
}

std::vector<SensorOverlap> overlaps_of_sensors(const State& state, const Threads& threads) {
    return sensed_in_step(state, {}, threads).now;
}

std::vector<physics::Pose> poses_before(const State& state) {
    std::vector<physics::Pose> poses(state.poses.begin(), state.poses.begin() + state.fixed().bodies);
    for (std::size_t row = 0; row < poses.size(); ++row)
        if (physics::is_absent(state.properties[row].motion)) poses[row].position = vec3(std::numeric_limits<float>::quiet_NaN());
    return poses;
}

}  // namespace scree
