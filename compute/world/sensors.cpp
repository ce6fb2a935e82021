// What overlaps the sensors of a world: exact tests of shapes against those near by.
#include "compute/world/sensors.h"

#include <algorithm>
#include <utility>

#include "compute/scene/bounds_tree.h"
#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/distance.h"
#include "shaders/physics/collide/filter.h"
#include "shaders/physics/collide/grid.h"

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

BoundingBox box_around(const State& state, std::uint32_t row) {
    const physics::BodyProperties& properties = state.properties[row];
    const vec3 centre = state.poses[row].position;
    vec3 half(1e30f);
    if (properties.shape != physics::SHAPE_PLANE) half = physics::half_extents_of(properties, state.poses[row].orientation);
    half += 1e-5f * (glm::abs(centre) + half) + 1e-6f;
    return {centre - half, centre + half};
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

bool may_reach(const State& state, const BoundingBox& around, const Collider& solid) {
    const physics::BodyProperties& properties = state.properties[solid.row];
    if (properties.shape == physics::SHAPE_PLANE) return true;
    const vec3 centre = state.poses[solid.row].position;
    const vec3 apart = glm::max(glm::max(around.lower - centre, centre - around.upper), vec3(0));
    const float reach = 1.0001f * physics::bounding_radius(properties);
    return glm::dot(apart, apart) <= reach * reach;
}

// A list for each sensor.
std::vector<std::vector<SensorOverlap>> overlaps_among(const Colliders& found, const State& state, const Threads& threads) {
    std::vector<std::vector<SensorOverlap>> lists(found.sensors.size());
    const auto offer = [&](std::size_t i, const Collider& solid) {
        const Collider& sensor = found.sensors[i];
        if (may_be_found(state, sensor, solid) && overlap_exactly(state, sensor, solid))
            lists[i].push_back({sensor.body, sensor.part, solid.body, solid.part});
    };
    if (found.sensors.size() <= few_sensors) {
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const BoundingBox around = box_around(state, found.sensors[i].row);
            for (const Collider& solid : found.solids)
                if (may_reach(state, around, solid)) offer(i, solid);
        }
    } else {
        std::vector<BoundingBox> boxes;
        for (const Collider& solid : found.solids) boxes.push_back(box_around(state, solid.row));
        const BoundsTree tree(boxes);
        threads.for_each(lists.size(), [&](std::size_t i) {
            tree.for_each_overlap(box_around(state, found.sensors[i].row), [&](std::uint32_t k) { offer(i, found.solids[k]); });
        });
    }
    return lists;
}

}  // namespace

bool has_sensors(const State& state) {
    return std::any_of(state.properties.begin(), state.properties.end(), is_sensor);
}

std::vector<SensorOverlap> overlaps_of_sensors(const State& state, const Threads& threads) {
    std::vector<SensorOverlap> all;
    for (const Colliders& found : apart_by_copies(colliders_of(state), state))
        for (const std::vector<SensorOverlap>& list : overlaps_among(found, state, threads))
            all.insert(all.end(), list.begin(), list.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace scree
