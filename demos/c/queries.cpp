// The C interface: contacts, events, and queries of a world in batches.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "compute/debug_drawing.h"
#include "compute/scene_file/shapes_json.h"
#include "demos/c/json.h"
#include "demos/c/objects.h"

namespace scree::c {

namespace {

void put(float (&to)[3], vec3 v) {
    for (glm::length_t k = 0; k < 3; ++k) to[k] = v[k];
}
vec3 vector_of(const float (&from)[3]) {
    return {from[0], from[1], from[2]};
}

// ---- Records
scree_contact record_of(const ContactState& c) {
    scree_contact made{};
    made.a = static_cast<std::int64_t>(c.a);
    made.b = static_cast<std::int64_t>(c.b);
    made.part_a = static_cast<std::int32_t>(c.part_a);
    made.part_b = static_cast<std::int32_t>(c.part_b);
    put(made.normal, c.normal);
    put(made.friction, c.friction);
    made.count = static_cast<std::int32_t>(c.count);
    for (std::size_t k = 0; k < c.count; ++k) {
        put(made.position[k], c.points[k].position);
        made.separation[k] = c.points[k].separation;
        made.force[k] = c.points[k].force;
    }
    return made;
}

// Of the world in place of a body -1.
std::int64_t index_or_world(std::uint32_t body) {
    return body == 0xFFFFFFFF ? -1 : static_cast<std::int64_t>(body);
}

scree_event record_of(const Event& e) {
    scree_event made{};
    made.step = static_cast<std::int64_t>(e.step);
    made.a = index_or_world(e.a);
    made.a_generation = e.a_generation;
    made.b = index_or_world(e.b);
    made.b_generation = e.b_generation;
    made.part_a = static_cast<std::int32_t>(e.part_a);
    made.part_b = static_cast<std::int32_t>(e.part_b);
    made.joint = static_cast<std::int32_t>(e.joint);
    made.kind = static_cast<std::uint32_t>(e.kind);
    made.speed = e.speed;
    made.impulse = e.impulse;
    put(made.point, e.point);
    put(made.normal, e.normal);
    return made;
}

scree_sensed record_of(const SensorOverlap& o) {
    return {o.sensor, o.body, static_cast<std::int32_t>(o.sensor_part), static_cast<std::int32_t>(o.part)};
}

scree_hit record_of(const QueryHit& hit) {
    scree_hit made{static_cast<std::int64_t>(hit.body), static_cast<std::int32_t>(hit.part), hit.distance, {}, {}};
    put(made.point, hit.point);
    put(made.normal, hit.normal);
    return made;
}
scree_hit record_of(const std::optional<QueryHit>& hit) {
    if (hit) return record_of(*hit);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {-1, -1, std::numeric_limits<float>::infinity(), {nan, nan, nan}, {0, 0, 0}};
}
scree_part record_of(const QueryPart& part) {
    return {static_cast<std::int64_t>(part.body), static_cast<std::int32_t>(part.part)};
}
scree_depth record_of(const Penetration& one) {
    scree_depth made{static_cast<std::int64_t>(one.body), static_cast<std::int32_t>(one.part), one.depth, {}};
    put(made.normal, one.normal);
    return made;
}

template <class Item>
scree_array records_of(const std::vector<Item>& items) {
    std::vector<decltype(record_of(items.front()))> made;
    made.reserve(items.size());
    for (const Item& item : items) made.push_back(record_of(item));
    return kept_array(std::move(made));
}

// ---- The caller's queries and memory for their answers
template <class Record>
std::vector<Record> records_given(const Record* from, std::size_t count, std::size_t stride, const char* name) {
    given_array(from, count, name);
    if (count > 0) stride_of(stride, sizeof(Record), name);
    std::vector<Record> made(count);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&made[i], reinterpret_cast<const char*>(from) + i * stride, sizeof(Record));
    return made;
}

void require_hits(const scree_hit* hits, std::size_t count, std::size_t stride) {
    given_array(hits, count, "hits");
    if (count > 0) stride_of(stride, sizeof(scree_hit), "hits");
}

void write_hits(const std::vector<std::optional<QueryHit>>& found, scree_hit* hits, std::size_t stride) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        const scree_hit made = record_of(found[i]);
        std::memcpy(reinterpret_cast<char*>(hits) + i * stride, &made, sizeof made);
    }
}

template <class Item>
void write_lists(const QueryLists<Item>& lists, std::uint64_t* starts, scree_array& items) {
    items = records_of(lists.items);
    std::copy(lists.starts.begin(), lists.starts.end(), starts);
}

std::vector<RayQuery> rays_of(const scree_ray* from, std::size_t count, std::size_t stride) {
    std::vector<RayQuery> rays;
    rays.reserve(count);
    for (const scree_ray& ray : records_given(from, count, stride, "rays"))
        rays.push_back({vector_of(ray.from), vector_of(ray.along), ray.reach, ray.mask, ray.solid != 0, ray.copy});
    return rays;
}

std::size_t ignored_of(std::int64_t body) {
    return body < 0 ? no_body : static_cast<std::size_t>(body);
}

Shape shape_of(const char* text) {
    using namespace json_reading;
    const Place place = root / "shape";
    Shape shape;
    json_reading::read(json_given(text, "shape_json"), place, shape);
    if (std::holds_alternative<Plane>(shape) || std::holds_alternative<Mesh>(shape) || std::holds_alternative<HeightField>(shape))
        json_reading::refuse(place, "must be convex or a compound, not a " + std::string(shape_name(shape)));
    return shape;
}

std::vector<ShapeOverlap> shapes_of(const char* shape, const scree_placed* from, std::size_t count, std::size_t stride) {
    std::vector<ShapeOverlap> shapes(count, ShapeOverlap{.shape = shape_of(shape)});
    const std::vector<scree_placed> all = records_given(from, count, stride, "shapes");
    for (std::size_t i = 0; i < count; ++i) {
        shapes[i].position = vector_of(all[i].position);
        shapes[i].orientation = {all[i].orientation[0], all[i].orientation[1], all[i].orientation[2], all[i].orientation[3]};
        shapes[i].mask = all[i].mask;
        shapes[i].copy = all[i].copy;
        shapes[i].ignored = ignored_of(all[i].ignored);
    }
    return shapes;
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_contacts(scree_world* world, scree_array* contacts) {
    return called([&] {
        given(contacts, "contacts");
        const UsedWorld used(world);
        *contacts = records_of(used->world.contacts());
    });
}

scree_result scree_world_set_events(scree_world* world, const scree_event_options* options) {
    return called([&] {
        const UsedWorld used(world);
        const scree_event_options chosen = options_of(options);
        const float fastest = std::min(chosen.hit_speed, EventSettings{}.hit_speed);
        used->world.set_events({chosen.contacts != 0, fastest, chosen.breaks != 0, chosen.sleep != 0, chosen.sensors != 0});
    });
}

scree_result scree_world_take_events(scree_world* world, scree_array* events) {
    return called([&] {
        given(events, "events");
        const UsedWorld used(world);
        *events = records_of(used->world.take_events());
    });
}

scree_result scree_world_sensed(scree_world* world, scree_array* overlaps) {
    return called([&] {
        given(overlaps, "overlaps");
        const UsedWorld used(world);
        *overlaps = records_of(used->world.sensed());
    });
}

scree_result scree_world_cast_rays(scree_world* world, const scree_ray* rays, size_t count, size_t stride, scree_hit* hits,
                                   size_t hit_stride) {
    return called([&] {
        const UsedWorld used(world);
        require_hits(hits, count, hit_stride);
        write_hits(used->world.cast_rays(rays_of(rays, count, stride)), hits, hit_stride);
    });
}

scree_result scree_world_rays_hit(scree_world* world, const scree_ray* rays, size_t count, size_t stride, uint8_t* hit) {
    return called([&] {
        const UsedWorld used(world);
        given_array(hit, count, "hit");
        const auto found = used->world.rays_hit(rays_of(rays, count, stride));
        for (std::size_t i = 0; i < count; ++i) hit[i] = found[i] != 0 ? 1 : 0;
    });
}

scree_result scree_world_cast_rays_through(scree_world* world, const scree_ray* rays, size_t count, size_t stride,
                                           uint64_t* starts, scree_array* hits) {
    return called([&] {
        const UsedWorld used(world);
        given(starts, "starts");
        write_lists(used->world.cast_rays_through(rays_of(rays, count, stride)), starts, given(hits, "hits"));
    });
}

scree_result scree_world_cast_shapes(scree_world* world, const char* shape_json, const scree_cast* casts, size_t count,
                                     size_t stride, scree_hit* hits, size_t hit_stride) {
    return called([&] {
        const UsedWorld used(world);
        require_hits(hits, count, hit_stride);
        std::vector<ShapeCast> made(count, ShapeCast{.shape = shape_of(shape_json)});
        const std::vector<scree_cast> all = records_given(casts, count, stride, "casts");
        for (std::size_t i = 0; i < count; ++i) {
            made[i].from = vector_of(all[i].from);
            made[i].orientation = {all[i].orientation[0], all[i].orientation[1], all[i].orientation[2], all[i].orientation[3]};
            made[i].along = vector_of(all[i].along);
            made[i].reach = all[i].reach;
            made[i].mask = all[i].mask;
            made[i].copy = all[i].copy;
            made[i].solid = all[i].solid != 0;
            made[i].ignored = ignored_of(all[i].ignored);
        }
        write_hits(used->world.cast_shapes(made), hits, hit_stride);
    });
}

scree_result scree_world_overlaps(scree_world* world, const char* shape_json, const scree_placed* shapes, size_t count,
                                  size_t stride, uint64_t* starts, scree_array* parts) {
    return called([&] {
        const UsedWorld used(world);
        given(starts, "starts");
        write_lists(used->world.overlaps(shapes_of(shape_json, shapes, count, stride)), starts, given(parts, "parts"));
    });
}

scree_result scree_world_penetrations(scree_world* world, const char* shape_json, const scree_placed* shapes, size_t count,
                                      size_t stride, uint64_t* starts, scree_array* depths) {
    return called([&] {
        const UsedWorld used(world);
        given(starts, "starts");
        write_lists(used->world.penetrations(shapes_of(shape_json, shapes, count, stride)), starts, given(depths, "depths"));
    });
}

scree_result scree_world_closest_points(scree_world* world, const scree_point* points, size_t count, size_t stride,
                                        scree_hit* hits, size_t hit_stride) {
    return called([&] {
        const UsedWorld used(world);
        require_hits(hits, count, hit_stride);
        std::vector<ClosestQuery> queries;
        for (const scree_point& point : records_given(points, count, stride, "points"))
            queries.push_back({vector_of(point.point), point.reach, point.mask, point.copy});
        write_hits(used->world.closest_points(queries), hits, hit_stride);
    });
}

scree_result scree_world_debug_drawing(scree_world* world, const scree_debug_options* options, scree_array* lines,
                                       scree_array* dots) {
    return called([&] {
        given(lines, "lines");
        given(dots, "dots");
        const UsedWorld used(world);
        DebugWanted wanted;
        bool none = false;  // of no bodies there is nothing
        if (options != nullptr) {
            const scree_debug_options chosen = options_of(options);
            wanted.shapes = chosen.shapes != 0;
            wanted.contacts = chosen.contacts != 0;
            wanted.joints = chosen.joints != 0;
            wanted.boxes = chosen.boxes != 0;
            if (chosen.segments != 0) wanted.segments = chosen.segments;
            if (chosen.line_length != 0) wanted.line_length = chosen.line_length;
            if (chosen.force_length != 0) wanted.force_length = chosen.force_length;
            none = chosen.bodies != nullptr && chosen.body_count == 0;
            if (chosen.bodies != nullptr)
                wanted.bodies = indices_of(chosen.bodies, chosen.body_count, used->world.scene().bodies.size(), "body");
        }
        const DebugDrawing made = none ? DebugDrawing{} : debug_drawing(used->world, wanted);
        std::vector<scree_line> line_records(made.lines.size());
        for (std::size_t i = 0; i < made.lines.size(); ++i) {
            put(line_records[i].from, made.lines[i].from);
            put(line_records[i].to, made.lines[i].to);
            put(line_records[i].color, made.lines[i].color);
        }
        std::vector<scree_dot> dot_records(made.points.size());
        for (std::size_t i = 0; i < made.points.size(); ++i) {
            put(dot_records[i].position, made.points[i].position);
            put(dot_records[i].color, made.points[i].color);
        }
        *lines = kept_array(std::move(line_records));
        *dots = kept_array(std::move(dot_records));
    });
}
