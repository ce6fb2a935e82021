// The shapes of a scene file, by the list of shapes (compute/shapes.h).
#include "compute/scene_file/shapes_json.h"

#include <algorithm>
#include <array>

#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/fields_write.h"
#include "compute/schema/body.h"

namespace scree {

namespace json_reading {

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
            refuse(place / i, "must be an array of 3 vertex indices, is " + kind(value[i]));
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
        only(value[i], here, {"shape", "position", "orientation", "density", "filter", "role", "material", "skinned"});
        Part& part = parts.emplace_back();
        // Rejected before its parts are read: nested compounds could overflow the stack.
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
        if (const auto filter = value[i].find("filter"); filter != value[i].end())
            read_value(*filter, here / "filter", part.filter.emplace(), "", {});
        if (const auto role = value[i].find("role"); role != value[i].end()) read_value(*role, here / "role", part.role, "", {});
        if (const auto material = value[i].find("material"); material != value[i].end())
            read_value(*material, here / "material", part.material.emplace(), "", {});
        optional(value[i], here, "skinned", part.skinned);
    }
}

static void read_skins(const json& value, const Place& place, std::vector<Skin>& skins) {
    if (!value.is_array()) refuse(place, "must be an array of skins, is " + kind(value));
    for (std::size_t i = 0; i < value.size(); ++i) {
        const Place here = place / i;
        only(value[i], here, {"vertices", "triangles", "position", "orientation"});
        Skin& skin = skins.emplace_back();
        auto mesh = std::make_shared<Mesh>();
        required(value[i], here, "vertices", mesh->vertices);
        required(value[i], here, "triangles", mesh->triangles);
        optional(value[i], here, "position", skin.position);
        optional(value[i], here, "orientation", skin.orientation);
        skin.mesh = std::move(mesh);
    }
}

static void read_decomposition(const json& sizes, const Place& inside, Mesh& mesh) {
    const auto found = sizes.find("decompose");
    if (found == sizes.end()) return;
    const Place here = inside / "decompose";
    if (!found->is_object()) refuse(here, "must be an object such as {\"error\": 0.02, \"parts\": 32}, is " + kind(*found));
    only(*found, here, {"error", "parts", "vertices"});
    Decomposition& wanted = mesh.decompose.emplace();
    optional(*found, here, "error", wanted.error);
    optional(*found, here, "parts", wanted.parts);
    optional(*found, here, "vertices", wanted.vertices);
}

// Vertices and triangles, or the name of a mesh file.
static void read_mesh(const json& sizes, const Place& inside, Mesh& mesh) {
    only(sizes, inside, {"file", "scale", "decompose"});
    required(sizes, inside, "file", mesh.file);
    optional(sizes, inside, "scale", mesh.scale);
    if (mesh.file.empty()) refuse(inside / "file", "must name a file");
    read_decomposition(sizes, inside, mesh);
    if (!(mesh.scale >= 1e-6f && mesh.scale <= 1e6f)) refuse(inside / "scale", "must be between 0.000001 and 1000000");
}

template <class OfShape>
static void read_fields(const json& sizes, const Place& inside, OfShape& shape) {
    Names names;
    for_each_shape_field<OfShape>([&](const auto& field) { names.emplace_back(field.name); });
    if constexpr (std::is_same_v<OfShape, Mesh>) names.emplace_back("decompose");
    if constexpr (std::is_same_v<OfShape, Compound>) names.emplace_back("skins");
    only(sizes, inside, names);
    if constexpr (std::is_same_v<OfShape, Mesh>) read_decomposition(sizes, inside, shape);
    if constexpr (std::is_same_v<OfShape, Compound>)
        if (const auto skins = sizes.find("skins"); skins != sizes.end()) read_skins(*skins, inside / "skins", shape.skins);
    for_each_shape_field<OfShape>([&](const auto& field) {
        if (field.required)
            required(sizes, inside, field.name, shape.*field.member);
        else
            optional(sizes, inside, field.name, shape.*field.member);
    });
}

static Names shape_names() {
    Names names;
    for_each_shape([&](const auto& shape) {
        names.emplace_back(shape_name(shape));
        return true;
    });
    std::sort(names.begin(), names.end());
    return names;
}

void read(const json& value, const Place& place, Shape& out) {
    if (value.is_string()) refuse(place, "must be an object such as {\"sphere\": {\"radius\": 0.5}}, is " + kind(value));
    if (!value.is_object()) refuse(place, "must be an object with one key, is " + kind(value));
    if (value.size() != 1)
        refuse(place, "must have one key (" + listed(shape_names()) + "), has " + std::to_string(value.size()));
    const std::string& name = value.begin().key();
    const json& sizes = value.begin().value();
    const Place inside = place / name.c_str();
    const bool unknown_shape = for_each_shape([&](auto shape) {
        using Kind = decltype(shape);
        if (name != ShapeInfo<Kind>::name) return true;
        if constexpr (std::is_same_v<Kind, Mesh>) {
            if (sizes.contains("file")) {
                read_mesh(sizes, inside, out.emplace<Mesh>());
                return false;
            }
        }
        read_fields(sizes, inside, out.emplace<Kind>());
        return false;
    });
    if (unknown_shape) refuse(place, "unknown shape \"" + name + "\"; known: " + listed(shape_names()));
}

}  // namespace json_reading

namespace {

template <class Value>
void write_shape_value(Text& text, const Value& value) {
    text << value;
}
template <class Value>
void write_shape_value(Text& text, const std::vector<Value>& values) {
    text.list(values);
}
void write_shape_value(Text& text, const std::vector<Part>& parts) {
    static const Part by_default;
    const auto unless_default = [&](std::string_view key, const auto& value, const auto& usual) {
        if (!is_default(value, usual)) text << ", \"" << key << "\": " << value;
    };
    const char* between = "[{\"shape\": ";
    for (const Part& part : parts) {
        text << between;
        write_shape(text, whole_shape(part.shape));
        unless_default("position", part.position, by_default.position);
        unless_default("orientation", part.orientation, by_default.orientation);
        unless_default("density", part.density, by_default.density);
        if (part.filter) write_value(text << ", \"filter\": ", *part.filter);
        if (part.material) write_value(text << ", \"material\": ", *part.material);
        if (part.role != Role::solid) write_value(text << ", \"role\": ", part.role);
        if (part.skinned) text << ", \"skinned\": true";
        between = "}, {\"shape\": ";
    }
    text << (parts.empty() ? "[]" : "}]");
}

// What is not in the list of shapes.
template <class OfShape>
void write_rest(Text&, const OfShape&) {}
void write_rest(Text& text, const Mesh& mesh) {
    if (!mesh.decompose) return;
    text << ", \"decompose\": {\"error\": " << mesh.decompose->error << ", \"parts\": " << mesh.decompose->parts
         << ", \"vertices\": " << mesh.decompose->vertices << "}";
}
void write_rest(Text& text, const Compound& compound) {
    if (compound.skins.empty()) return;
    const char* between = ", \"skins\": [{\"vertices\": ";
    for (const Skin& skin : compound.skins) {
        text << between;
        text.list(skin.mesh->vertices);
        text << ", \"triangles\": ";
        text.list(skin.mesh->triangles);
        if (skin.position != vec3(0)) text << ", \"position\": " << skin.position;
        if (skin.orientation != vec4(0, 0, 0, 1)) text << ", \"orientation\": " << skin.orientation;
        between = "}, {\"vertices\": ";
    }
    text << "}]";
}

}  // namespace

void write_shape(Text& text, const Shape& shape) {
    text << "{\"" << shape_name(shape) << "\": {";
    std::visit(
        [&](const auto& one) {
            const char* between = "\"";
            for_each_shape_field<decltype(one)>([&](const auto& field) {
                text << between << field.name << "\": ";
                write_shape_value(text, one.*field.member);
                between = ", \"";
            });
            write_rest(text, one);
        },
        shape);
    text << "}}";
}

}  // namespace scree
