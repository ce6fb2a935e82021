// glTF physics: nodes with motion become bodies, their colliders and those of nodes below them its shapes.
#include "compute/scene_file/import/gltf_physics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "compute/scene/hull.h"
#include "compute/scene_file/import/gltf_joints.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"

namespace scree::imports {

namespace {

constexpr const char* bodies_key = "KHR_physics_rigid_bodies";
constexpr const char* shapes_key = "KHR_implicit_shapes";
constexpr std::size_t most_visits = 1'000'000;

dvec3 scale_of(const glm::dmat4& matrix) {
    return {glm::length(dvec3(matrix[0])), glm::length(dvec3(matrix[1])), glm::length(dvec3(matrix[2]))};
}

class Gltf {
public:
    Gltf(Folder& folder, const ImportOptions& options, Notes& notes, std::size_t most_bodies)
        : folder_(folder), options_(options), notes_(notes), most_bodies_(most_bodies) {}
    SceneDocument read(const std::string& name);

private:
    void read_materials(GltfValue materials);
    void read_filters(GltfValue filters);
    void walk(std::size_t node, const glm::dmat4& above, std::size_t body, int depth);
    std::size_t add_body(GltfValue motion, const Placed& placed, const std::string& name);
    void finish_mass(GltfValue motion, std::size_t body);
    void add_collider(GltfValue collider, const GltfNode& node, const std::string& name, bool sensor);
    void add_shape(GltfValue shape, const dvec3& scale, Geometry& geometry);
    void add_mesh(GltfValue& geometry, const GltfNode& node, Geometry like);
    const std::vector<host::MeshFile>& meshes();

    Folder& folder_;
    const ImportOptions& options_;
    Notes& notes_;
    std::size_t most_bodies_;
    std::string bytes_, path_;
    std::optional<std::vector<host::MeshFile>> meshes_;
    std::vector<GltfNode> nodes_;
    std::vector<Material> materials_;
    std::size_t filters_ = 0, visits_ = 0;
    std::optional<GltfValue> node_list_, shape_list_;
    std::vector<std::pair<std::size_t, GltfValue>> joints_;   // by node
    std::vector<std::pair<std::size_t, GltfValue>> motions_;  // by body
    std::vector<Body> surfaces_;                              // static triangle meshes
    Model model_;
};

const std::vector<host::MeshFile>& Gltf::meshes() {
    if (meshes_) return *meshes_;
    try {
        meshes_ = host::meshes_of_gltf(bytes_, path_, std::filesystem::path(path_).parent_path());
    } catch (const host::FileError& error) {
        throw ImportError(error.what());
    }
    return *meshes_;
}

void Gltf::read_materials(GltfValue materials) {
    static const std::vector<std::string> rules = {"average", "minimum", "maximum", "multiply"};
    static const CombineRule of[] = {CombineRule::average, CombineRule::minimum, CombineRule::maximum, CombineRule::multiply};
    for (std::size_t i = 0; i < materials.size(); ++i) {
        GltfValue one = materials.at(i);
        Material material;
        material.static_friction = static_cast<float>(one.number("staticFriction", 0.6));
        material.friction = static_cast<float>(one.number("dynamicFriction", 0.6));
        material.restitution = static_cast<float>(one.number("restitution", 0));
        material.friction_rule = of[one.word("frictionCombine", rules, 0)];
        material.restitution_rule = of[one.word("restitutionCombine", rules, 0)];
        for (const CombineRule rule : {material.friction_rule, material.restitution_rule})
            if (rule == CombineRule::maximum || rule == CombineRule::multiply)
                one.note("combine", "of maximum and multiply maximum applies here, and multiply in glTF");
        one.finish();
        materials_.push_back(material);
    }
}

// Each filter is a class of collision; the first class is what has none.
void Gltf::read_filters(GltfValue filters) {
    struct Systems {
        std::set<std::string> in, with, without;
        bool says_with = false;
    };
    std::vector<Systems> all(1);
    filters_ = filters.size();
    if (filters_ > 30) filters.refuse("has more than 30 filters, which is what scree has");
    for (std::size_t i = 0; i < filters_; ++i) {
        GltfValue one = filters.at(i);
        Systems& systems = all.emplace_back();
        const auto names = [&](const char* key, std::set<std::string>& into) {
            const GltfValue list = one.at(key);
            for (std::size_t k = 0; k < list.size(); ++k) {
                if (!list.at(k).json().is_string()) list.refuse("must be an array of strings");
                into.insert(list.at(k).json().get<std::string>());
            }
            return static_cast<bool>(list);
        };
        names("collisionSystems", systems.in);
        systems.says_with = names("collideWithSystems", systems.with);
        names("notCollideWithSystems", systems.without);
        one.finish();
    }
    const auto allows = [](const Systems& a, const Systems& b) {
        const auto shares = [&](const std::set<std::string>& with) {
            return std::any_of(b.in.begin(), b.in.end(), [&](const std::string& name) { return with.contains(name); });
        };
        return a.says_with ? shares(a.with) : !shares(a.without);
    };
    model_.collides.assign(all.size(), std::vector<bool>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j) model_.collides[i][j] = allows(all[i], all[j]) && allows(all[j], all[i]);
}

std::size_t Gltf::add_body(GltfValue motion, const Placed& placed, const std::string& name) {
    if (model_.bodies.size() >= std::min<std::size_t>(most_bodies_, most_visits))
        motion.refuse("there are more bodies than fit into memory");
    ModelBody body;
    body.origin = motion.origin();
    body.name = name;
    body.placed = placed;
    body.kinematic = motion.flag("isKinematic", false);
    body.free = !body.kinematic;
    body.gravity_scale = static_cast<float>(motion.number("gravityFactor", 1));
    const auto linear = motion.numbers("linearVelocity", 3), angular = motion.numbers("angularVelocity", 3);
    if (!linear.empty()) body.velocity = placed.turn * dvec3(linear[0], linear[1], linear[2]);
    if (!angular.empty()) body.spin = {angular[0], angular[1], angular[2]};
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
    if (!centre.empty()) mass.centre = {centre[0], centre[1], centre[2]};
    if (diagonal.empty()) return;
    const dquat axes = turn.empty() ? dquat(1, 0, 0, 0) : dquat(turn[3], turn[0], turn[1], turn[2]);
    if (!(glm::length(axes) > 1e-12)) motion.refuse("\"inertiaOrientation\" is of length 0");
    const dmat3 frame = glm::mat3_cast(glm::normalize(axes));
    dmat3 own(0);
    for (int k = 0; k < 3; ++k) own[k][k] = diagonal[static_cast<std::size_t>(k)];
    mass.inertia = frame * own * glm::transpose(frame);
}

void Gltf::add_shape(GltfValue shape, const dvec3& scale, Geometry& geometry) {
    static const std::vector<std::string> types = {"sphere", "box", "capsule", "cylinder", "plane"};
    const std::size_t type = shape.word("type", types, types.size());
    if (type == types.size()) shape.refuse("has no \"type\"");
    GltfValue sizes = shape.at(types[type].c_str());
    const double across = std::max(scale.x, scale.z);
    const bool even = std::abs(scale.x - scale.z) <= 1e-4 * across;
    if (type == 0) {
        const double radius = sizes.number("radius", 0.5);
        const bool round = even && std::abs(scale.y - across) <= 1e-4 * across;
        if (round)
            geometry.shape = Sphere{static_cast<float>(radius * across)};
        else
            geometry.shape = Ellipsoid{vec3(radius * scale)};
    } else if (type == 1) {
        const auto size = sizes.numbers("size", 3);
        geometry.shape = Box{vec3(0.5 * (size.empty() ? dvec3(1) : dvec3(size[0], size[1], size[2])) * scale)};
    } else if (type == 4) {
        geometry.shape = Plane{vec3(0, 1, 0), 0};
        if (sizes.has("sizeX") || sizes.has("sizeZ")) sizes.note("size", "of a plane is left out: it is infinite");
        sizes.number("sizeX", 0), sizes.number("sizeZ", 0), sizes.flag("doubleSided", false);
    } else {
        const double bottom = sizes.number("radiusBottom", 0.25) * across, top = sizes.number("radiusTop", 0.25) * across,
                     height = sizes.number("height", 0.5) * scale.y;
        if (!even) sizes.refuse("is scaled to another width than depth, which scree's cannot be");
        if (std::abs(bottom - top) > 1e-4 * std::max(bottom, top)) {
            if (type == 2) sizes.refuse("is a tapered capsule; scree's have one radius");
            std::vector<vec3> points;  // of the frustum: 31 corners at either end
            for (int i = 0; i < 31; ++i) {
                const double angle = 6.283185307179586 * i / 31;
                for (const auto& [radius, y] : {std::pair{bottom, -0.5 * height}, std::pair{top, 0.5 * height}})
                    points.push_back(vec3(radius * std::cos(angle), y, radius * std::sin(angle)));
            }
            geometry.shape = Hull{points};
            sizes.note("radius", "that tapers makes a hull of 31 sides");
        } else if (type == 2) {
            geometry.shape = Capsule{static_cast<float>(bottom), static_cast<float>(0.5 * height)};
        } else {
            geometry.shape = Cylinder{static_cast<float>(bottom), static_cast<float>(0.5 * height)};
        }
    }
    sizes.finish();
    shape.finish();
}

// Static meshes are surfaces; those that move, and those that say so, their hulls.
void Gltf::add_mesh(GltfValue& geometry, const GltfNode& node, Geometry like) {
    std::size_t mesh = geometry.index("mesh", meshes().size(), none_given);
    const std::size_t from = geometry.index("node", nodes_.size(), none_given);
    if (from != none_given) mesh = node_list_->at(from).index("mesh", meshes().size(), none_given);
    if (mesh == none_given) geometry.refuse("names no shape and no mesh");
    const bool hull = geometry.flag("convexHull", false);
    const host::MeshFile& file = meshes()[mesh];
    if (file.triangles.empty()) geometry.refuse("its mesh has no triangles");
    const Placed placed = placed_of(node.world);
    const Placed back = inverse(placed);
    std::vector<vec3> points;
    for (const vec3& point : file.vertices) points.push_back(vec3(back * dvec3(node.world * glm::dvec4(dvec3(point), 1))));
    const bool moves = node.body != world_body;
    if (!hull && !moves && like.solid) {
        Body body{.name = like.name, .motion = Motion::fixed, .shape = Mesh{points, file.triangles}};
        body.position = vec3(placed.position);
        body.orientation = vec4(placed.turn.x, placed.turn.y, placed.turn.z, placed.turn.w);
        set_material(body, like.material);
        if (like.collides_as != 0) geometry.note("", "a static mesh's filter is left out; it meets everything");
        surfaces_.push_back(std::move(body));
        return;
    }
    if (!hull) geometry.note("", "collides as its convex hull");
    const MeshSolid solid = mesh_solid(points, file.triangles, {0});
    if (solid.hulls.empty()) geometry.refuse("its mesh has no convex hull: " + solid.flaw);
    like.shape = Hull{solid.hulls[0]};
    ModelBody& body = model_.bodies[node.body];
    if (moves && like.solid)
        body.mass = sum_of(body.mass, placed_mass(scaled_mass(hull_mass(solid.hulls[0]), 1000), like.placed));
    body.geometries.push_back(std::move(like));
}

void Gltf::add_collider(GltfValue collider, const GltfNode& node, const std::string& name, bool sensor) {
    GltfValue geometry = collider.at("geometry");
    Geometry made;
    made.origin = collider.origin();
    made.name = name;
    made.solid = !sensor, made.sensor = sensor;
    ModelBody& body = model_.bodies[node.body];
    const Placed placed = placed_of(node.world);
    made.placed = node.body == world_body ? placed : inverse(body.placed) * placed;
    const std::size_t material = collider.index("physicsMaterial", materials_.size(), none_given);
    if (material != none_given) made.material = materials_[material];
    const std::size_t filter = collider.index("collisionFilter", filters_, none_given);
    if (filter != none_given) made.collides_as = filter + 1;
    const std::size_t shape = geometry.index("shape", shape_list_->size(), none_given);
    if (shape == none_given) {
        add_mesh(geometry, node, std::move(made));
    } else {
        add_shape(shape_list_->at(shape), scale_of(node.world), made);
        if (std::holds_alternative<Plane>(made.shape) && node.body != world_body)
            collider.refuse("a plane is infinite and cannot move");
        SolidMass mass = primitive_mass(made.shape);
        if (const auto* hull = std::get_if<Hull>(&made.shape)) mass = hull_mass(hull->points);
        if (!sensor) body.mass = sum_of(body.mass, placed_mass(scaled_mass(mass, 1000), made.placed));
        body.geometries.push_back(std::move(made));
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
    GltfValue physics = tree.at("extensions").at(bodies_key);
    const std::string name = tree.text("name");
    if (GltfValue motion = physics.at("motion")) body = add_body(motion, placed_of(node.world), name);
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
    for (std::size_t i = 0; i < children.size(); ++i) {
        const nlohmann::json& child = children.at(i).json();
        if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= nodes_.size())
            children.refuse("names a node that is not there");
        walk(child.get<std::size_t>(), node.world, body, depth + 1);
    }
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
    GltfValue extensions = root.at("extensions"), physics = extensions.at(bodies_key);
    read_materials(physics.at("physicsMaterials"));
    read_filters(physics.at("collisionFilters"));
    const GltfValue kinds = physics.at("physicsJoints");
    shape_list_.emplace(extensions.at(shapes_key).at("shapes"));
    node_list_.emplace(root.at("nodes"));
    nodes_.resize(node_list_->size());
    const GltfValue scenes = root.at("scenes");
    if (scenes.size() == 0) root.refuse("has no scene");
    const GltfValue roots = scenes.at(root.index("scene", scenes.size(), 0)).at("nodes");
    for (std::size_t i = 0; i < roots.size(); ++i) {
        if (!roots.at(i).json().is_number_unsigned() || roots.at(i).json().get<std::uint64_t>() >= nodes_.size())
            roots.refuse("names a node that is not there");
        walk(roots.at(i).json().get<std::size_t>(), glm::dmat4(1), world_body, 0);
    }
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
