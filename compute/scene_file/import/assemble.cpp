// From a model to a scene: bodies that move as one become one, shapes are placed, masses summed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/import/model.h"
#include "compute/schema/body.h"

namespace scree::imports {

namespace {

// The shapes that one body of the scene has, in its frame.
struct Shapes {
    std::vector<const Geometry*> geometries;
    std::vector<Placed> placed;
};

bool same_material(const Material& a, const Material& b) {
    bool same = true;
    schema::for_each_field<Material>([&](const auto& field) { same = same && a.*field.member == b.*field.member; });
    return same;
}

// Bit 0 is everything else in the scene, with which all of them collide.
std::vector<std::optional<Filter>> filters_of(const Model& model) {
    const std::size_t count = model.collides.size();
    std::vector<std::optional<Filter>> filters(count);
    const auto meets_all = [](const std::vector<bool>& row) { return std::find(row.begin(), row.end(), false) == row.end(); };
    if (std::all_of(model.collides.begin(), model.collides.end(), meets_all)) return filters;
    for (std::size_t i = 0; i < count; ++i) {
        Filter& filter = filters[i].emplace();
        filter.category = 2u << i;
        filter.mask = 1;
        for (std::size_t j = 0; j < count; ++j)
            if (model.collides[i][j]) filter.mask |= 2u << j;
    }
    return filters;
}

// Keeps the frame of what the file describes, in which the body's own is `frame`.
void keep_origin(Body& body, const Placed& frame) {
    const Placed origin = inverse(frame);
    if (frame.position == dvec3(0) && frame.turn == dquat(1, 0, 0, 0)) return;
    body.origin = BodyFrame{vec3(origin.position), single_quaternion(glm::normalize(origin.turn))};
}

void place(Body& body, const Placed& placed) {
    body.position = vec3(placed.position);
    body.orientation = single_quaternion(glm::normalize(placed.turn));
}

// One shape is the body's own, whose frame is the shape's; several are parts of a compound. Returns the body's frame.
Placed give_shape(Body& body, const Shapes& shapes, const std::vector<std::optional<Filter>>& filters) {
    if (shapes.geometries.empty()) {
        body.shape = Compound{};
        return {};
    }
    const Geometry* usual = shapes.geometries[0];  // whose surface is the body's
    for (const Geometry* one : shapes.geometries)
        if (one->solid) {
            usual = one;
            break;
        }
    set_material(body, usual->material);
    for (const Geometry* one : shapes.geometries)
        if (!body.color) body.color = one->color;
    body.filter = filters[usual->collides_as];
    if (!usual->solid) body.role = usual->sensor ? Role::sensor : Role::drawn;
    if (shapes.geometries.size() == 1 && !usual->parts) {
        body.shape = usual->terrain ? *usual->terrain : whole_shape(usual->shape);
        return shapes.placed[0];
    }
    Compound compound;
    for (std::size_t i = 0; i < shapes.geometries.size(); ++i) {
        const Geometry& one = *shapes.geometries[i];
        const Placed& placed = shapes.placed[i];
        for (std::size_t k = 0; k < (one.parts ? one.parts->parts.size() : 1); ++k) {
            Part& part = compound.parts.emplace_back();
            part.shape = one.parts ? one.parts->parts[k].shape : one.shape;
            part.skinned = one.parts != nullptr;
            part.position = vec3(placed.position);
            part.orientation = single_quaternion(placed.turn);
            if (!one.solid) {
                part.role = one.sensor ? Role::sensor : Role::drawn;
                if (!one.sensor) continue;
            }
            if (!same_material(one.material, usual->material)) part.material = one.material;
            if (one.collides_as != usual->collides_as) part.filter = filters[one.collides_as];
        }
        if (one.parts && !one.sensor)
            compound.skins.push_back({one.parts->skins[0].mesh, vec3(placed.position), single_quaternion(placed.turn)});
    }
    body.shape = std::move(compound);
    return {};
}

Inertial inertial_of(const SolidMass& mass, const Origin& at) {
    if (!(mass.mass > 0)) refuse(at, "moves, and has no mass; give it inertial properties, or a solid with a density");
    const dmat3 axes = principal_axes(mass.inertia);
    const dmat3 along = glm::transpose(axes) * mass.inertia * axes;
    Inertial inertial;
    inertial.mass = static_cast<float>(mass.mass);
    inertial.centre = vec3(mass.centre);
    for (int k = 0; k < 3; ++k) {
        if (!(along[k][k] > 0)) refuse(at, "moves, and has no moment of inertia about one of its axes");
        inertial.inertia[k] = static_cast<float>(along[k][k]);
    }
    inertial.frame = single_quaternion(glm::normalize(glm::quat_cast(axes)));
    return inertial;
}

// Each shape that nothing moves is a body of its own.
void add_fixed(Assembly& all, std::size_t index, const std::vector<std::optional<Filter>>& filters) {
    const ModelBody& from = all.model.bodies[index];
    const auto add = [&](Body body, const Origin& origin) {
        all.bodies[index].push_back(all.scene.bodies.size());
        all.origins.push_back(origin);
        all.scene.bodies.push_back(std::move(body));
    };
    if (from.shapeless) {
        Body body{.name = from.name, .motion = Motion::fixed, .shape = Compound{}};
        place(body, all.root * all.zero[index]);
        add(std::move(body), from.origin);
    }
    for (const Geometry& one : from.geometries) {
        const Placed placed = all.root * all.zero[index] * one.placed;
        Body body{.name = one.name.empty() ? from.name : one.name,
                  .motion = Motion::fixed,
                  .shape = one.terrain ? *one.terrain
                           : one.parts ? Shape(*one.parts)
                                       : whole_shape(one.shape)};
        place(body, placed);
        set_material(body, one.material);
        body.color = one.color;
        body.filter = filters[one.collides_as];
        if (!one.solid) body.role = one.sensor ? Role::sensor : Role::drawn;
        if (auto* plane = std::get_if<Plane>(&body.shape)) {
            const dvec3 normal = placed.turn * dvec3(plane->normal);
            *plane = {vec3(normal), static_cast<float>(glm::dot(normal, placed.position))};
            place(body, {});
        } else {
            keep_origin(body, one.placed);
        }
        add(std::move(body), one.origin);
    }
}

struct Carried {  // what a moving body carries: its own and that of those fixed to it
    Shapes shapes;
    SolidMass mass, mass_of_shapes;
};

bool has_all_moments(const SolidMass& mass) {
    const dmat3 axes = principal_axes(mass.inertia), along = glm::transpose(axes) * mass.inertia * axes;
    const double least = 1e-9 * (along[0][0] + along[1][1] + along[2][2]);
    return along[0][0] > least && along[1][1] > least && along[2][2] > least;
}

// What a file leaves out of the mass of what moves, from its shapes.
SolidMass completed(const Carried& carried, const Origin& at, Notes& notes) {
    const SolidMass &given = carried.mass, &shapes = carried.mass_of_shapes;
    if (!(shapes.mass > 0) || (given.mass > 0 && has_all_moments(given))) return given;
    if (!(given.mass > 0)) {
        notes.add(at, "inertial", "is missing or of 0 kg; its mass is that of its collision shapes at 1000 kg/m^3");
        return shapes;
    }
    notes.add(at, "inertia", "is missing or 0; it is that of its collision shapes, for its mass");
    return {given.mass, given.centre, scaled_mass(shapes, given.mass / shapes.mass).inertia};
}

void add_moving(Assembly& all, std::size_t index, const Carried& carried, const ModelMotion& start,
                const std::vector<std::optional<Filter>>& filters) {
    const ModelBody& from = all.model.bodies[index];
    const std::vector<const Geometry*>& geometries = carried.shapes.geometries;
    for (const Geometry* one : geometries)
        if (one->terrain && (!from.kinematic || geometries.size() > 1))
            refuse(one->origin, "a height field or mesh that moves must be the only shape of a kinematic body");
    Body body{.name = from.name, .motion = from.kinematic ? Motion::kinematic : Motion::dynamic};
    const Placed frame = all.frames[index] = give_shape(body, carried.shapes, filters);
    place(body, all.root * start.placed * frame);
    keep_origin(body, frame);
    if (!from.kinematic) {
        const SolidMass mass = completed(carried, from.origin, all.notes);
        body.inertial = inertial_of(placed_mass(mass, inverse(frame)), from.origin);
        body.velocity = vec3(all.root.turn * start.velocity_at(start.placed * mass.centre));
        body.angular_velocity = vec3(all.root.turn * start.spin);
        body.gravity_scale = from.gravity_scale;
    } else {
        body.velocity = vec3(all.root.turn * start.velocity_at(start.placed * frame.position));
        body.angular_velocity = vec3(all.root.turn * start.spin);
    }
    all.bodies[index] = {all.scene.bodies.size()};
    all.origins.push_back(from.origin);
    all.scene.bodies.push_back(std::move(body));
}

void add_all_bodies(Assembly& all) {
    const Model& model = all.model;
    const std::vector<ModelMotion> starts = motions_of(model, true);
    const auto filters = filters_of(model);
    std::vector<Carried> carried(model.bodies.size());
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const ModelBody& body = model.bodies[b];
        const bool moves = body.free || body.kinematic || !body.joints.empty();
        all.owner.push_back(moves || b == world_body ? b : all.owner[body.parent]);
        const std::size_t owner = all.owner[b];
        if (owner == world_body) continue;
        const Placed within = inverse(all.zero[owner]) * all.zero[b];
        carried[owner].mass = sum_of(carried[owner].mass, placed_mass(body.mass, within));
        carried[owner].mass_of_shapes = sum_of(carried[owner].mass_of_shapes, placed_mass(body.mass_of_shapes, within));
        for (const Geometry& one : body.geometries) {
            carried[owner].shapes.geometries.push_back(&one);
            carried[owner].shapes.placed.push_back(owner == b ? one.placed : within * one.placed);
        }
    }
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        if (all.owner[b] == world_body) add_fixed(all, b, filters);
        if (all.owner[b] == b && b != world_body) add_moving(all, b, carried[b], starts[b], filters);
        if (all.owner[b] != b && all.owner[b] != world_body) all.bodies[b] = all.bodies[all.owner[b]];
    }
}

// How far the solid parts of a checked body reach in a direction of its own axes, from its position; none if it has none.
std::optional<double> solid_reach(const Body& body, const dvec3& direction) {
    const auto* compound = std::get_if<Compound>(&body.shape);
    if (body.role != Role::solid || std::holds_alternative<Plane>(body.shape)) return std::nullopt;
    if (!compound) return reach_along(body.shape, direction);
    std::optional<double> farthest;
    for (const Part& part : compound->parts) {
        if (part.role != Role::solid) continue;
        const dvec3 inside = glm::conjugate(glm::normalize(double_quaternion(part.orientation))) * direction;
        const double reach = glm::dot(dvec3(part.position), direction) + reach_along(whole_shape(part.shape), inside);
        farthest = std::max(farthest.value_or(reach), reach);
    }
    return farthest;
}

// A plane that the lowest solid point touches.
void add_ground(Scene& scene, const Scene& checked_scene, bool z_is_up) {
    const dvec3 up = z_is_up ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    std::optional<double> lowest;
    for (const Body& body : checked_scene.bodies) {
        const auto reach = solid_reach(body, glm::conjugate(glm::normalize(double_quaternion(body.orientation))) * -up);
        const double height = glm::dot(dvec3(body.position), up) - reach.value_or(0);
        if (reach) lowest = std::min(lowest.value_or(height), height);
    }
    scene.bodies.push_back(
        {.name = "ground", .motion = Motion::fixed, .shape = Plane{vec3(up), static_cast<float>(lowest.value_or(0))}});
}

// An error of the scene's validation, in the words of the file.
[[noreturn]] void refuse_as(const Assembly& all, const SceneError& error) {
    for (const auto& [list, origins] : {std::pair{"/bodies/", &all.origins}, std::pair{"/joints/", &all.joint_origins}}) {
        const std::string& pointer = error.pointer;
        if (!pointer.starts_with(list)) continue;
        const std::size_t index = std::strtoull(pointer.c_str() + 8, nullptr, 10);
        const std::size_t rest = std::min(pointer.find('/', 8), pointer.size());
        if (index < origins->size())
            refuse((*origins)[index], pointer.substr(rest) + std::string(error.what()).substr(pointer.size()));
    }
    throw ImportError(all.origins.empty() ? error.what() : all.origins[0].file + ": " + error.what());
}

}  // namespace

std::size_t add_link(Assembly& all, std::size_t index, const Placed& start) {
    const Inertial& whole = *all.scene.bodies[all.bodies[index][0]].inertial;
    Body link{.name = all.model.bodies[index].name + " link", .shape = Compound{}};
    link.inertial = Inertial{.mass = 0.01f * whole.mass};
    link.inertial->inertia = vec3(0.01f * std::max({whole.inertia.x, whole.inertia.y, whole.inertia.z}));
    place(link, all.root * start);
    all.origins.push_back(all.model.bodies[index].origin);
    all.scene.bodies.push_back(std::move(link));
    return all.scene.bodies.size() - 1;
}

Scene assemble(const Model& model, const ImportOptions& options, Notes& notes) {
    const bool turned = model.z_up && options.axes == ImportedAxes::y_up;
    const double half = std::sqrt(0.5);
    Assembly all{model, notes, {dvec3(0), turned ? dquat(half, -half, 0, 0) : dquat(1, 0, 0, 0)}, {}, {}, {}, {}, {}, {}};
    for (const ModelMotion& one : motions_of(model, false)) all.zero.push_back(one.placed);
    all.bodies.resize(model.bodies.size());
    all.frames.resize(model.bodies.size());
    const dvec3 g = model.gravity;
    all.scene.gravity = vec3(turned ? dvec3(g.x, g.z, -g.y) : g);
    try {
        add_all_bodies(all);
        add_joints(all);
        std::vector<std::string> remarks;
        const Scene made = checked(all.scene, &remarks);
        for (const std::string& remark : remarks) {  // "/bodies/7/shape/...: words", "/joints/7: words"
            const bool of_joint = remark.starts_with("/joints/");
            const std::vector<Origin>& origins = of_joint ? all.joint_origins : all.origins;
            const std::size_t index = std::strtoull(remark.c_str() + 8, nullptr, 10);
            const std::size_t words = remark.find(": ");
            if (index < origins.size() && words != remark.npos)
                notes.add(origins[index], of_joint ? "joint" : "shape", remark.substr(words + 2));
        }
        if (options.ground) add_ground(all.scene, made, model.z_up && !turned);
    } catch (const SceneError& error) {
        refuse_as(all, error);
    } catch (const HullError& error) {
        throw ImportError(std::string("a mesh has no hull: ") + error.what());
    }
    return std::move(all.scene);
}

}  // namespace scree::imports
