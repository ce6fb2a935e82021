// Validation of shapes: ranges of their fields, and that hulls, compounds and meshes can be made.
#include "compute/scene/validation/shape_validation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "compute/scene/meshes/decomposed.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene/portable_math.h"
#include "compute/schema/body.h"
#include "shaders/physics/collide/shape_data.h"

namespace scree {

namespace {

using glm::dvec3;

constexpr float smallest_density = 1e-3f;
constexpr float largest_density = 1e6f;  // kg/m^3

bool within(float value, const FieldRange& range) {
    return value >= range.least && value <= range.most;
}
bool within(vec3 value, const FieldRange& range) {
    return within(value.x, range) && within(value.y, range) && within(value.z, range);
}
template <class Value>
bool within(const std::vector<Value>& values, const FieldRange& range) {
    return std::all_of(values.begin(), values.end(), [&](const Value& value) { return within(value, range); });
}

template <class Value, class Field>
void refuse_value(const Examination& body, const std::string& key, const Value& value, const Field& field) {
    body.between(key.c_str(), value, field.range.least, field.range.most, field.unit);
}
template <class Value, class Field>
void refuse_value(const Examination& body, const std::string& key, const std::vector<Value>& values, const Field& field) {
    for (std::size_t k = 0; k < values.size(); ++k) refuse_value(body, key + "/" + std::to_string(k), values[k], field);
}

// Floats, points and directions by the list of shapes; integers and parts are checked by their shapes.
template <class OfShape>
void check_fields(const Examination& body, OfShape& shape) {
    for_each_shape_field<OfShape>([&](const auto& field) {
        auto& value = shape.*field.member;
        using Value = std::remove_reference_t<decltype(value)>;
        constexpr bool numbers = std::is_same_v<Value, float> || std::is_same_v<Value, vec3> ||
                                 std::is_same_v<Value, std::vector<float>> || std::is_same_v<Value, std::vector<vec3>>;
        const auto key = [&] { return "/shape/" + std::string(ShapeInfo<OfShape>::name) + "/" + field.name; };
        if constexpr (std::is_same_v<Value, vec3>)
            if (field.is_direction()) return body.make_unit(key().c_str(), value, "it says which way the plane faces");
        if constexpr (numbers)
            if (!within(value, field.range)) refuse_value(body, key(), value, field);
    });
}

// Moves a frame to an origin and axes given in that frame.
void move_frame(vec3& position, vec4& orientation, dvec3 centre, glm::dquat axes) {
    const glm::dquat turn(orientation.w, orientation.x, orientation.y, orientation.z);
    position = vec3(dvec3(position) + turn * centre);
    const glm::dquat after = glm::normalize(turn * axes);
    orientation = vec4(glm::dvec4(after.x, after.y, after.z, after.w));
}

// Whether a hull is as an earlier check has made it: it keeps its form, which bodies share.
bool is_made(const Hull& hull) {
    if (!hull.form || hull.points.size() != hull.form->vertices.size()) return false;
    return std::ranges::equal(hull.points, hull.form->vertices,
                              [](vec3 point, const dvec3& vertex) { return point == vec3(vertex); });
}

// `position` and `orientation`: of the body, or of the part.
Shift check_hull(const Examination& body, vec3& position, vec4& orientation, Hull& hull, CheckedShapes& shapes,
                 std::vector<std::string>* notes) {
    if (is_made(hull)) return {};
    try {
        const CheckedShapes::MadeHull& made = shapes.hull_of(hull.points);
        if (made.simplified && notes) {
            notes->push_back(body.place() + "/shape/hull: simplified to " + std::to_string(physics::MOST_CORNERS) + " corners");
        }
        hull = made.hull;
        if (made.centre == dvec3(0) && made.axes == glm::dquat(1, 0, 0, 0)) return {};
        move_frame(position, orientation, made.centre, made.axes);
        return Recentred{made.centre, made.axes};
    } catch (const HullError& error) {
        body.refuse("/shape/hull/points", error.what());
    }
}

void check_skin(const Examination& at, Skin& skin, CheckedShapes& shapes) {
    if (!skin.mesh) at.refuse("", "has no mesh");
    at.between("/position", skin.position, within_shape_range.least, within_shape_range.most, " m");
    at.make_unit("/orientation", skin.orientation, "a quaternion x, y, z, w; no turn is [0, 0, 0, 1]");
    if (!within(skin.mesh->vertices, within_shape_range)) at.refuse("/vertices", "must be within 100000 m");
    try {
        skin.mesh = shapes.skin(skin.mesh);
    } catch (const MeshError& error) {
        at.refuse(error.place, error.what());
    }
}

Shift check_compound(const Examination& body, Body& b, Compound& compound, CheckedShapes& shapes,
                     std::vector<std::string>* notes) {
    constexpr std::size_t most_parts = 10000;
    if (compound.parts.empty() && b.motion == Motion::dynamic && !b.inertial)
        body.refuse("/shape/compound/parts", "a compound needs at least one part, or the body \"inertial\"");
    if (compound.parts.size() > most_parts)
        body.refuse("/shape/compound/parts",
                    "at most " + std::to_string(most_parts) + " parts, are " + std::to_string(compound.parts.size()));
    for (std::size_t i = 0; i < compound.parts.size(); ++i) {
        Part& p = compound.parts[i];
        const Examination part = body.part("/shape/compound/parts/" + std::to_string(i));
        if (std::holds_alternative<Plane>(p.shape))
            part.refuse("/shape/plane", "a plane is infinite and cannot be a part of a compound");
        std::visit([&](auto& one) { check_fields(part, one); }, p.shape);
        part.between("/position", p.position, within_shape_range.least, within_shape_range.most, " m");
        part.make_unit("/orientation", p.orientation, "a quaternion x, y, z, w; no turn is [0, 0, 0, 1]");
        if (p.density != 0) part.between("/density", p.density, smallest_density, largest_density, " kg/m^3");
        if (p.filter) schema::check_fields(part / "filter", *p.filter);
        if (p.material) schema::check_fields(part / "material", *p.material);
        if (auto* hull = std::get_if<Hull>(&p.shape)) check_hull(part, p.position, p.orientation, *hull, shapes, notes);
    }
    for (std::size_t i = 0; i < compound.skins.size(); ++i)
        check_skin(body.part("/shape/compound/skins/" + std::to_string(i)), compound.skins[i], shapes);
    if (compound.parts.empty() || b.inertial) return {};
    const Recentred before = bring_to_centre(compound, b.density);
    if (before.centre == dvec3(0) && before.axes == glm::dquat(1, 0, 0, 0)) return {};
    move_frame(b.position, b.orientation, before.centre, before.axes);
    return before;
}

void require_read(const Examination& body, Mesh& mesh) {
    if (mesh.triangles.empty() && !mesh.file.empty()) body.refuse("/shape/mesh/file", "\"" + mesh.file + "\" has not been read");
    check_fields(body, mesh);
}

void check_mesh(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes) {
    auto* mesh = std::get_if<Mesh>(&b.shape);
    auto* field = std::get_if<HeightField>(&b.shape);
    if (b.motion == Motion::dynamic)
        body.refuse(
            "/motion",
            "a height field must be \"fixed\" or \"kinematic\": it is a surface and has no mass; use a hull or a compound");
    const std::string key = mesh ? "/shape/mesh" : "/shape/height_field";
    try {
        if (mesh) {
            require_read(body, *mesh);
            shapes.form(*mesh);
        } else {
            if (field->columns < 2 || field->rows < 2 || field->columns > 30000 || field->rows > 30000)
                body.refuse(key, "columns and rows must be between 2 and 30000, are " + std::to_string(field->columns) + " and " +
                                     std::to_string(field->rows));
            if (field->heights.size() != std::size_t{field->columns} * field->rows)
                body.refuse(key + "/heights",
                            "must be columns * rows = " + std::to_string(std::size_t{field->columns} * field->rows) +
                                " heights, are " + std::to_string(field->heights.size()));
            check_fields(body, *field);
            field->form = std::make_shared<const MeshForm>(mesh_form(*field));
        }
    } catch (const MeshError& error) {
        body.refuse(key + error.place, error.what());
    }
    const bool is_first = mesh && std::ranges::find(shapes.meshes, mesh) != shapes.meshes.end();
    const std::string odd = is_first && notes ? oddities(*mesh->form) : "";
    if (!odd.empty()) notes->push_back(body.place() + key + ": " + odd);
}

}  // namespace

// Hulls already centred along principal axes, to rounding, stay: checking twice changes no bit.
const CheckedShapes::MadeHull& CheckedShapes::hull_of(const std::vector<vec3>& points) {
    std::vector<float> key(points.size() * 3);
    std::memcpy(key.data(), points.data(), key.size() * sizeof(float));
    const auto [at, fresh] = hulls.try_emplace(std::move(key));
    MadeHull& one = at->second;
    if (!fresh) return one;
    try {
        one.hull.points = points;
        HullForm form = hull_form(points);
        one.simplified = form.simplified;
        // Moved points are rounded, and merged faces may split: repeated until nothing moves.
        for (int round = 0; round < 8; ++round) {
            const glm::dmat3 axes = principal_axes(form.inertia);
            if (!form.simplified && axes == glm::dmat3(1) && glm::length(form.centre) <= 1e-5 * portable::cbrt(form.volume))
                break;
            const glm::dquat turn = glm::normalize(glm::quat_cast(axes));
            one.centre += one.axes * form.centre;
            one.axes = glm::normalize(one.axes * turn);
            one.hull.points.clear();
            for (const dvec3& v : form.vertices) one.hull.points.push_back(vec3(glm::conjugate(turn) * (v - form.centre)));
            form = hull_form(one.hull.points);
        }
        one.hull.form = std::make_shared<const HullForm>(std::move(form));
    } catch (...) {
        hulls.erase(at);
        throw;
    }
    return one;
}

static bool same_surface(const Mesh& a, const Mesh& b) {
    return a.vertices.size() == b.vertices.size() &&
           std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(vec3)) == 0 && a.triangles == b.triangles;
}

std::shared_ptr<const Mesh> CheckedShapes::skin(const std::shared_ptr<const Mesh>& mesh) {
    const auto equal =
        std::ranges::find_if(skins, [&](const auto& other) { return other == mesh || same_surface(*other, *mesh); });
    if (equal != skins.end()) return *equal;
    if (mesh->form) return skins.emplace_back(mesh);
    auto made = std::make_shared<Mesh>(*mesh);
    made->form = std::make_shared<const MeshForm>(mesh_form(mesh->vertices, mesh->triangles));
    return skins.emplace_back(std::move(made));
}

void CheckedShapes::form(Mesh& mesh) {
    const auto equal = std::ranges::find_if(meshes, [&](const Mesh* other) { return same_surface(*other, mesh); });
    if (equal != meshes.end()) {
        mesh.form = (*equal)->form;
        return;
    }
    mesh.form = std::make_shared<const MeshForm>(mesh_form(mesh.vertices, mesh.triangles));
    meshes.push_back(&mesh);
}

void check_shape(const Examination& body, Shape& shape, Motion motion) {
    std::visit(
        [&](auto& one) {
            using Kind = std::remove_cvref_t<decltype(one)>;
            if constexpr (std::is_constructible_v<SimpleShape, Kind>) check_fields(body, one);
        },
        shape);
    if (std::holds_alternative<Plane>(shape) && motion != Motion::fixed)
        body.refuse("/motion", "a plane must be \"fixed\": it is infinite and cannot move");
}

Shift bring_to_centre(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes) {
    if (auto* mesh = std::get_if<Mesh>(&b.shape); mesh && (mesh->decompose || b.motion == Motion::dynamic)) {
        require_read(body, *mesh);
        decompose_mesh(body, b, shapes, notes);
    }
    if (auto* hull = std::get_if<Hull>(&b.shape)) return check_hull(body, b.position, b.orientation, *hull, shapes, notes);
    if (auto* compound = std::get_if<Compound>(&b.shape)) return check_compound(body, b, *compound, shapes, notes);
    if (std::holds_alternative<Mesh>(b.shape) || std::holds_alternative<HeightField>(b.shape)) check_mesh(body, b, shapes, notes);
    return {};
}

}  // namespace scree
