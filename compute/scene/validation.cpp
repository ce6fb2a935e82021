// What a scene may say: ranges, unit vectors, and the mass of each shape.
#include "compute/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <utility>

#include "compute/fields/check.h"
#include "compute/fields/document.h"
#include "compute/scene/compound.h"
#include "compute/scene/fracture.h"
#include "compute/scene/hull.h"
#include "compute/scene/joint_validation.h"
#include "compute/scene/mesh.h"
#include "compute/scene/validator.h"
#include "compute/scene/vehicle_validation.h"
#include "shaders/physics/collide/shape_data.h"

namespace scree {

namespace {

using glm::dvec3;

constexpr float smallest_size = 1e-3f;    // m. Below, a body's inverse inertia leaves the range of a float
constexpr float largest_size = 1e5f;      // m
constexpr float largest_position = 1e6f;  // m. A float resolves 6 cm there
constexpr float smallest_density = 1e-3f;
constexpr float largest_density = 1e6f;  // kg/m^3

void examine_simple(const Examination& body, SimpleShape& shape, Motion motion) {
    if (auto* sphere = std::get_if<Sphere>(&shape)) {
        body.between("/shape/sphere/radius", sphere->radius, smallest_size, largest_size, " m");
    } else if (auto* capsule = std::get_if<Capsule>(&shape)) {
        body.between("/shape/capsule/radius", capsule->radius, smallest_size, largest_size, " m");
        body.between("/shape/capsule/half_height", capsule->half_height, 0, largest_size, " m");
    } else if (auto* box = std::get_if<Box>(&shape)) {
        body.between("/shape/box/half_extents", box->half_extents, smallest_size, largest_size, " m");
    } else if (auto* cylinder = std::get_if<Cylinder>(&shape)) {
        body.between("/shape/cylinder/radius", cylinder->radius, smallest_size, largest_size, " m");
        body.between("/shape/cylinder/half_height", cylinder->half_height, smallest_size, largest_size, " m");
    } else if (auto* cone = std::get_if<Cone>(&shape)) {
        body.between("/shape/cone/radius", cone->radius, smallest_size, largest_size, " m");
        body.between("/shape/cone/height", cone->height, smallest_size, largest_size, " m");
    } else if (auto* hull = std::get_if<Hull>(&shape)) {
        for (std::size_t k = 0; k < hull->points.size(); ++k)
            body.between(("/shape/hull/points/" + std::to_string(k)).c_str(), hull->points[k], -largest_size, largest_size, " m");
    } else if (auto* plane = std::get_if<Plane>(&shape)) {
        body.make_unit("/shape/plane/normal", plane->normal, "it says which way the plane faces");
        body.between("/shape/plane/offset", plane->offset, -largest_position, largest_position, " m");
        if (motion != Motion::fixed) body.refuse("/motion", "a plane must be \"fixed\": it is infinite and cannot move");
    }
}

// Hulls of a scene by their points: equal ones are made once.
struct Hulls {
    struct Made {
        Hull hull;  // about its centre of mass, along its principal axes
        dvec3 centre{0};
        glm::dquat axes{1, 0, 0, 0};
        bool simplified = false;
    };
    std::map<std::vector<float>, Made> made;

    const Made& of(const std::vector<vec3>& points);
};

// What lies about its centre and along its axes already, to rounding, stays: checking twice changes no bit.
const Hulls::Made& Hulls::of(const std::vector<vec3>& points) {
    std::vector<float> key(points.size() * 3);
    std::memcpy(key.data(), points.data(), key.size() * sizeof(float));
    const auto [at, fresh] = made.try_emplace(std::move(key));
    Made& one = at->second;
    if (!fresh) return one;
    try {
        one.hull.points = points;
        HullForm form = hull_form(points);
        one.simplified = form.simplified;
        // Moved points are rounded, and faces that were one may be two: until nothing is left to move.
        for (int round = 0; round < 8; ++round) {
            const glm::dmat3 axes = principal_axes(form.inertia);
            if (!form.simplified && axes == glm::dmat3(1) && glm::length(form.centre) <= 1e-5 * std::cbrt(form.volume)) break;
            const glm::dquat turn = glm::normalize(glm::quat_cast(axes));
            one.centre += one.axes * form.centre;
            one.axes = glm::normalize(one.axes * turn);
            one.hull.points.clear();
            for (const dvec3& v : form.vertices) one.hull.points.push_back(vec3(glm::conjugate(turn) * (v - form.centre)));
            form = hull_form(one.hull.points);
        }
        one.hull.form = std::make_shared<const HullForm>(std::move(form));
    } catch (...) {
        made.erase(at);
        throw;
    }
    return one;
}

using Shift = std::optional<Recentred>;  // of the body's frame: to where its origin, along what its axes

// To where its origin and its axes are, in its own frame.
void move_frame(vec3& position, vec4& orientation, dvec3 centre, glm::dquat axes) {
    const glm::dquat turn(orientation.w, orientation.x, orientation.y, orientation.z);
    position = vec3(dvec3(position) + turn * centre);
    const glm::dquat after = glm::normalize(turn * axes);
    orientation = vec4(glm::dvec4(after.x, after.y, after.z, after.w));
}

// `position` and `orientation`: of the body, or of the part.
Shift examine_hull(const Examination& body, vec3& position, vec4& orientation, Hull& hull, Hulls& hulls,
                   std::vector<std::string>* notes) {
    try {
        const Hulls::Made& made = hulls.of(hull.points);
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

Shift examine_compound(const Examination& body, Body& b, Compound& compound, Hulls& hulls, std::vector<std::string>* notes) {
    constexpr std::size_t most_parts = 10000;
    if (compound.parts.empty()) body.refuse("/shape/compound/parts", "a compound needs at least one part");
    if (compound.parts.size() > most_parts)
        body.refuse("/shape/compound/parts",
                    "at most " + std::to_string(most_parts) + " parts, are " + std::to_string(compound.parts.size()));
    for (std::size_t i = 0; i < compound.parts.size(); ++i) {
        Part& p = compound.parts[i];
        const Examination part = body.part("/shape/compound/parts/" + std::to_string(i));
        if (std::holds_alternative<Plane>(p.shape)) part.refuse("/shape/plane", "a plane is infinite and no part of a body");
        examine_simple(part, p.shape, b.motion);
        part.between("/position", p.position, -largest_size, largest_size, " m");
        part.make_unit("/orientation", p.orientation, "a quaternion x, y, z, w; no turn is [0, 0, 0, 1]");
        if (p.density != 0) part.between("/density", p.density, smallest_density, largest_density, " kg/m^3");
        if (auto* hull = std::get_if<Hull>(&p.shape)) examine_hull(part, p.position, p.orientation, *hull, hulls, notes);
    }
    const Recentred before = bring_to_centre(compound, b.density);
    if (before.centre == dvec3(0) && before.axes == glm::dquat(1, 0, 0, 0)) return {};
    move_frame(b.position, b.orientation, before.centre, before.axes);
    return before;
}

void examine_mesh(const Examination& body, Body& b, std::vector<std::string>* notes) {
    auto* mesh = std::get_if<Mesh>(&b.shape);
    auto* field = std::get_if<HeightField>(&b.shape);
    if (b.motion == Motion::dynamic)
        body.refuse("/motion",
                    std::string("a ") + (mesh ? "mesh" : "height field") +
                        " must be \"fixed\" or \"kinematic\": it is a surface and has no mass; use a hull or a compound");
    const std::string key = mesh ? "/shape/mesh" : "/shape/height_field";
    try {
        if (mesh) {
            if (mesh->triangles.empty() && !mesh->file.empty())
                body.refuse(key + "/file", "\"" + mesh->file + "\" has not been read");
            for (std::size_t k = 0; k < mesh->vertices.size(); ++k)
                body.between((key + "/vertices/" + std::to_string(k)).c_str(), mesh->vertices[k], -largest_size, largest_size,
                             " m");
            mesh->form = std::make_shared<const MeshForm>(mesh_form(mesh->vertices, mesh->triangles));
        } else {
            if (field->columns < 2 || field->rows < 2 || field->columns > 30000 || field->rows > 30000)
                body.refuse(key, "columns and rows must be between 2 and 30000, are " + std::to_string(field->columns) + " and " +
                                     std::to_string(field->rows));
            if (field->heights.size() != std::size_t{field->columns} * field->rows)
                body.refuse(key + "/heights",
                            "must be columns * rows = " + std::to_string(std::size_t{field->columns} * field->rows) +
                                " heights, are " + std::to_string(field->heights.size()));
            body.between((key + "/spacing").c_str(), field->spacing, smallest_size, largest_size, " m");
            for (std::size_t k = 0; k < field->heights.size(); ++k)
                body.between((key + "/heights/" + std::to_string(k)).c_str(), field->heights[k], -largest_size, largest_size,
                             " m");
            field->form = std::make_shared<const MeshForm>(mesh_form(*field));
        }
    } catch (const MeshError& error) {
        body.refuse(key + error.place, error.what());
    }
    const std::string odd = mesh && notes ? oddities(*mesh->form) : "";
    if (!odd.empty()) notes->push_back(body.place() + key + ": " + odd);
}

// After position and orientation: what has its own centre moves them.
Shift examine_whole(const Examination& body, Body& b, Hulls& hulls, std::vector<std::string>* notes) {
    if (auto* hull = std::get_if<Hull>(&b.shape)) return examine_hull(body, b.position, b.orientation, *hull, hulls, notes);
    if (auto* compound = std::get_if<Compound>(&b.shape)) return examine_compound(body, b, *compound, hulls, notes);
    if (std::holds_alternative<Mesh>(b.shape) || std::holds_alternative<HeightField>(b.shape)) examine_mesh(body, b, notes);
    return {};
}

Shift examine(const Examination& body, Body& b, Hulls& hulls, std::vector<std::string>* notes) {
    if (std::optional<SimpleShape> simple = simple_shape(b.shape)) {
        examine_simple(body, *simple, b.motion);
        b.shape = whole_shape(*simple);
    }
    fields::check_fields(body, b);
    const Shift shift = examine_whole(body, b, hulls, notes);
    if (b.motion == Motion::fixed && (b.velocity != vec3(0) || b.angular_velocity != vec3(0))) {
        body.refuse("/velocity", "a fixed body has no velocity; a body that moves whatever it meets is \"kinematic\"");
    }
    const MassProperties properties = mass_properties(b.shape, b.density);
    const bool representable = std::isnormal(properties.mass) && std::isnormal(properties.inertia.x) &&
                               std::isnormal(properties.inertia.y) && std::isnormal(properties.inertia.z) &&
                               std::isnormal(1 / properties.mass) && std::isnormal(1 / properties.inertia.x) &&
                               std::isnormal(1 / properties.inertia.y) && std::isnormal(1 / properties.inertia.z);
    if (b.motion == Motion::dynamic && !representable) {
        body.refuse("/density", "size and density give a mass or inertia out of the range of a float");
    }
    return shift;
}

}  // namespace

SceneError::SceneError(std::string place, const std::string& reason)
    : std::runtime_error(place.empty() ? reason : place + ": " + reason), pointer(std::move(place)) {}

Scene checked(Scene scene, std::vector<std::string>* notes) {
    Hulls hulls;
    fields::check_field(Examination(), scene, fields::field_of(&Scene::gravity));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].piece_of != no_body) continue;  // of a scene that was checked before
        const Shift shift = examine(Examination("bodies", "body", i, scene.bodies[i].name), scene.bodies[i], hulls, notes);
        if (shift) shift_joints(scene, i, shift->centre, shift->axes);
    }
    check_joints(scene);
    check_vehicles(scene);
    add_pieces(scene);
    return scene;
}

}  // namespace scree
