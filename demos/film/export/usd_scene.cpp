// Scenes as UsdPhysics. https://openusd.org/release/api/usd_physics_page_front.html
#include "demos/film/export/usd_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "demos/film/export/usd_joints.h"
#include "host/canvas/colors.h"

namespace scree::demos {

namespace {

using Out = std::back_insert_iterator<std::string>;
constexpr float degrees = static_cast<float>(180 / std::numbers::pi);

std::string triple(vec3 v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
std::string turn(vec4 q) {
    return fmt::format("({}, {}, {}, {})", q.w, q.x, q.y, q.z);
}

struct Faces {
    std::vector<vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> counts;
};
Faces faces_of(const HullForm& form) {
    Faces made;
    for (const glm::dvec3& one : form.vertices) made.points.emplace_back(one);
    for (const HullForm::Face& face : form.faces) {
        made.counts.push_back(face.corners.size());
        made.corners.insert(made.corners.end(), face.corners.begin(), face.corners.end());
    }
    return made;
}
Faces faces_of(const MeshForm& form) {
    Faces made;
    for (const MeshForm::Triangle& triangle : form.triangles) {
        made.counts.push_back(3);
        for (const vec3& corner : triangle.corners) {
            made.corners.push_back(static_cast<std::uint32_t>(made.points.size()));
            made.points.push_back(triangle.middle + corner);
        }
    }
    return made;
}

class UsdScene {
public:
    UsdScene(const Scene& scene, std::vector<std::string>& notes) : scene_(scene), notes_(notes) {}
    std::string text();

private:
    void note(const std::string& words) {
        if (said_.insert(words).second) notes_.push_back(words);
    }
    std::string path_of(std::size_t body) const { return "/World/" + names_[body]; }
    void name_bodies();
    std::size_t material_at(const Material& material);
    std::size_t filter_at(const std::optional<Filter>& filter);
    void put_body(std::size_t index);
    void put_shape(const std::string& path, const std::string& name, const Shape& shape, vec3 position, vec4 orientation,
                   const Body& body, const Part* part);
    void put_faces(const Faces& faces, const char* approximation);
    void put_materials();
    void put_groups();
    void note_rest();

    const Scene& scene_;
    std::vector<std::string>& notes_;
    std::set<std::string> said_;
    std::string out_;
    std::vector<std::string> names_;
    std::vector<Material> materials_;
    std::vector<std::optional<Filter>> filters_;
    std::vector<std::vector<std::string>> members_;  // of the filters: paths of colliders
};

// Letters, digits and underscores, of which the first is no digit.
void UsdScene::name_bodies() {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
        std::string name;
        for (const char c : scene_.bodies[i].name.substr(0, 60))
            name += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '_';
        if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name = "body" + name;
        names_.push_back(name + "_" + std::to_string(i));
    }
}

std::size_t UsdScene::material_at(const Material& m) {
    for (std::size_t i = 0; i < materials_.size(); ++i)
        if (materials_[i].friction == m.friction && materials_[i].static_friction == m.static_friction &&
            materials_[i].restitution == m.restitution && materials_[i].friction_rule == m.friction_rule &&
            materials_[i].restitution_rule == m.restitution_rule)
            return i;
    materials_.push_back(m);
    return materials_.size() - 1;
}

std::size_t UsdScene::filter_at(const std::optional<Filter>& filter) {
    const auto found = std::find(filters_.begin(), filters_.end(), filter);
    const auto index = static_cast<std::size_t>(found - filters_.begin());
    if (found == filters_.end()) filters_.push_back(filter), members_.emplace_back();
    return index;
}

void UsdScene::put_faces(const Faces& faces, const char* approximation) {
    const auto list = [&](const char* type, const auto& all, const auto& each) {
        fmt::format_to(Out(out_), "            {} = [", type);
        for (std::size_t i = 0; i < all.size(); ++i) out_ += (i > 0 ? ", " : "") + each(all[i]);
        out_ += "]\n";
    };
    const auto number = [](auto n) { return std::to_string(n); };
    list("int[] faceVertexCounts", faces.counts, number);
    list("int[] faceVertexIndices", faces.corners, number);
    list("point3f[] points", faces.points, triple);
    fmt::format_to(
        Out(out_),
        "            uniform token physics:approximation = \"{}\"\n            uniform token subdivisionScheme = \"none\"\n",
        approximation);
}

// Type, and what it says of its size. A cone's middle is not its centre of mass.
struct UsdKind {
    std::string type, text;
    vec3 shift{0}, scale{1};
};
UsdKind kind_of(const Shape& shape) {
    if (const auto* s = std::get_if<Sphere>(&shape))
        return {"Sphere", fmt::format("            double radius = {}\n", s->radius)};
    if (const auto* s = std::get_if<Ellipsoid>(&shape)) return {"Sphere", "            double radius = 1\n", {}, s->radii};
    if (const auto* s = std::get_if<Box>(&shape)) return {"Cube", "            double size = 2\n", {}, s->half_extents};
    const auto along_y = [](const char* type, const std::string& sizes, vec3 shift = vec3(0)) {
        return UsdKind{type, "            uniform token axis = \"Y\"\n" + sizes, shift};
    };
    const auto sizes = [](float radius, float height) {
        return fmt::format("            double height = {}\n            double radius = {}\n", height, radius);
    };
    if (const auto* s = std::get_if<Capsule>(&shape)) return along_y("Capsule", sizes(s->radius, 2 * s->half_height));
    if (const auto* s = std::get_if<Cylinder>(&shape)) return along_y("Cylinder", sizes(s->radius, 2 * s->half_height));
    if (const auto* s = std::get_if<Cone>(&shape)) return along_y("Cone", sizes(s->radius, s->height), {0, 0.25f * s->height, 0});
    if (std::holds_alternative<Plane>(shape))
        return along_y("Plane", "            double length = 100\n            double width = 100\n");
    return {"Mesh", ""};
}

void UsdScene::put_shape(const std::string& path, const std::string& name, const Shape& shape, vec3 position, vec4 orientation,
                         const Body& body, const Part* part) {
    const UsdKind kind = kind_of(shape);
    const glm::quat q(orientation.w, orientation.x, orientation.y, orientation.z);
    const Role role = body.role != Role::solid ? body.role : part ? part->role : Role::solid;
    const bool solid = role == Role::solid;
    if (role == Role::sensor) note("sensors are left out; their shapes are drawn");
    const bool mesh = kind.type == "Mesh";
    fmt::format_to(
        Out(out_), "        def {} \"{}\" (\n            prepend apiSchemas = [{}]\n        )\n        {{\n", kind.type, name,
        solid ? std::string("\"MaterialBindingAPI\", \"PhysicsCollisionAPI\"") + (mesh ? ", \"PhysicsMeshCollisionAPI\"" : "")
              : std::string());
    out_ += kind.text;
    if (const auto* hull = std::get_if<Hull>(&shape)) put_faces(faces_of(*hull->form), "convexHull");
    if (const MeshForm* form = mesh_form_of(shape)) put_faces(faces_of(*form), "none");
    if (body.color)
        fmt::format_to(Out(out_), "            color3f[] primvars:displayColor = [{}]\n",
                       triple(host::linear_from_srgb(*body.color)));
    if (solid) {
        fmt::format_to(Out(out_), "            rel material:binding:physics = </World/Materials/material_{}>\n",
                       material_at(part && part->material ? *part->material : material_of(body)));
        members_[filter_at(part && part->filter ? part->filter : body.filter)].push_back(path + "/" + name);
    }
    fmt::format_to(
        Out(out_),
        "            quatf xformOp:orient = {}\n            float3 xformOp:scale = {}\n            double3 xformOp:translate = "
        "{}\n"
        "            uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]\n        }}\n",
        turn(orientation), triple(kind.scale), triple(position + q * kind.shift));
}

void UsdScene::put_body(std::size_t index) {
    const Body& body = scene_.bodies[index];
    const bool moves = body.motion != Motion::fixed, dynamic = body.motion == Motion::dynamic;
    std::string schemas, says;
    if (moves) {
        schemas = "\"PhysicsRigidBodyAPI\"";
        if (!dynamic) says += "        bool physics:kinematicEnabled = 1\n";
        fmt::format_to(Out(says), "        vector3f physics:velocity = {}\n        vector3f physics:angularVelocity = {}\n",
                       triple(body.velocity), triple(body.angular_velocity * degrees));
    }
    if (dynamic) {
        const MassProperties mass = mass_properties(body);
        schemas += ", \"PhysicsMassAPI\"";
        fmt::format_to(Out(says),
                       "        float physics:mass = {}\n        point3f physics:centerOfMass = (0, 0, 0)\n        float3 "
                       "physics:diagonalInertia = {}\n"
                       "        quatf physics:principalAxes = (1, 0, 0, 0)\n",
                       mass.mass, triple(mass.inertia));
        if (body.linear_damping > 0 || body.angular_damping > 0 || body.gravity_scale == 0) {
            schemas += ", \"PhysxRigidBodyAPI\"";
            fmt::format_to(Out(says),
                           "        float physxRigidBody:linearDamping = {}\n        float physxRigidBody:angularDamping = {}\n",
                           body.linear_damping, body.angular_damping);
            if (body.gravity_scale == 0) says += "        bool physxRigidBody:disableGravity = 1\n";
        }
        if (body.gravity_scale != 0 && body.gravity_scale != 1) note("gravity scales other than 0 and 1 are left out");
    }
    std::string pairs;
    for (const Exclusion& one : scene_.exclusions)
        if (one.a == index) pairs += (pairs.empty() ? "<" : ", <") + path_of(one.b) + ">";
    if (!pairs.empty()) {
        schemas += schemas.empty() ? "\"PhysicsFilteredPairsAPI\"" : ", \"PhysicsFilteredPairsAPI\"";
        says += "        rel physics:filteredPairs = [" + pairs + "]\n";
    }
    vec3 position = body.position;
    vec4 orientation = body.orientation;
    if (const auto* plane = std::get_if<Plane>(&body.shape)) {  // stands in the world
        position = plane->normal * plane->offset;
        const vec3 n = plane->normal;
        const glm::quat up = n.y < -0.9999f ? glm::quat(0, 1, 0, 0) : glm::normalize(glm::quat(1 + n.y, n.z, 0, -n.x));
        orientation = {up.x, up.y, up.z, up.w};
    }
    fmt::format_to(Out(out_), "    def Xform \"{}\"", names_[index]);
    if (!schemas.empty()) fmt::format_to(Out(out_), " (\n        prepend apiSchemas = [{}]\n    )", schemas);
    fmt::format_to(Out(out_),
                   "\n    {{\n{}        quatf xformOp:orient = {}\n        double3 xformOp:translate = {}\n"
                   "        uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]\n",
                   says, turn(orientation), triple(position));
    const vec4 none(0, 0, 0, 1);
    const std::string path = path_of(index);
    if (const auto* compound = std::get_if<Compound>(&body.shape)) {
        for (std::size_t i = 0; i < compound->parts.size(); ++i) {
            const Part& part = compound->parts[i];
            put_shape(path, "part_" + std::to_string(i), whole_shape(part.shape), part.position, part.orientation, body, &part);
        }
    } else {
        put_shape(path, "shape", body.shape, vec3(0), none, body, nullptr);
    }
    out_ += "    }\n";
}

const char* mode_of(CombineRule rule) {
    switch (rule) {
        case CombineRule::overriding_average:
        case CombineRule::average:
            return "average";
        case CombineRule::overriding_minimum:
        case CombineRule::minimum:
            return "min";
        case CombineRule::multiply:
            return "multiply";
        case CombineRule::maximum:
            return "max";
        default:
            return nullptr;
    }
}

void UsdScene::put_materials() {
    out_ += "    def Scope \"Materials\"\n    {\n";
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const Material& m = materials_[i];
        fmt::format_to(
            Out(out_),
            "        def Material \"material_{}\" (\n            prepend apiSchemas = [\"PhysicsMaterialAPI\", "
            "\"PhysxMaterialAPI\"]\n"
            "        )\n        {{\n            float physics:dynamicFriction = {}\n            float physics:restitution = {}\n"
            "            float physics:staticFriction = {}\n",
            i, m.friction, m.restitution, std::max(m.friction, m.static_friction));
        if (const char* mode = mode_of(m.friction_rule))
            fmt::format_to(Out(out_), "            uniform token physxMaterial:frictionCombineMode = \"{}\"\n", mode);
        if (const char* mode = mode_of(m.restitution_rule))
            fmt::format_to(Out(out_), "            uniform token physxMaterial:restitutionCombineMode = \"{}\"\n", mode);
        out_ += "        }\n";
    }
    out_ += "    }\n";
}

bool meet(const std::optional<Filter>& first, const std::optional<Filter>& second) {
    const Filter a = first.value_or(Filter{}), b = second.value_or(Filter{});
    if (a.group != 0 && a.group == b.group) return a.group > 0;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

// Colliders of one filter are a group.
void UsdScene::put_groups() {
    if (filters_.size() < 2 && (filters_.empty() || meet(filters_[0], filters_[0]))) return;
    out_ += "    def Scope \"Groups\"\n    {\n";
    for (std::size_t i = 0; i < filters_.size(); ++i) {
        fmt::format_to(Out(out_),
                       "        def PhysicsCollisionGroup \"group_{}\" (\n            prepend apiSchemas = "
                       "[\"CollectionAPI:colliders\"]\n        )\n        {{\n"
                       "            rel collection:colliders:includes = [",
                       i);
        for (std::size_t k = 0; k < members_[i].size(); ++k)
            fmt::format_to(Out(out_), "{}<{}>", k > 0 ? ", " : "", members_[i][k]);
        out_ += "]\n            rel physics:filteredGroups = [";
        const char* between = "";
        for (std::size_t j = 0; j < filters_.size(); ++j)
            if (!meet(filters_[i], filters_[j]))
                fmt::format_to(Out(out_), "{}</World/Groups/group_{}>", std::exchange(between, ", "), j);
        out_ += "]\n        }\n";
    }
    out_ += "    }\n";
}

void UsdScene::note_rest() {
    if (!scene_.vehicles.empty())
        note("engines, brakes and steering of vehicles are left out; their bodies and joints are there");
    if (scene_.fields.any()) note("wind, water and attractors are left out");
    for (const Body& body : scene_.bodies) {
        if (body.fracture) note("fracture is left out; bodies do not break");
        if (body.tyre) note("slip of tyres is left out");
        if (body.rolling_resistance > 0 || body.spinning_resistance > 0) note("rolling and spinning resistance are left out");
        if (body.cohesion > 0) note("cohesion is left out");
        if (body.surface_velocity != vec3(0)) note("surface velocities are left out");
    }
}

std::string UsdScene::text() {
    name_bodies();
    note_rest();
    const float g = glm::length(scene_.gravity);
    fmt::format_to(Out(out_),
                   "#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = \"Written by scree\"\n    kilogramsPerUnit = 1\n    "
                   "metersPerUnit = 1\n"
                   "    upAxis = \"Y\"\n)\n\ndef Xform \"World\"\n{{\n    def PhysicsScene \"PhysicsScene\"\n    {{\n"
                   "        vector3f physics:gravityDirection = {}\n        float physics:gravityMagnitude = {}\n    }}\n",
                   triple(g > 0 ? scene_.gravity / g : vec3(0, -1, 0)), g);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) put_body(i);
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < names_.size(); ++i) paths.push_back(path_of(i));
    for (std::size_t i = 0; i < scene_.joints.size(); ++i)
        if (!scene_.joints[i].broken) out_ += usd_joint(scene_, i, paths, [this](const std::string& words) { note(words); });
    put_materials();
    put_groups();
    return out_ + "}\n";
}

}  // namespace

std::string scene_to_usda(const Scene& scene, std::vector<std::string>& notes) {
    Scene whole = scene;
    std::erase_if(whole.bodies, [](const Body& body) { return body.piece_of != no_body; });
    std::vector<std::optional<Fracture>> fractures;
    for (Body& body : whole.bodies) fractures.push_back(std::exchange(body.fracture, std::nullopt));
    whole = checked(std::move(whole));
    for (std::size_t i = 0; i < fractures.size(); ++i) whole.bodies[i].fracture = fractures[i];
    return UsdScene(whole, notes).text();
}

}  // namespace scree::demos
