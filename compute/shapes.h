// The shapes that a body can have, and the one list of them: what a scene file calls each, its fields, their ranges and units.
//
// Validation, scene files, the check of their schema and messages follow from this list, and the order of SimpleShape is that of
// the shape ids of a step. To add a convex shape: its struct, its place in SimpleShape and its ShapeInfo here; its id and its
// laws in shaders/physics/collide/shapes.h; what the host measures of it in compute/scene/shape_geometry.cpp and ray_cast.cpp;
// its normal in surface_normal.cpp; how it is drawn in demos/film/drawing.cpp. The compiler or a test tells what is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace scree {

using glm::vec3;
using glm::vec4;

struct Sphere {
    float radius = 0.5f;  // m
};
struct Capsule {               // along the body's y axis
    float radius = 0.3f;       // m
    float half_height = 0.3f;  // m, from the centre to the centre of a cap; 0 is a sphere
};
struct Box {
    vec3 half_extents{0.5f};  // m
};
struct Plane {             // infinite, solid behind the normal; fixed bodies only, whose position and orientation it ignores
    vec3 normal{0, 1, 0};  // normalised when the scene is checked
    float offset = 0;      // m, along the normal from the origin
};
struct Cylinder {              // along the body's y axis
    float radius = 0.3f;       // m
    float half_height = 0.3f;  // m
};
struct Cone {             // along the body's y axis, the apex up; its centre of mass is a quarter of its height above its base
    float radius = 0.3f;  // of the base, m
    float height = 0.6f;  // m
};
struct Ellipsoid {
    vec3 radii{0.5f, 0.3f, 0.4f};  // m, along x, y and z
};
struct HullForm;                             // compute/scene/hull.h
struct Hull {                                // the convex hull of points
    std::vector<vec3> points;                // m, at least 4, not in a plane; inner and repeated ones do not matter
    std::shared_ptr<const HullForm> form{};  // made when the scene is checked
};
// The convex shapes and the plane. A shape's place here is its id in the step.
using SimpleShape = std::variant<Sphere, Capsule, Box, Plane, Cylinder, Cone, Ellipsoid, Hull>;

struct Part {  // of a compound
    SimpleShape shape = Box{};
    vec3 position{0};              // of the shape's centre of mass in the body's frame, m; of a hull as of a body
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w; normalised when the scene is checked
    float density = 0;             // kg/m^3; 0: the body's own
};
struct Compound {             // several shapes on one body, which moves as one
    std::vector<Part> parts;  // at least one; no planes. Where two overlap, the mass of both counts
};
struct MeshForm;  // compute/scene/mesh.h
// Triangles, solid behind their faces; for fixed and kinematic bodies. What comes from behind passes through.
struct Mesh {
    std::vector<vec3> vertices;              // m, in the body's frame
    std::vector<glm::uvec3> triangles;       // their corners, counter-clockwise seen from outside
    std::string file{};                      // where they come from, for a scene file; may be empty
    float scale = 1;                         // of what the file says; the vertices here have it already
    std::shared_ptr<const MeshForm> form{};  // made when the scene is checked
};
// Ground over a grid, solid below; for fixed and kinematic bodies. Its middle is the body's origin.
struct HeightField {
    std::uint32_t columns = 2, rows = 2;     // of the grid, along x and along z; at least 2 each
    float spacing = 1;                       // m, between neighbours
    std::vector<float> heights;              // m, along y: columns * rows of them, row by row
    std::shared_ptr<const MeshForm> form{};  // made when the scene is checked
};

template <class Simple, class... Others>
struct ExtendedVariant;
template <class... Simple, class... Others>
struct ExtendedVariant<std::variant<Simple...>, Others...> {
    using type = std::variant<Simple..., Others...>;
};
using Shape = ExtendedVariant<SimpleShape, Compound, Mesh, HeightField>::type;

// ---- the list
struct FieldRange {
    float least, most;
};
constexpr FieldRange size_range{1e-3f, 1e5f};  // m. Below, a body's inverse inertia leaves the range of a float
constexpr FieldRange size_or_none_range{0, 1e5f};
constexpr FieldRange within_shape_range{-1e5f, 1e5f};  // m, of a place in a shape
constexpr FieldRange position_range{-1e6f, 1e6f};      // m. A float resolves 6 cm there
constexpr FieldRange direction_range{0, 0};            // of a vector that gets unit length when the scene is checked

template <class Owner, class Value>
struct ShapeField {
    const char* name;  // in scene files and messages
    Value Owner::*member;
    FieldRange range;  // of each number of it
    const char* unit;  // with a space before it, for messages
    const char* about = "";
    bool required = true;  // in a scene file; else its default is the struct's own

    constexpr ShapeField(const char* called, Value Owner::*field, FieldRange within, const char* measured_in,
                         const char* meaning = "", bool always_said = true)
        : name(called), member(field), range(within), unit(measured_in), about(meaning), required(always_said) {}
    constexpr bool is_direction() const { return range.least == range.most; }
};

template <class OfShape>
struct ShapeInfo;
template <>
struct ShapeInfo<Sphere> {
    static constexpr const char* name = "sphere";
    static constexpr const char* about = "a ball about the body's position";
    static constexpr std::tuple fields{ShapeField{"radius", &Sphere::radius, size_range, " m", "m"}};
};
template <>
struct ShapeInfo<Capsule> {
    static constexpr const char* name = "capsule";
    static constexpr const char* about = "along the body's y axis";
    static constexpr std::tuple fields{
        ShapeField{"radius", &Capsule::radius, size_range, " m", "m"},
        ShapeField{"half_height", &Capsule::half_height, size_or_none_range, " m", "m, from the centre to the centre of a cap"}};
};
template <>
struct ShapeInfo<Box> {
    static constexpr const char* name = "box";
    static constexpr const char* about = "along the body's axes";
    static constexpr std::tuple fields{ShapeField{"half_extents", &Box::half_extents, size_range, " m", "m"}};
};
template <>
struct ShapeInfo<Plane> {
    static constexpr const char* name = "plane";
    static constexpr const char* about =
        "infinite, solid behind the normal; only for \"fixed\" bodies, whose position and orientation it ignores";
    static constexpr std::tuple fields{
        ShapeField{"normal", &Plane::normal, direction_range, "", "any length but 0", false},
        ShapeField{"offset", &Plane::offset, position_range, " m", "m, along the normal from the origin", false}};
};
template <>
struct ShapeInfo<Cylinder> {
    static constexpr const char* name = "cylinder";
    static constexpr const char* about = "along the body's y axis";
    static constexpr std::tuple fields{
        ShapeField{"radius", &Cylinder::radius, size_range, " m", "m"},
        ShapeField{"half_height", &Cylinder::half_height, size_range, " m", "m, from the centre to an end"}};
};
template <>
struct ShapeInfo<Cone> {
    static constexpr const char* name = "cone";
    static constexpr const char* about =
        "along the body's y axis, the apex up; its centre of mass lies a quarter of its height above its base";
    static constexpr std::tuple fields{ShapeField{"radius", &Cone::radius, size_range, " m", "m, of the base"},
                                       ShapeField{"height", &Cone::height, size_range, " m", "m"}};
};
template <>
struct ShapeInfo<Ellipsoid> {
    static constexpr const char* name = "ellipsoid";
    static constexpr const char* about = "semi-axes along the body's axes";
    static constexpr std::tuple fields{ShapeField{"radii", &Ellipsoid::radii, size_range, " m", "m, semi-axes"}};
};
template <>
struct ShapeInfo<Hull> {
    static constexpr const char* name = "hull";
    static constexpr std::tuple fields{ShapeField{"points", &Hull::points, within_shape_range, " m"}};
};
template <>
struct ShapeInfo<Compound> {
    static constexpr const char* name = "compound";
    static constexpr std::tuple fields{ShapeField{"parts", &Compound::parts, within_shape_range, " m"}};
};
template <>
struct ShapeInfo<Mesh> {  // a scene file may name a file instead of the fields
    static constexpr const char* name = "mesh";
    static constexpr std::tuple fields{ShapeField{"vertices", &Mesh::vertices, within_shape_range, " m"},
                                       ShapeField{"triangles", &Mesh::triangles, {0, 4.294967e9f}, ""}};
};
template <>
struct ShapeInfo<HeightField> {
    static constexpr const char* name = "height_field";
    static constexpr std::tuple fields{
        ShapeField{"columns", &HeightField::columns, {2, 30000}, ""}, ShapeField{"rows", &HeightField::rows, {2, 30000}, ""},
        ShapeField{"spacing", &HeightField::spacing, size_range, " m", "m, between neighbours", false},
        ShapeField{"heights", &HeightField::heights, within_shape_range, " m"}};
};

// Calls f with each field of a shape, in the order of the list.
template <class OfShape, class Function>
void for_each_shape_field(Function&& f) {
    std::apply([&](const auto&... field) { (f(field), ...); }, ShapeInfo<std::remove_cvref_t<OfShape>>::fields);
}
// Calls f with a default shape of each kind, in the order of Shape; it returns true to go on.
template <std::size_t first = 0, class Function>
bool for_each_shape(Function&& f) {
    if constexpr (first == std::variant_size_v<Shape>) {
        return true;
    } else {
        return f(std::variant_alternative_t<first, Shape>{}) && for_each_shape<first + 1>(f);
    }
}
const char* shape_name(const Shape& shape);  // as in scene files

// The shape if it is a single convex one, or a plane.
std::optional<SimpleShape> simple_shape(const Shape& shape);
Shape whole_shape(const SimpleShape& shape);

}  // namespace scree
