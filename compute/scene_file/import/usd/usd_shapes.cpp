// Colliders of UsdPhysics as shapes, and masses of bodies.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compute/scene/meshes/hull.h"
#include "compute/scene_file/import/gltf/gltf_shapes.h"
#include "compute/scene_file/import/srgb.h"
#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

constexpr double usual_density = 1000;  // kg/m^3, as of a scene's bodies
constexpr std::size_t most_corners = 100'000'000;

// From the axis along which a shape lies to y, along which scree's do.
glm::dmat4 along_y(const std::string& axis) {
    dmat3 turn(1);  // cyclic: it stays right-handed
    if (axis == "X") turn = dmat3(dvec3(0, 0, 1), dvec3(1, 0, 0), dvec3(0, 1, 0));
    if (axis == "Z") turn = dmat3(dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1, 0, 0));
    return glm::dmat4(turn);
}

class Shapes {
public:
    Shapes(const UsdStage& stage, const UsdUnits& units, UsdFound& found, Model& model, Notes& notes)
        : stage_(stage),
          units_(units),
          found_(found),
          model_(model),
          notes_(notes),
          masses_(model.bodies.size()),
          shapes_(model.bodies.size(), 0) {}
    void add_all();

private:
    void add(UsdCollider& collider);
    void add_implicit(const UsdCollider& collider, Geometry like, SolidMass& mass);
    void add_mesh(const UsdCollider& collider, Geometry like, SolidMass& mass);
    void add_pieces(const UsdCollider& collider, const Geometry& like, const std::string& how, SolidMass& mass);
    void add_bounds(const UsdCollider& collider, Geometry like, bool round, SolidMass& mass);
    void read_mesh(const UsdCollider& collider);
    void keep(const UsdCollider& collider, Geometry geometry) {
        model_.bodies[collider.body].geometries.push_back(std::move(geometry));
    }
    std::optional<vec3> color_of(const UsdPrim& prim) const;
    glm::dmat4 frame_in_body(const UsdCollider& collider) const {
        return matrix_of(inverse(model_.bodies[collider.body].placed)) * collider.world;
    }

    const UsdStage& stage_;
    const UsdUnits& units_;
    UsdFound& found_;
    Model& model_;
    Notes& notes_;
    std::vector<SolidMass> masses_;    // of bodies
    std::vector<std::size_t> shapes_;  // of each body, without what is only drawn
    std::vector<vec3> vertices_;       // of the mesh at hand, in its own units
    std::vector<glm::uvec3> triangles_;
    std::size_t corners_ = 0;
};

std::optional<vec3> Shapes::color_of(const UsdPrim& prim) const {
    const UsdValue value = stage_.value(prim, "primvars:displayColor");
    if (value.kind != UsdValue::Kind::numbers || value.numbers.size() < 3) return std::nullopt;
    vec3 color;
    for (int k = 0; k < 3; ++k) color[k] = static_cast<float>(value.numbers[static_cast<std::size_t>(k)]);
    if (!(glm::length(color) < 1e6f)) return std::nullopt;
    return srgb_of(color);
}

void Shapes::add_implicit(const UsdCollider& collider, Geometry like, SolidMass& mass) {
    using Kind = ImplicitShape::Kind;
    const UsdPrim& prim = *collider.prim;
    const Origin at = stage_.at(prim);
    const auto above_0 = [&](const char* name, double otherwise) {
        const double value = stage_.number(prim, name, otherwise);
        if (!(value > 0 && value < 1e15)) refuse(at, std::string(name) + ": must be above 0");
        return value;
    };
    ImplicitShape shape;
    glm::dmat4 frame = frame_in_body(collider);
    if (prim.type == "Cube") {
        shape.size = dvec3(above_0("size", 2));
    } else if (prim.type == "Sphere") {
        shape.kind = Kind::sphere;
        shape.bottom = above_0("radius", 1);
    } else {
        const std::string axis = stage_.text(prim, "axis", "Z");
        if (axis != "X" && axis != "Y" && axis != "Z") refuse(at, "axis: must be X, Y or Z");
        frame *= along_y(axis);
        const bool capsule = prim.type.starts_with("Capsule"), two = prim.type.ends_with("_1");
        if (prim.type == "Plane") {
            shape.kind = Kind::plane;
        } else {
            shape.kind = capsule ? Kind::capsule : Kind::cylinder;
            const double radius = capsule ? 0.5 : 1;
            shape.bottom = above_0(two ? "radiusBottom" : "radius", radius);
            shape.top = two ? above_0("radiusTop", radius) : shape.bottom;
            if (prim.type == "Cone") shape.top = 0;
            shape.height = stage_.number(prim, "height", capsule ? 1 : 2);
            if (!(shape.height >= 0 && shape.height < 1e15) || (shape.height == 0 && (!capsule || two)))
                refuse(at, "height: must be above 0");
            if (shape.height == 0) shape.kind = Kind::sphere;
        }
    }
    GltfShape made;
    try {
        made = stretched_shape(shape, frame, [&](const char* kind, const std::string& reason) { notes_.add(at, kind, reason); });
    } catch (const HullError& error) {
        refuse(at, error.what());
    }
    mass = made.mass;
    for (const GltfShape::Part& part : made.parts) {
        like.shape = part.shape, like.placed = part.placed;
        keep(collider, like);
    }
    if (shape.kind == Kind::plane && collider.body != world_body) refuse(at, "a plane is infinite and cannot move");
}

void Shapes::read_mesh(const UsdCollider& collider) {
    const UsdPrim& prim = *collider.prim;
    const Origin at = stage_.at(prim);
    vertices_.clear(), triangles_.clear();
    const UsdValue points = stage_.value(prim, "points"), counts = stage_.value(prim, "faceVertexCounts"),
                   corners = stage_.value(prim, "faceVertexIndices");
    if (points.kind != UsdValue::Kind::numbers || points.width != 3) refuse(at, "points: a mesh has none");
    corners_ += points.count() + corners.numbers.size();
    if (corners_ > most_corners) refuse(at, "with it colliders have more than 100000000 vertices and corners");
    for (std::size_t i = 0; i < points.count(); ++i) {
        const double* p = points.numbers.data() + 3 * i;
        vertices_.emplace_back(p[0], p[1], p[2]);
        if (!(glm::length(vertices_.back()) < 1e15f)) refuse(at, "points: must be numbers below 1e15");
    }
    const auto corner = [&](std::size_t i) {
        const double index = corners.numbers[i];
        if (!(index >= 0 && index < static_cast<double>(vertices_.size())))
            refuse(at, "faceVertexIndices: names a point that is not there");
        return static_cast<std::uint32_t>(index);
    };
    const bool left = stage_.text(prim, "orientation", "rightHanded") == "leftHanded";
    std::size_t first = 0;
    for (const double count : counts.numbers) {
        if (!(count >= 0 && count <= static_cast<double>(corners.numbers.size() - first)))
            refuse(at, "faceVertexCounts: does not fit to faceVertexIndices");
        const auto many = static_cast<std::size_t>(count);
        for (std::size_t k = 2; k < many; ++k) {
            const glm::uvec3 face{corner(first), corner(first + k - 1), corner(first + k)};
            triangles_.push_back(left ? glm::uvec3(face.x, face.z, face.y) : face);
        }
        first += many;
    }
    if (triangles_.empty()) refuse(at, "a mesh has no faces");
}

// Around the points, along the mesh's own axes.
void Shapes::add_bounds(const UsdCollider& collider, Geometry like, bool round, SolidMass& mass) {
    vec3 low(vertices_[0]), high(vertices_[0]);
    for (const vec3& one : vertices_) low = glm::min(low, one), high = glm::max(high, one);
    const dvec3 middle = 0.5 * (dvec3(low) + dvec3(high));
    ImplicitShape shape;
    shape.size = glm::max(dvec3(high) - dvec3(low), dvec3(1e-6));
    if (round) {
        shape.kind = ImplicitShape::Kind::sphere;
        shape.bottom = 0;
        for (const vec3& one : vertices_) shape.bottom = std::max(shape.bottom, glm::length(dvec3(one) - middle));
        shape.bottom = std::max(shape.bottom, 1e-6);
    }
    const glm::dmat4 frame = frame_in_body(collider) * matrix_of({middle, {1, 0, 0, 0}});
    const GltfShape made = stretched_shape(
        shape, frame, [&](const char* kind, const std::string& reason) { notes_.add(stage_.at(*collider.prim), kind, reason); });
    mass = made.mass;
    for (const GltfShape::Part& part : made.parts) {
        like.shape = part.shape, like.placed = part.placed;
        keep(collider, like);
    }
}

// The convex hull of a mesh, or its convex parts where that is not what `how` asks for.
void Shapes::add_pieces(const UsdCollider& collider, const Geometry& like, const std::string& how, SolidMass& mass) {
    const Origin at = stage_.at(*collider.prim);
    const bool hull = how == "convexHull", parts = how == "convexDecomposition";
    const MeshSolid solid = mesh_solid(vertices_, triangles_, {0}, !hull);
    if (!solid.flaw.empty()) refuse(at, "its mesh has no convex hull: " + solid.flaw);
    if (!solid.remark.empty()) notes_.add(at, "approximation", solid.remark);
    if (!hull && !parts) notes_.add(at, "approximation", "\"" + how.substr(0, 60) + "\" of a mesh that moves becomes convex");
    mass = placed_mass(hull ? hull_mass(solid.hulls[0]) : solid.mass, like.placed);
    for (std::size_t k = 0; k < solid.hulls.size(); ++k) {
        Geometry one = like;
        one.shape = Hull{solid.hulls[k]};
        one.parts = solid.parts[k];
        keep(collider, std::move(one));
    }
}

void Shapes::add_mesh(const UsdCollider& collider, Geometry like, SolidMass& mass) {
    const UsdPrim& prim = *collider.prim;
    read_mesh(collider);
    const std::string how = stage_.text(prim, "physics:approximation", "none");
    if (how == "boundingCube" || how == "boundingSphere") return add_bounds(collider, like, how == "boundingSphere", mass);
    like.placed = placed_of(frame_in_body(collider));
    const glm::dmat4 frame = matrix_of(inverse(like.placed)) * frame_in_body(collider);
    map_mesh({dmat3(frame), dvec3(frame[3])}, vertices_, triangles_);
    const bool fixed = collider.body == world_body;
    const bool is_surface = fixed || (how == "none" && model_.bodies[collider.body].kinematic && shapes_[collider.body] == 1);
    if (!is_surface || how == "convexHull") return add_pieces(collider, like, how, mass);
    like.terrain = std::make_shared<Shape>(Mesh{vertices_, triangles_});
    keep(collider, std::move(like));
}

void Shapes::add(UsdCollider& collider) {
    const UsdPrim& prim = *collider.prim;
    const Origin at = stage_.at(prim);
    const dvec3 scale = scale_of(collider.world);
    if (!(std::abs(glm::determinant(dmat3(collider.world))) > 1e-9 * scale.x * scale.y * scale.z) ||
        scale.x * scale.y * scale.z == 0)
        refuse(at, "its transform is flat");
    Geometry like;
    like.origin = at;
    like.name = collider.path;
    like.color = color_of(prim);
    like.collides_as = collider.group;
    double density = collider.density;
    if (!collider.material.empty()) like.material = usd_material(stage_, collider.material);
    const UsdPrim* material = collider.material.empty() ? nullptr : stage_.find(collider.material);
    if (material && material->applies("PhysicsMaterialAPI") && !(density > 0))
        density =
            stage_.number(*material, "physics:density", 0) * units_.kilograms / (units_.meters * units_.meters * units_.meters);
    SolidMass mass;
    collider.first = model_.bodies[collider.body].geometries.size();
    if (prim.type == "Mesh")
        add_mesh(collider, std::move(like), mass);
    else if (prim.type == "Cube" || prim.type == "Sphere" || prim.type == "Plane" || prim.type == "Cone" ||
             prim.type.starts_with("Capsule") || prim.type.starts_with("Cylinder"))
        add_implicit(collider, std::move(like), mass);
    else
        notes_.add(at, "PhysicsCollisionAPI", "of a prim of type \"" + prim.type.substr(0, 60) + "\" is left out");
    collider.count = model_.bodies[collider.body].geometries.size() - collider.first;
    if (collider.body == world_body || !(mass.mass > 0)) return;
    mass = scaled_mass(mass, density > 0 ? density : usual_density);
    const double given = prim.applies("PhysicsMassAPI") && !prim.applies("PhysicsRigidBodyAPI")
                             ? stage_.number(prim, "physics:mass", 0) * units_.kilograms
                             : 0;
    if (given > 0) mass = scaled_mass(mass, given / mass.mass);
    masses_[collider.body] = sum_of(masses_[collider.body], mass);
}

void Shapes::add_all() {
    std::vector<UsdCollider> colliders;
    std::vector<std::optional<vec3>> colors(model_.bodies.size());
    for (const UsdCollider& one : found_.colliders)
        if (!(one.density < 0)) ++shapes_[one.body];
    for (UsdCollider& one : found_.colliders) {
        if (one.density < 0) {  // drawn only
            if (!colors[one.body]) colors[one.body] = color_of(*one.prim);
            continue;
        }
        add(one);
        colliders.push_back(std::move(one));
    }
    found_.colliders = std::move(colliders);
    for (std::size_t b = 1; b < colors.size(); ++b) {
        auto& geometries = model_.bodies[b].geometries;
        if (!geometries.empty() && !geometries[0].color && colors[b]) geometries[0].color = colors[b];
    }
    finish_usd_masses(stage_, units_, found_, masses_, model_, notes_);
}

}  // namespace

void add_usd_shapes(const UsdStage& stage, const UsdUnits& units, UsdFound& found, Model& model, Notes& notes) {
    Shapes(stage, units, found, model, notes).add_all();
}

}  // namespace scree::imports
