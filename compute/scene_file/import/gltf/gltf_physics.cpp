// glTF physics: nodes with motion become bodies, their colliders and those of nodes below them its shapes.
#include "compute/scene_file/import/gltf/gltf_physics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "compute/scene/double_quaternion.h"
#include "compute/scene_file/import/gltf/gltf_joints.h"
#include "compute/scene_file/import/gltf/gltf_materials.h"
#include "compute/scene_file/import/gltf/gltf_shapes.h"
#include "compute/scene_file/import/srgb.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"

namespace scree::imports {

namespace {

constexpr const char* bodies_key = "KHR_physics_rigid_bodies";
constexpr const char* shapes_key = "KHR_implicit_shapes";
constexpr std::size_t most_visits = 1'000'000;
constexpr std::size_t most_vertices = 100'000'000;
constexpr double default_density = 1000;  // kg/m^3, as of a scene's bodies

// The unit axes of a transform, mirrored or sheared as they may be.
dmat3 axes_of(const glm::dmat4& matrix) {
    dmat3 axes(1);
    const dvec3 scale = scale_of(matrix);
    for (int k = 0; k < 3; ++k)
        if (scale[k] > 0) axes[k] = dvec3(matrix[k]) / scale[k];
    return axes;
}

// Of morph targets, which those of 0 do not move.
void note_weights(GltfValue value) {
    for (const nlohmann::json& weight : value.at("weights").json())
        if (weight != 0) return value.note("weights", "are left out; the mesh collides undeformed");
}

class Gltf {
public:
    Gltf(Folder& folder, const ImportOptions& options, Notes& notes, std::size_t most_bodies)
        : folder_(folder), options_(options), notes_(notes), most_bodies_(most_bodies) {}
    SceneDocument read(const std::string& name);

private:
    void walk(std::size_t node, const glm::dmat4& above, std::size_t body, int depth);
    std::size_t add_body(GltfValue motion, const glm::dmat4& world, const std::string& name);
    void finish_mass(GltfValue motion, std::size_t body);
    void add_collider(GltfValue collider, const GltfNode& node, const std::string& name, bool sensor);
    void add_shape(GltfValue shape, const glm::dmat4& frame, Geometry like, ModelBody& body);
    void add_mesh(GltfValue& geometry, const GltfNode& node, Geometry like);
    void add_surface(const host::MeshFile& mesh, const Geometry& like);
    void collect(GltfValue node, const glm::dmat4& frame, host::MeshFile& into, int depth);
    void append_surface(std::size_t before, const host::MeshFile& one, bool mirrored);
    void collect(std::size_t mesh, const glm::dmat4& frame, host::MeshFile& into);
    const std::vector<host::MeshFile>& meshes();
    std::size_t child_of(const GltfValue& list, std::size_t i) const;

    Folder& folder_;
    const ImportOptions& options_;
    Notes& notes_;
    std::size_t most_bodies_;
    std::string bytes_, path_;
    std::optional<std::vector<host::MeshFile>> meshes_;
    std::vector<GltfNode> nodes_;
    std::vector<Material> materials_;
    std::size_t visits_ = 0;
    std::optional<GltfValue> node_list_, shape_list_, mesh_list_;
    std::vector<std::pair<std::size_t, GltfValue>> joints_;   // by node
    std::vector<std::pair<std::size_t, GltfValue>> motions_;  // by body
    std::vector<glm::dmat4> body_nodes_{glm::dmat4(1)};       // their nodes' transforms
    host::MeshSurface surface_;                               // of what is collected
    std::vector<Body> surfaces_;                              // static triangle meshes
    Model model_;
};

// A node that a list names.
std::size_t Gltf::child_of(const GltfValue& list, std::size_t i) const {
    const nlohmann::json& child = list.at(i).json();
    if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= nodes_.size()) list.refuse("names a node that is not there");
    return child.get<std::size_t>();
}

const std::vector<host::MeshFile>& Gltf::meshes() {
    if (meshes_) return *meshes_;
    try {
        meshes_ = host::meshes_of_gltf(bytes_, path_, std::filesystem::path(path_).parent_path());
    } catch (const host::FileError& error) {
        throw ImportError(error.what());
    }
    return *meshes_;
}

std::size_t Gltf::add_body(GltfValue motion, const glm::dmat4& world, const std::string& name) {
    if (model_.bodies.size() >= std::min<std::size_t>(most_bodies_, most_visits))
        motion.refuse("there are more bodies than fit into memory");
    ModelBody body;
    body.origin = motion.origin();
    body.name = name;
    body.placed = placed_of(world);
    body.kinematic = motion.flag("isKinematic", false);
    body.free = !body.kinematic;
    body.gravity_scale = static_cast<float>(motion.number("gravityFactor", 1));
    const auto linear = motion.numbers("linearVelocity", 3), angular = motion.numbers("angularVelocity", 3);
    // Along the node's axes, which are left-handed where it is mirrored; spins then turn the other way.
    const dmat3 axes = axes_of(world);
    const double hand = glm::determinant(axes) < 0 ? -1 : 1;
    if (!linear.empty()) body.velocity = axes * dvec3(linear[0], linear[1], linear[2]);
    if (!angular.empty())
        body.spin = glm::conjugate(body.placed.turn) * (hand * (axes * dvec3(angular[0], angular[1], angular[2])));
    body_nodes_.push_back(world);
    model_.bodies.push_back(std::move(body));
    motions_.emplace_back(model_.bodies.size() - 1, motion);
    return model_.bodies.size() - 1;
}

// Explicit mass properties over those of the shapes at the density of bodies.
void Gltf::finish_mass(GltfValue motion, std::size_t index) {
    SolidMass& mass = model_.bodies[index].mass;
    const double given = motion.number("mass", -1);
    const auto centre = motion.numbers("centerOfMass", 3), diagonal = motion.numbers("inertiaDiagonal", 3),
               turn = motion.numbers("inertiaOrientation", 4);
    motion.finish();
    if (model_.bodies[index].kinematic) return;
    if (motion.has("mass") && !(given > 0))
        motion.refuse("\"mass\" must be above 0 kg; an infinite one is that of kinematic bodies");
    if (given > 0 && mass.mass > 0) mass = scaled_mass(mass, given / mass.mass);
    if (given > 0) mass.mass = given;
    const glm::dmat4& world = body_nodes_[index];
    const Placed back = inverse(model_.bodies[index].placed);
    if (!centre.empty()) mass.centre = back * dvec3(world * glm::dvec4(centre[0], centre[1], centre[2], 1));
    if (diagonal.empty()) return;
    if (!keeps_right_angles(world)) motion.refuse("\"inertiaDiagonal\" is of a node whose axes are sheared");
    for (const double moment : diagonal)
        if (!(moment > 0)) motion.refuse("\"inertiaDiagonal\" must be above 0 kg m^2; no moment here is infinite");
    const dquat turned = turn.empty() ? dquat(1, 0, 0, 0) : dquat(turn[3], turn[0], turn[1], turn[2]);
    if (!(glm::length(turned) > 1e-12)) motion.refuse("\"inertiaOrientation\" is of length 0");
    const dmat3 frame = glm::mat3_cast(back.turn) * axes_of(world) * glm::mat3_cast(glm::normalize(turned));
    mass.inertia = frame * imports::diagonal({diagonal[0], diagonal[1], diagonal[2]}) * glm::transpose(frame);
}

void Gltf::add_shape(GltfValue shape, const glm::dmat4& frame, Geometry like, ModelBody& body) {
    const GltfShape made = gltf_shape(shape, frame);
    if (like.solid) body.mass = sum_of(body.mass, scaled_mass(made.mass, default_density));
    for (const GltfShape::Part& part : made.parts) {
        like.shape = part.shape, like.placed = part.placed;
        body.geometries.push_back(like);
    }
}

void Gltf::append_surface(std::size_t before, const host::MeshFile& one, bool mirrored) {
    if (one.surface && mirrored) {
        const host::MeshSurface turned = host::turned_over(*one.surface);
        host::append(surface_, before, &turned, one.triangles.size());
    } else {
        host::append(surface_, before, one.surface.get(), one.triangles.size());
    }
}

void Gltf::collect(std::size_t mesh, const glm::dmat4& frame, host::MeshFile& into) {
    host::MeshFile one = meshes()[mesh];
    if (one.triangles.empty()) return;
    if (!into.color) into.color = one.color;
    into.remarks.insert(into.remarks.end(), one.remarks.begin(), one.remarks.end());
    if (one.surface || !surface_.triangles.empty())
        append_surface(into.triangles.size(), one, glm::determinant(dmat3(frame)) < 0);
    if (into.vertices.size() + one.vertices.size() > most_vertices)
        mesh_list_->at(mesh).refuse("with it colliders have more than 100000000 vertices, a mesh of several counted for each");
    map_mesh({dmat3(frame), dvec3(frame[3])}, one.vertices, one.triangles);
    const auto base = static_cast<std::uint32_t>(into.vertices.size());
    into.groups.push_back(into.triangles.size());
    into.vertices.insert(into.vertices.end(), one.vertices.begin(), one.vertices.end());
    for (const glm::uvec3& triangle : one.triangles) into.triangles.push_back(triangle + base);
    note_weights(mesh_list_->at(mesh));
}

// The meshes of a node and of those below it; a node below with a motion of its own is another body.
void Gltf::collect(GltfValue node, const glm::dmat4& frame, host::MeshFile& into, int depth) {
    if (depth > 100) node.refuse("the nodes are nested deeper than 100, or in a circle");
    if (++visits_ > most_visits) node.refuse("with it colliders have more than 1000000 nodes");
    if (node.has("skin")) node.note("skin", "is left out; the mesh collides undeformed");
    note_weights(node);
    const std::size_t mesh = node.index("mesh", meshes().size(), none_given);
    if (mesh != none_given) collect(mesh, frame, into);
    const GltfValue children = node.at("children");
    for (std::size_t i = 0; i < children.size(); ++i) {
        GltfValue child = node_list_->at(child_of(children, i));
        if (child.at("extensions").at(bodies_key).has("motion"))
            child.note("motion", "makes it another body; its mesh is left out of the collider above it");
        else
            collect(child, frame * local_matrix(child), into, depth + 1);
    }
}

void Gltf::add_surface(const host::MeshFile& mesh, const Geometry& like) {
    Mesh shape{mesh.vertices, mesh.triangles};
    shape.surface = mesh.surface;
    Body body{.name = like.name, .motion = Motion::fixed, .shape = std::move(shape)};
    body.position = vec3(like.placed.position);
    body.orientation = single_quaternion(like.placed.turn);
    set_material(body, like.material);
    body.color = like.color;
    surfaces_.push_back(std::move(body));
}

// Static meshes are surfaces; those that move, and those that say so, their hulls.
void Gltf::add_mesh(GltfValue& geometry, const GltfNode& node, Geometry like) {
    const std::size_t mesh = geometry.index("mesh", meshes().size(), none_given),
                      from = geometry.index("node", nodes_.size(), none_given);
    const bool hull = geometry.flag("convexHull", false);
    if (mesh == none_given && from == none_given) geometry.refuse("names no shape and no mesh");
    ModelBody& body = model_.bodies[node.body];
    like.placed = placed_of(matrix_of(inverse(body.placed)) * node.world);
    const glm::dmat4 frame = matrix_of(inverse(body.placed * like.placed)) * node.world;
    host::MeshFile file;
    if (from != none_given)
        collect(node_list_->at(from), frame, file, 0);
    else
        collect(mesh, frame, file);
    if (file.triangles.empty()) geometry.refuse("its mesh has no triangles");
    if (!surface_.triangles.empty()) file.surface = host::shared_surface(std::exchange(surface_, {}));
    if (file.color) like.color = srgb_of(*file.color);
    for (const std::string& remark : file.remarks) geometry.note("", remark);
    if (!hull && node.body == world_body && like.solid) {
        if (like.collides_as != 0) geometry.note("", "a static mesh's filter is left out; it meets everything");
        return add_surface(file, like);
    }
    if (hull) file.groups = {0};
    if (!hull) geometry.note("", "collides as the convex hull of each of its meshes");
    const MeshSolid solid = mesh_solid(file.vertices, file.triangles, file.groups, !hull, file.surface.get());
    if (!solid.flaw.empty()) geometry.refuse("its mesh has no convex hull: " + solid.flaw);
    if (!solid.remark.empty()) geometry.note("", solid.remark);
    for (std::size_t i = 0; i < solid.hulls.size(); ++i) {
        like.shape = Hull{solid.hulls[i]};
        like.parts = solid.parts[i];
        const SolidMass mass = like.parts && solid.hulls.size() == 1 && solid.encloses ? solid.mass : hull_mass(solid.hulls[i]);
        if (like.solid) body.mass = sum_of(body.mass, placed_mass(scaled_mass(mass, default_density), like.placed));
        body.geometries.push_back(like);
    }
}

void Gltf::add_collider(GltfValue collider, const GltfNode& node, const std::string& name, bool sensor) {
    GltfValue geometry = collider.at("geometry");
    const dvec3 scale = scale_of(node.world);
    if (scale == dvec3(0)) return collider.note("scale", "of its node is 0: it is disabled");
    if (!(std::abs(glm::determinant(dmat3(node.world))) > 1e-9 * scale.x * scale.y * scale.z))
        collider.refuse("its node is scaled flat");
    Geometry made;
    made.origin = collider.origin();
    made.name = name;
    made.solid = !sensor, made.sensor = sensor;
    ModelBody& body = model_.bodies[node.body];
    const std::size_t material = collider.index("physicsMaterial", materials_.size(), none_given);
    if (material != none_given) made.material = materials_[material];
    const std::size_t filter = collider.index("collisionFilter", model_.collides.size() - 1, none_given);
    if (filter != none_given) made.collides_as = filter + 1;
    const std::size_t shape = geometry.index("shape", shape_list_->size(), none_given);
    if (shape == none_given) {
        add_mesh(geometry, node, std::move(made));
    } else {
        geometry.flag("convexHull", false);  // these shapes are
        const std::size_t before = body.geometries.size();
        add_shape(shape_list_->at(shape), matrix_of(inverse(body.placed)) * node.of_shapes, std::move(made), body);
        if (node.body != world_body && std::holds_alternative<Plane>(body.geometries[before].shape))
            collider.refuse("a plane is infinite and cannot move");
    }
    geometry.finish();
    collider.finish();
}

void Gltf::walk(std::size_t index, const glm::dmat4& above, std::size_t body, int depth) {
    GltfValue tree = node_list_->at(index);
    if (depth > 100) tree.refuse("the nodes are nested deeper than 100, or in a circle");
    if (++visits_ > most_visits || nodes_[index].reached) tree.refuse("has two parents");
    GltfNode& node = nodes_[index];
    node.reached = true;
    node.world = above * local_matrix(tree);
    node.of_shapes = of_shapes(tree, node.world);
    GltfValue physics = tree.at("extensions").at(bodies_key);
    const std::string name = tree.text("name");
    if (GltfValue motion = physics.at("motion")) body = add_body(motion, node.world, name);
    node.body = body;
    if (const GltfValue collider = physics.at("collider")) add_collider(collider, node, name, false);
    if (const GltfValue trigger = physics.at("trigger")) {
        if (trigger.has("geometry"))
            add_collider(trigger, node, name, true);
        else
            trigger.note("", "of several nodes is left out");
    }
    if (const GltfValue joint = physics.at("joint")) joints_.emplace_back(index, joint);
    physics.finish();
    const GltfValue children = tree.at("children");
    for (std::size_t i = 0; i < children.size(); ++i) walk(child_of(children, i), node.world, body, depth + 1);
}

SceneDocument Gltf::read(const std::string& name) {
    path_ = folder_.path_of({folder_.shown(), 0, ""}, name);
    bytes_ = folder_.bytes({folder_.shown(), 0, ""}, name);
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(host::json_of_gltf(bytes_, path_), nullptr, false);
    } catch (const host::FileError& error) {
        throw ImportError(error.what());
    }
    GltfValue root(json, "", folder_.shown(), notes_);
    if (!json.is_object()) root.refuse("is no glTF file");
    if (root.at("animations").size() > 0) root.note("animations", "are left out; bodies move by physics alone");
    GltfValue extensions = root.at("extensions"), physics = extensions.at(bodies_key);
    materials_ = gltf_materials(physics.at("physicsMaterials"));
    model_.collides = gltf_filters(physics.at("collisionFilters"));
    const GltfValue kinds = physics.at("physicsJoints");
    shape_list_.emplace(extensions.at(shapes_key).at("shapes"));
    node_list_.emplace(root.at("nodes"));
    mesh_list_.emplace(root.at("meshes"));
    nodes_.resize(node_list_->size());
    const GltfValue scenes = root.at("scenes");
    if (scenes.size() == 0) root.refuse("has no scene");
    const GltfValue roots = scenes.at(root.index("scene", scenes.size(), 0)).at("nodes");
    for (std::size_t i = 0; i < roots.size(); ++i) walk(child_of(roots, i), glm::dmat4(1), world_body, 0);
    for (const auto& [body, motion] : motions_) finish_mass(motion, body);
    if (model_.bodies.size() == 1 && model_.bodies[0].geometries.empty() && surfaces_.empty())
        root.refuse(
            "has neither motions nor colliders of KHR_physics_rigid_bodies; as a shape of a body it is "
            "{\"mesh\": {\"file\": ...}} in a scene file");
    model_.z_up = false;
    model_.gravity = {0, -9.81, 0};
    const std::size_t fixed = model_.bodies[world_body].geometries.size();
    SceneDocument document;
    document.scene = assemble(model_, options_, notes_);
    for (Body& surface : surfaces_) document.scene.bodies.push_back(std::move(surface));
    try {
        add_gltf_joints(document.scene, joints_, kinds, nodes_, fixed);
        checked(document.scene);
    } catch (const SceneError& error) {
        root.refuse(error.what());
    }
    return document;
}

}  // namespace

SceneDocument scene_of_gltf(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies) {
    return Gltf(folder, options, notes, most_bodies).read(name);
}

}  // namespace scree::imports
