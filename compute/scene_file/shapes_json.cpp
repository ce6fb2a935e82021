// Shapes of a scene file: reading and writing them.
#include "compute/scene_file/shapes_json.h"

#include <algorithm>

#include "compute/scene_file/fields_write.h"

namespace scree {

namespace json_reading {

static const Names shape_names = {"box",          "capsule", "compound", "cone",  "cylinder",
                                  "height_field", "hull",    "mesh",     "plane", "sphere"};

static void read(const json& value, const Place& place, std::vector<vec3>& points) {
    if (!value.is_array()) refuse(place, "must be an array of points [x, y, z], is " + kind(value));
    points.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) read(value[i], place / i, points[i]);
}

static void read(const json& value, const Place& place, std::vector<glm::uvec3>& triangles) {
    if (!value.is_array()) refuse(place, "must be an array of triangles [i, j, k], is " + kind(value));
    triangles.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_array() || value[i].size() != 3)
            refuse(place / i, "must be an array of 3 numbers of vertices, is " + kind(value[i]));
        for (std::size_t k = 0; k < 3; ++k) read(value[i][k], place / i / k, triangles[i][static_cast<int>(k)]);
    }
}

static void read(const json& value, const Place& place, std::vector<float>& numbers) {
    if (!value.is_array()) refuse(place, "must be an array of numbers, is " + kind(value));
    numbers.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) read(value[i], place / i, numbers[i]);
}

static const char* const not_a_part = "a part must be one convex shape; put the parts of a compound into this one";

static void read(const json& value, const Place& place, std::vector<Part>& parts) {
    if (!value.is_array()) refuse(place, "must be an array of parts, is " + kind(value));
    for (std::size_t i = 0; i < value.size(); ++i) {
        const Place here = place / i;
        only(value[i], here, {"shape", "position", "orientation", "density"});
        Part& part = parts.emplace_back();
        // Refused before its own parts are read: a file may nest compounds deeper than the stack reaches.
        if (const auto nested = value[i].find("shape"); nested != value[i].end() && nested->contains("compound"))
            refuse(here / "shape", not_a_part);
        Shape shape;
        required(value[i], here, "shape", shape);
        const std::optional<SimpleShape> simple = simple_shape(shape);
        if (!simple) refuse(here / "shape", not_a_part);
        part.shape = *simple;
        optional(value[i], here, "position", part.position);
        optional(value[i], here, "orientation", part.orientation);
        optional(value[i], here, "density", part.density);
    }
}

static void read(const json& sizes, const Place& inside, Mesh& mesh) {
    if (!sizes.contains("file")) {
        only(sizes, inside, {"vertices", "triangles"});
        required(sizes, inside, "vertices", mesh.vertices);
        required(sizes, inside, "triangles", mesh.triangles);
        return;
    }
    only(sizes, inside, {"file", "scale"});
    required(sizes, inside, "file", mesh.file);
    optional(sizes, inside, "scale", mesh.scale);
    if (mesh.file.empty()) refuse(inside / "file", "must name a file");
    if (!(mesh.scale >= 1e-6f && mesh.scale <= 1e6f)) refuse(inside / "scale", "must be between 0.000001 and 1000000");
}

void read(const json& value, const Place& place, Shape& out) {
    if (value.is_string()) refuse(place, "must be an object such as {\"sphere\": {\"radius\": 0.5}}, is " + kind(value));
    if (!value.is_object()) refuse(place, "must be an object with one key, is " + kind(value));
    if (value.size() != 1) refuse(place, "must have one key (" + listed(shape_names) + "), has " + std::to_string(value.size()));
    const std::string& name = value.begin().key();
    const json& sizes = value.begin().value();
    if (std::find(shape_names.begin(), shape_names.end(), name) == shape_names.end()) {
        refuse(place, "unknown shape \"" + name + "\"; known: " + listed(shape_names));
    }
    const Place inside = place / name.c_str();
    if (name == "sphere") {
        only(sizes, inside, {"radius"});
        required(sizes, inside, "radius", out.emplace<Sphere>().radius);
    } else if (name == "capsule") {
        only(sizes, inside, {"radius", "half_height"});
        auto& capsule = out.emplace<Capsule>();
        required(sizes, inside, "radius", capsule.radius);
        required(sizes, inside, "half_height", capsule.half_height);
    } else if (name == "box") {
        only(sizes, inside, {"half_extents"});
        required(sizes, inside, "half_extents", out.emplace<Box>().half_extents);
    } else if (name == "cylinder") {
        only(sizes, inside, {"radius", "half_height"});
        auto& cylinder = out.emplace<Cylinder>();
        required(sizes, inside, "radius", cylinder.radius);
        required(sizes, inside, "half_height", cylinder.half_height);
    } else if (name == "cone") {
        only(sizes, inside, {"radius", "height"});
        auto& cone = out.emplace<Cone>();
        required(sizes, inside, "radius", cone.radius);
        required(sizes, inside, "height", cone.height);
    } else if (name == "hull") {
        only(sizes, inside, {"points"});
        required(sizes, inside, "points", out.emplace<Hull>().points);
    } else if (name == "compound") {
        only(sizes, inside, {"parts"});
        required(sizes, inside, "parts", out.emplace<Compound>().parts);
    } else if (name == "mesh") {
        read(sizes, inside, out.emplace<Mesh>());
    } else if (name == "height_field") {
        only(sizes, inside, {"columns", "rows", "spacing", "heights"});
        auto& field = out.emplace<HeightField>();
        required(sizes, inside, "columns", field.columns);
        required(sizes, inside, "rows", field.rows);
        optional(sizes, inside, "spacing", field.spacing);
        required(sizes, inside, "heights", field.heights);
    } else {
        only(sizes, inside, {"normal", "offset"});
        auto& plane = out.emplace<Plane>();
        optional(sizes, inside, "normal", plane.normal);
        optional(sizes, inside, "offset", plane.offset);
    }
}

}  // namespace json_reading

static void write(Text& text, const Part& part) {
    static const Part by_default;
    const auto unless_default = [&](std::string_view key, const auto& value, const auto& usual) {
        if (!is_default(value, usual)) text << ", \"" << key << "\": " << value;
    };
    write_shape(text, whole_shape(part.shape));
    unless_default("position", part.position, by_default.position);
    unless_default("orientation", part.orientation, by_default.orientation);
    unless_default("density", part.density, by_default.density);
    text << "}";
}

void write_shape(Text& text, const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        text << "{\"sphere\": {\"radius\": " << sphere->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        text << "{\"capsule\": {\"radius\": " << capsule->radius << ", \"half_height\": " << capsule->half_height;
    } else if (const auto* box = std::get_if<Box>(&shape)) {
        text << "{\"box\": {\"half_extents\": " << box->half_extents;
    } else if (const auto* plane = std::get_if<Plane>(&shape)) {
        text << "{\"plane\": {\"normal\": " << plane->normal << ", \"offset\": " << plane->offset;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        text << "{\"cylinder\": {\"radius\": " << cylinder->radius << ", \"half_height\": " << cylinder->half_height;
    } else if (const auto* cone = std::get_if<Cone>(&shape)) {
        text << "{\"cone\": {\"radius\": " << cone->radius << ", \"height\": " << cone->height;
    } else if (const auto* hull = std::get_if<Hull>(&shape)) {
        text << "{\"hull\": {\"points\": ";
        text.list(hull->points);
    } else if (const auto* compound = std::get_if<Compound>(&shape)) {
        text << "{\"compound\": {\"parts\": [";
        for (std::size_t i = 0; i < compound->parts.size(); ++i) {
            text << (i == 0 ? "{\"shape\": " : ", {\"shape\": ");
            write(text, compound->parts[i]);
        }
        text << "]";
    } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
        text << "{\"mesh\": {\"vertices\": ";
        text.list(mesh->vertices);
        text << ", \"triangles\": [";
        for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
            const glm::uvec3& t = mesh->triangles[i];
            text << (i == 0 ? "[" : ", [") << std::to_string(t.x) << ", " << std::to_string(t.y) << ", " << std::to_string(t.z)
                 << "]";
        }
        text << "]";
    } else if (const auto* field = std::get_if<HeightField>(&shape)) {
        text << "{\"height_field\": {\"columns\": " << std::to_string(field->columns)
             << ", \"rows\": " << std::to_string(field->rows) << ", \"spacing\": " << field->spacing << ", \"heights\": ";
        text.list(field->heights);
    }
    text << "}}";
}

}  // namespace scree
