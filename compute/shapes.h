// The shapes of bodies, and the one list of them: name in scene files, fields, ranges and units.
//
// Validation, scene files, their schema and messages follow from this list; the order of SimpleShape is that of the
// shape ids of a step. To add a convex shape: its struct, its alternative in SimpleShape and its ShapeInfo here; id and
// functions in shaders/physics/base/shapes.h; host geometry in compute/scene/shape_geometry.cpp and ray_cast.cpp;
// normals in surface_normal.cpp; drawing in demos/film/drawing.cpp. The compiler or a test reports what is missing.
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
    float half_height = 0.3f;  // m, from the centre to the centre of a cap; 0: a sphere
};
struct Box {
    vec3 half_extents{0.5f};  // m
};
struct Plane {             // infinite, solid behind the normal; fixed bodies only, whose pose it ignores
    vec3 normal{0, 1, 0};  // normalised when the scene is checked
    float offset = 0;      // m, along the normal from the origin
};
struct Cylinder {              // along the body's y axis
    float radius = 0.3f;       // m
    float half_height = 0.3f;  // m
};
struct Cone {             // along y, apex up; the centre of mass is a quarter of the height above the base
    float radius = 0.3f;  // of the base, m
    float height = 0.6f;  // m
};
struct Ellipsoid {
    vec3 radii{0.5f, 0.3f, 0.4f};  // m, along x, y and z
};
struct HullForm;                             // compute/scene/meshes/hull.h
struct Hull {                                // the convex hull of points
    std::vector<vec3> points;                // m, at least 4, not coplanar; inner and repeated points are ignored
    std::shared_ptr<const HullForm> form{};  // made when the scene is checked
};
// Convex shapes and the plane. The index of the alternative is the shape id in a step.
using SimpleShape = std::variant<Sphere, Capsule, Box, Plane, Cylinder, Cone, Ellipsoid, Hull>;

// Which bodies and parts collide with each other. Two of an equal group other than 0 always collide if it is positive, and
// never if it is negative; else they collide if each has a category in the other's mask.
struct Filter {
    std::uint32_t category = 1;       // bits: what it is
    std::uint32_t mask = 0xFFFFFFFF;  // bits: the categories that it collides with
    std::int32_t group = 0;
    bool operator==(const Filter& o) const { return category == o.category && mask == o.mask && group == o.group; }
};

// What a body's shape, or a part of a compound, is for.
enum class Role {
    solid,   // it collides
    sensor,  // it finds what overlaps it (World::sensed, EventSettings::sensors) and collides with nothing
    drawn,   // it is only drawn
};

// How a value of two surfaces in contact follows from those of either; of two rules the later one in this list counts.
enum class CombineRule {
    usual,      // of friction the geometric mean, of restitution the maximum
    geometric,  // sqrt(a b)
    average,    // (a + b) / 2
    minimum,
    multiply,  // a b
    maximum,
    // The rules of glTF rank average, minimum, maximum, multiply: its minimum and average are these.
    overriding_minimum,
    overriding_average,
};
constexpr float unset = -1;

// The surface of a body, whose members have these names, or of a part.
struct Material {
    float friction = 0.6f;         // Coulomb coefficient of what slides, 0 to 100
    float restitution = 0;         // 0 to 1
    float rolling_resistance = 0;  // m, lever arm of the normal force that resists rolling, 0 to 1e5; a pair takes the larger
    // Coulomb coefficient of what sticks, 0 to 100; unset, or below `friction`: that.
    float static_friction = unset;
    // m, lever arm of the normal force that resists spinning about the normal, 0 to 1e5; a pair takes the larger. Of a pair
    // with it rolling resistance resists rolling alone; unset: spinning, too.
    float spinning_resistance = unset;
    // m/s, speed of impacts below which they have no restitution; a pair takes the larger. Unset: as Settings say.
    float restitution_threshold = unset;
    // m/s, in the body's frame: velocity of the surface over the body, which does not move (a conveyor belt). What touches it
    // stays awake.
    vec3 surface_velocity{0};
    CombineRule friction_rule = CombineRule::usual, restitution_rule = CombineRule::usual;
};

struct Part {  // of a compound. Only solid parts have mass
    SimpleShape shape = Box{};
    vec3 position{0};  // of the shape's centre of mass in the body frame, m; of a hull its points' origin until checked
    vec4 orientation{0, 0, 0, 1};        // quaternion x, y, z, w; normalised when the scene is checked
    float density = 0;                   // kg/m^3; 0: the body's own
    std::optional<Filter> filter{};      // none: the body's own
    Role role = Role::solid;             // of a body that is not solid itself: the body's
    std::optional<Material> material{};  // none: the body's own
    bool skinned = false;                // pictures show the compound's skins in its place
};
struct Mesh;
struct Skin {                            // what pictures show, and nothing collides with
    std::shared_ptr<const Mesh> mesh{};  // shared by equal bodies
    vec3 position{0};                    // of the mesh's origin in the body frame, m
    vec4 orientation{0, 0, 0, 1};        // quaternion x, y, z, w; normalised when the scene is checked
};
struct Compound {               // several convex shapes on one rigid body
    std::vector<Part> parts;    // no planes; none: a body without a shape. The masses of overlapping parts add up
    std::vector<Skin> skins{};  // drawn in place of the parts that are skinned
};
struct MeshForm;  // compute/scene/meshes/mesh.h
// How a mesh becomes convex parts (compute/scene/meshes/decomposition.h).
struct Decomposition {
    float error = 0.02f;          // greatest distance between the surfaces, in longest extents of the mesh, 0.002 to 0.5
    std::uint32_t parts = 32;     // at most, 1 to 256; fewer have a greater error
    std::uint32_t vertices = 64;  // of a part, at most, 8 to 64
    bool operator==(const Decomposition& o) const { return error == o.error && parts == o.parts && vertices == o.vertices; }
};
// A triangle mesh. On a fixed or kinematic body a surface, solid behind its faces; bodies from behind pass through. On a
// dynamic body, and with `decompose` on any, a solid: when the scene is checked it becomes a compound of convex parts with
// the mass, centre and inertia of the mesh, whose skin is the mesh.
struct Mesh {
    std::vector<vec3> vertices;              // m, in the body's frame
    std::vector<glm::uvec3> triangles;       // vertex indices, counter-clockwise seen from outside
    std::string file{};                      // the mesh file, for scene files; may be empty
    float scale = 1;                         // scale of the file; applied to `vertices` already
    std::shared_ptr<const MeshForm> form{};  // made when the scene is checked
    std::optional<Decomposition> decompose{};
};
// Terrain over a grid, solid below; for fixed and kinematic bodies. The grid is centred on the body's origin.
struct HeightField {
    std::uint32_t columns = 2, rows = 2;     // grid points along x and along z; at least 2 each
    float spacing = 1;                       // m, between neighbours
    std::vector<float> heights;              // m, along y: columns * rows values, row by row
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
constexpr FieldRange size_range{1e-3f, 1e5f};  // m. Below, inverse inertias leave the range of a float
constexpr FieldRange size_or_none_range{0, 1e5f};
constexpr FieldRange within_shape_range{-1e5f, 1e5f};  // m, of points in a shape
constexpr FieldRange position_range{-1e6f, 1e6f};      // m. A float resolves 6 cm there
constexpr FieldRange direction_range{0, 0};            // marks vectors that are normalised when the scene is checked

template <class Owner, class Value>
struct ShapeField {
    const char* name;  // in scene files and messages
    Value Owner::*member;
    FieldRange range;  // of each component
    const char* unit;  // with a leading space, for messages
    const char* about = "";
    bool required = true;  // in a scene file; else defaults to the struct's value

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
    static constexpr const char* about = "infinite, solid behind the normal; only for \"fixed\" bodies, whose pose it ignores";
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
struct ShapeInfo<Mesh> {  // scene files may name a mesh file instead of the fields
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
// Calls f with a default shape of each kind, in the order of Shape, while f returns true.
template <std::size_t first = 0, class Function>
bool for_each_shape(Function&& f) {
    if constexpr (first == std::variant_size_v<Shape>) {
        return true;
    } else {
        return f(std::variant_alternative_t<first, Shape>{}) && for_each_shape<first + 1>(f);
    }
}
const char* shape_name(const Shape& shape);  // as in scene files

// The shape if it is convex or a plane.
std::optional<SimpleShape> simple_shape(const Shape& shape);
Shape whole_shape(const SimpleShape& shape);

}  // namespace scree
