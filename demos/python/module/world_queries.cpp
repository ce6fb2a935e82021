// Worlds: rays, casts, overlaps and lines to draw as arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compute/debug_drawing.h"
#include "compute/scene_file/shapes_json.h"
#include "demos/python/module/world_object.h"

namespace scree::python {

namespace {

struct HitRecord {
    std::int64_t body;
    std::int32_t part;
    float distance, point[3], normal[3];
};
struct PartRecord {
    std::int64_t body;
    std::int32_t part;
};
struct DepthRecord {
    std::int64_t body;
    std::int32_t part;
    float depth, normal[3];
};

HitRecord query_record(const QueryHit& hit) {
    return {static_cast<std::int64_t>(hit.body),
            static_cast<std::int32_t>(hit.part),
            hit.distance,
            {hit.point.x, hit.point.y, hit.point.z},
            {hit.normal.x, hit.normal.y, hit.normal.z}};
}
HitRecord query_record(const std::optional<QueryHit>& hit) {
    if (hit) return query_record(*hit);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {-1, -1, std::numeric_limits<float>::infinity(), {nan, nan, nan}, {0, 0, 0}};
}
PartRecord query_record(const QueryPart& part) {
    return {static_cast<std::int64_t>(part.body), static_cast<std::int32_t>(part.part)};
}
DepthRecord query_record(const Penetration& one) {
    return {static_cast<std::int64_t>(one.body),
            static_cast<std::int32_t>(one.part),
            one.depth,
            {one.normal.x, one.normal.y, one.normal.z}};
}

template <class Item>
py::array query_records(const std::vector<Item>& items) {
    return records_of(items, [](const Item& item) { return query_record(item); });
}

template <class Item>
py::tuple lists_of(const QueryLists<Item>& lists) {
    Indices starts(static_cast<py::ssize_t>(lists.starts.size()));
    std::copy(lists.starts.begin(), lists.starts.end(), starts.mutable_data());
    return py::make_tuple(starts, query_records(lists.items));
}

// One for each query, or one for all.
std::size_t copy_at(const Indices& copies, std::size_t i) {
    const std::int64_t copy = copies.data()[copies.size() == 1 ? 0 : i];
    if (copy < 0) throw py::index_error("copy " + std::to_string(copy));
    return static_cast<std::size_t>(copy);
}
void require_copies(const Indices& copies, py::ssize_t n) {
    if (copies.size() != 1) require_shape(copies, n, 0, "copy");
}
// Likewise; -1 is no_body.
std::size_t ignored_at(const Indices& ignored, std::size_t i) {
    return static_cast<std::size_t>(ignored.data()[ignored.size() == 1 ? 0 : i]);
}
void require_ignored(const Indices& ignored, py::ssize_t n) {
    if (ignored.size() != 1) require_shape(ignored, n, 0, "ignore");
}

std::vector<RayQuery> rays_of(const Floats& from, const Floats& along, const Floats& reach, std::uint32_t mask, bool solid,
                              const Indices& copies) {
    const py::ssize_t n = from.ndim() > 0 ? from.shape(0) : 0;
    require_shape(from, n, 3, "origins");
    require_shape(along, n, 3, "directions");
    require_shape(reach, n, 0, "reach");
    require_copies(copies, n);
    std::vector<RayQuery> rays(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].from = vec3_at(from.data(), i);
        rays[i].along = vec3_at(along.data(), i);
        rays[i].reach = reach.data()[i];
        rays[i].mask = mask;
        rays[i].solid = solid;
        rays[i].copy = copy_at(copies, i);
    }
    return rays;
}

Shape shape_of(const std::string& text) {
    const json_reading::Place place = root / "shape";
    Shape shape;
    json_reading::read(json_of(text), place, shape);
    if (std::holds_alternative<Plane>(shape) || std::holds_alternative<Mesh>(shape) || std::holds_alternative<HeightField>(shape))
        json_reading::refuse(place, "must be convex or a compound, not a " + std::string(shape_name(shape)));
    return shape;
}

// Reads a world without Python's lock.
template <class Query>
auto asked(WorldObject& object, const Query& query) {
    Use world(object);
    const py::gil_scoped_release unlocked;
    return query(*world);
}

py::array cast_shapes(WorldObject& object, const std::string& shape, const Floats& from, const Floats& along,
                      const Floats& orientation, const Floats& reach, std::uint32_t mask, const Indices& copies, bool solid,
                      const Indices& ignored) {
    const py::ssize_t n = from.ndim() > 0 ? from.shape(0) : 0;
    require_shape(from, n, 3, "origins");
    require_shape(along, n, 3, "directions");
    require_shape(orientation, n, 4, "orientation");
    require_shape(reach, n, 0, "reach");
    require_copies(copies, n);
    require_ignored(ignored, n);
    std::vector<ShapeCast> casts(static_cast<std::size_t>(n), ShapeCast{.shape = shape_of(shape)});
    for (std::size_t i = 0; i < casts.size(); ++i) {
        casts[i].from = vec3_at(from.data(), i);
        casts[i].along = vec3_at(along.data(), i);
        casts[i].orientation = vec4_at(orientation.data(), i);
        casts[i].reach = reach.data()[i];
        casts[i].mask = mask;
        casts[i].copy = copy_at(copies, i);
        casts[i].solid = solid;
        casts[i].ignored = ignored_at(ignored, i);
    }
    return query_records(asked(object, [&](const World& world) { return world.cast_shapes(casts); }));
}

py::array closest_points(WorldObject& object, const Floats& points, const Floats& reach, std::uint32_t mask,
                         const Indices& copies) {
    const py::ssize_t n = points.ndim() > 0 ? points.shape(0) : 0;
    require_shape(points, n, 3, "points");
    require_shape(reach, n, 0, "reach");
    require_copies(copies, n);
    std::vector<ClosestQuery> queries(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < queries.size(); ++i)
        queries[i] = {vec3_at(points.data(), i), reach.data()[i], mask, copy_at(copies, i)};
    return query_records(asked(object, [&](const World& world) { return world.closest_points(queries); }));
}

std::vector<ShapeOverlap> overlaps_of(const std::string& shape, const Floats& position, const Floats& orientation,
                                      std::uint32_t mask, const Indices& copies, const Indices& ignored) {
    const py::ssize_t n = position.ndim() > 0 ? position.shape(0) : 0;
    require_shape(position, n, 3, "positions");
    require_shape(orientation, n, 4, "orientation");
    require_copies(copies, n);
    require_ignored(ignored, n);
    std::vector<ShapeOverlap> shapes(static_cast<std::size_t>(n), ShapeOverlap{.shape = shape_of(shape)});
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        shapes[i].position = vec3_at(position.data(), i);
        shapes[i].orientation = vec4_at(orientation.data(), i);
        shapes[i].mask = mask;
        shapes[i].copy = copy_at(copies, i);
        shapes[i].ignored = ignored_at(ignored, i);
    }
    return shapes;
}

// A vector in each row of (n, 3), or two in each of (n, 2, 3).
template <class Item>
py::array_t<float> rows_of(const std::vector<Item>& items, std::vector<py::ssize_t> shape, vec3 Item::*first,
                           vec3 Item::*second = nullptr) {
    shape.insert(shape.begin(), static_cast<py::ssize_t>(items.size()));
    py::array_t<float> made(shape);
    float* at = made.mutable_data();
    for (const Item& item : items)
        for (const auto member : {first, second})
            if (member)
                for (int k = 0; k < 3; ++k) *at++ = (item.*member)[k];
    return made;
}

py::tuple drawing(WorldObject& object, const std::optional<Indices>& ids, bool shapes, bool contacts, bool joints, bool boxes,
                  int segments, float line_length, float force_length) {
    DebugWanted wanted{shapes, contacts, joints, boxes, segments, line_length, force_length, {}};
    if (ids) wanted.bodies.assign(ids->data(), ids->data() + ids->size());
    const DebugDrawing made = asked(object, [&](const World& world) { return debug_drawing(world, wanted); });
    return py::make_tuple(rows_of(made.lines, {2, 3}, &DebugLine::from, &DebugLine::to),
                          rows_of(made.lines, {3}, &DebugLine::color), rows_of(made.points, {3}, &DebugPoint::position),
                          rows_of(made.points, {3}, &DebugPoint::color));
}

}  // namespace

void bind_queries(py::module_& module, WorldClass& of_world) {
    PYBIND11_NUMPY_DTYPE(HitRecord, body, part, distance, point, normal);
    PYBIND11_NUMPY_DTYPE(PartRecord, body, part);
    PYBIND11_NUMPY_DTYPE(DepthRecord, body, part, depth, normal);
    module.attr("hit_dtype") = py::dtype::of<HitRecord>();
    module.attr("part_dtype") = py::dtype::of<PartRecord>();
    of_world
        .def("cast_rays",
             [](WorldObject& object, const Floats& from, const Floats& along, const Floats& reach, std::uint32_t mask, bool solid,
                const Indices& copies) {
                 const std::vector<RayQuery> rays = rays_of(from, along, reach, mask, solid, copies);
                 return query_records(asked(object, [&](const World& world) { return world.cast_rays(rays); }));
             })
        .def("rays_hit",
             [](WorldObject& object, const Floats& from, const Floats& along, const Floats& reach, std::uint32_t mask, bool solid,
                const Indices& copies) {
                 const std::vector<RayQuery> rays = rays_of(from, along, reach, mask, solid, copies);
                 const auto hits = asked(object, [&](const World& world) { return world.rays_hit(rays); });
                 py::array_t<bool> made(static_cast<py::ssize_t>(hits.size()));
                 std::transform(hits.begin(), hits.end(), made.mutable_data(), [](std::uint8_t hit) { return hit != 0; });
                 return made;
             })
        .def("cast_rays_through",
             [](WorldObject& object, const Floats& from, const Floats& along, const Floats& reach, std::uint32_t mask, bool solid,
                const Indices& copies) {
                 const std::vector<RayQuery> rays = rays_of(from, along, reach, mask, solid, copies);
                 return lists_of(asked(object, [&](const World& world) { return world.cast_rays_through(rays); }));
             })
        .def("cast_shapes", &cast_shapes)
        .def("closest_points", &closest_points)
        .def("overlaps",
             [](WorldObject& object, const std::string& shape, const Floats& position, const Floats& orientation,
                std::uint32_t mask, const Indices& copies, const Indices& ignored) {
                 const std::vector<ShapeOverlap> shapes = overlaps_of(shape, position, orientation, mask, copies, ignored);
                 return lists_of(asked(object, [&](const World& world) { return world.overlaps(shapes); }));
             })
        .def("penetrations",
             [](WorldObject& object, const std::string& shape, const Floats& position, const Floats& orientation,
                std::uint32_t mask, const Indices& copies, const Indices& ignored) {
                 const std::vector<ShapeOverlap> shapes = overlaps_of(shape, position, orientation, mask, copies, ignored);
                 return lists_of(asked(object, [&](const World& world) { return world.penetrations(shapes); }));
             })
        .def("debug_drawing", &drawing);
}

}  // namespace scree::python
