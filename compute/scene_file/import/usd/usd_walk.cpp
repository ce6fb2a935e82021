// One walk over the prims of a USD scene: bodies, colliders, joints, groups, and notes of the rest.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

constexpr double degree = std::numbers::pi / 180;

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* one) { return word == one; });
}

bool is_drawn_type(const std::string& type) {
    return is_one_of(type, {"Cube", "Sphere", "Capsule", "Capsule_1", "Cylinder", "Cylinder_1", "Cone", "Mesh", "Plane", "Points",
                            "BasisCurves", "NurbsPatch", "NurbsCurves", "TetMesh"});
}
bool is_joint_type(const std::string& type) {
    return is_one_of(type, {"PhysicsJoint", "PhysicsFixedJoint", "PhysicsRevoluteJoint", "PhysicsPrismaticJoint",
                            "PhysicsSphericalJoint", "PhysicsDistanceJoint"});
}
// What means nothing to physics.
bool is_silent_type(const std::string& type) {
    return is_one_of(type, {"", "Xform", "Scope", "Material", "Shader", "NodeGraph", "GeomSubset", "SkelRoot", "Camera"}) ||
           is_drawn_type(type) || is_joint_type(type);
}
bool is_known_schema(const std::string& schema) {
    return is_one_of(schema, {"PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "PhysicsMassAPI",
                              "PhysicsMaterialAPI", "PhysicsFilteredPairsAPI", "PhysicsArticulationRootAPI", "PhysxRigidBodyAPI",
                              "PhysxJointAPI", "PhysxMaterialAPI"}) ||
           schema.starts_with("PhysicsLimitAPI:") || schema.starts_with("PhysicsDriveAPI:");
}

// Of schemas that USD itself does not have.
bool is_known_attribute(const std::string& name) {
    return is_one_of(name, {"physxRigidBody:linearDamping", "physxRigidBody:angularDamping", "physxRigidBody:disableGravity",
                            "physxJoint:armature", "physxMaterial:frictionCombineMode", "physxMaterial:restitutionCombineMode"});
}

struct Above {  // what a prim takes from those above it
    glm::dmat4 world;
    std::size_t body = world_body;
    std::string material, of_physics;  // bound for all purposes, and for physics, which counts if there is one
    double density = 0;                // kg/m^3
    int depth = 0;
    // Of a point instancer, while its prototype's root is at hand.
    const UsdPrim* instancer = nullptr;
    std::size_t instance = 0;
    glm::dmat4 of_instancer{1};
};

class Walk {
public:
    Walk(const UsdStage& stage, const UsdUnits& units, Notes& notes, std::size_t most)
        : stage_(stage), units_(units), notes_(notes), most_(most), root_(1) {
        for (int k = 0; k < 3; ++k) root_[k][k] = units.meters;
    }
    void all() {
        for (const auto& child : stage_.root().children) walk(*child, {.world = root_}, child->path);
    }
    UsdFound found;
    Model* model = nullptr;

private:
    void walk(const UsdPrim& prim, const Above& above, const std::string& path);
    void instances(const UsdPrim& prim, const Above& above, const std::string& path);
    void add_body(UsdRigid rigid);
    void collect(const UsdPrim& prim, const Above& here, const std::string& path);
    void note_rest(const UsdPrim& prim, const Above& here);

    const UsdStage& stage_;
    const UsdUnits& units_;
    Notes& notes_;
    std::size_t most_, visited_ = 0;
    glm::dmat4 root_;
};

void Walk::add_body(UsdRigid rigid) {
    const UsdPrim& prim = *rigid.prim;
    if (found.bodies.size() >= most_) refuse(stage_.at(prim), "there are more bodies than fit into memory");
    found.bodies.push_back(rigid);
    if (!model) return;
    ModelBody body;
    body.origin = stage_.at(prim);
    body.name = rigid.path;
    body.placed = placed_of(rigid.world);
    body.kinematic = stage_.flag(prim, "physics:kinematicEnabled", false);
    body.free = !body.kinematic;
    if (stage_.flag(prim, "physxRigidBody:disableGravity", false)) body.gravity_scale = 0;
    // In the space of the prim's own transform, which is its parent's.
    if (const auto velocity = stage_.vector(prim, "physics:velocity")) body.velocity = dmat3(rigid.above) * *velocity;
    if (const auto spin = stage_.vector(prim, "physics:angularVelocity"))
        body.spin = glm::conjugate(body.placed.turn) * (placed_of(rigid.above).turn * (degree * *spin));
    model->bodies.push_back(std::move(body));
    found.body_at[rigid.path] = model->bodies.size() - 1;
}

void Walk::note_rest(const UsdPrim& prim, const Above& here) {
    if (!is_silent_type(prim.type) && !is_one_of(prim.type, {"PhysicsScene", "PhysicsCollisionGroup", "PointInstancer"}))
        notes_.add(stage_.at(prim), prim.type.substr(0, 60), "is left out");
    for (const std::string& schema : prim.schemas)
        if (!is_known_schema(schema) && (schema.starts_with("Physics") || schema.starts_with("Physx")))
            notes_.add(stage_.at(prim), schema.substr(0, 60), "is left out");
    if (is_drawn_type(prim.type) && !prim.applies("PhysicsCollisionAPI"))
        notes_.add(stage_.at(prim), "geometry", "without PhysicsCollisionAPI is left out, but for its colour");
    bool moves = false;
    for (const std::string& name : stage_.properties(prim)) {
        if (name.starts_with("physxRigidBody:") || name.starts_with("physxJoint:") || name.starts_with("physxMaterial:"))
            if (!is_known_attribute(name)) notes_.add(stage_.at(prim), name.substr(0, 60), "is left out");
        if (here.body == world_body && !prim.applies("PhysicsCollisionAPI")) continue;
        moves = moves || (name.starts_with("xformOp:") && stage_.moves(prim, name));
    }
    if (moves) notes_.add(stage_.at(prim), "timeSamples", "of transforms are left out but for the start; physics moves bodies");
}

void Walk::collect(const UsdPrim& prim, const Above& here, const std::string& path) {
    if (!model) return;
    if (prim.applies("PhysicsCollisionAPI") && stage_.flag(prim, "physics:collisionEnabled", true))
        found.colliders.push_back(
            {&prim, path, here.world, here.body, here.of_physics.empty() ? here.material : here.of_physics, here.density});
    else if (here.body != world_body && is_drawn_type(prim.type))
        found.colliders.push_back({&prim, path, here.world, here.body, "", -1});  // for its colour alone
    if (is_joint_type(prim.type) && stage_.flag(prim, "physics:jointEnabled", true)) found.joints.push_back(&prim);
    if (prim.type == "PhysicsScene") found.scenes.push_back(&prim);
    if (prim.type == "PhysicsCollisionGroup") found.groups.push_back(&prim);
    if (prim.applies("PhysicsFilteredPairsAPI")) found.pairs.push_back(&prim);
    note_rest(prim, here);
}

// Each instance is what a prototype is, moved there. https://openusd.org/release/api/class_usd_geom_point_instancer.html
void Walk::instances(const UsdPrim& prim, const Above& above, const std::string& path) {
    const auto prototypes = stage_.targets(prim, "prototypes");
    const UsdValue which = stage_.value(prim, "protoIndices"), places = stage_.value(prim, "positions"),
                   scales = stage_.value(prim, "scales"), ids = stage_.value(prim, "ids"),
                   hidden = stage_.value(prim, "invisibleIds");
    UsdValue turns = stage_.value(prim, "orientationsf");
    if (turns.numbers.empty()) turns = stage_.value(prim, "orientations");
    const std::size_t count = which.numbers.size();
    if (places.numbers.size() != 3 * count) refuse(stage_.at(prim), "has not as many positions as protoIndices");
    const std::set<double> absent(hidden.numbers.begin(), hidden.numbers.end());
    for (std::size_t i = 0; i < count; ++i) {
        if (absent.contains(ids.numbers.size() == count ? ids.numbers[i] : static_cast<double>(i))) continue;
        if (!(which.numbers[i] >= 0) || which.numbers[i] >= static_cast<double>(prototypes.size()))
            refuse(stage_.at(prim), "protoIndices: names a prototype that is not there");
        const UsdPrim* prototype = stage_.find(prototypes[static_cast<std::size_t>(which.numbers[i])]);
        if (!prototype) refuse(stage_.at(prim), "a prototype is not there");
        glm::dmat4 matrix(1);
        if (turns.numbers.size() == 4 * count) {
            const double* q = turns.numbers.data() + 4 * i;
            const dquat turn(q[0], q[1], q[2], q[3]);
            if (!(glm::length(turn) > 1e-9 && glm::length(turn) < 1e9))
                refuse(stage_.at(prim), "orientations: must be quaternions");
            matrix = glm::mat4_cast(glm::normalize(turn));
        }
        matrix[3] = glm::dvec4(places.numbers[3 * i], places.numbers[3 * i + 1], places.numbers[3 * i + 2], 1);
        for (int k = 0; k < 3 && scales.numbers.size() == 3 * count; ++k)
            matrix[k] *= scales.numbers[3 * i + static_cast<std::size_t>(k)];
        Above instance = above;
        instance.world = above.world * matrix;
        instance.instancer = &prim, instance.instance = i, instance.of_instancer = above.world;
        ++instance.depth;
        walk(*prototype, instance, path + "[" + std::to_string(i) + "]");
    }
}

void Walk::walk(const UsdPrim& prim, const Above& above, const std::string& path) {
    const bool prototype = path.ends_with(']');
    if ((!prim.defined || prim.abstract) && !prototype) return;
    if (above.depth > 250) refuse(stage_.at(prim), "lies deeper than 250, or instances are a circle");
    constexpr std::size_t most_visited = 5'000'000;
    if (++visited_ > most_visited)
        refuse(stage_.at(prim), "with it the scene has more than 5000000 prims, those of instances counted for each");
    Above here = above;
    ++here.depth;
    here.instancer = nullptr;
    bool resets = false;
    const glm::dmat4 local = stage_.local(prim, resets);
    const glm::dmat4 parent = resets ? root_ : above.world;
    here.world = parent * local;
    for (int k = 0; k < 16; ++k)
        if (!(std::abs(here.world[k / 4][k % 4]) < 1e15)) refuse(stage_.at(prim), "its transform leaves the range of numbers");
    for (const auto& [binding, bound] :
         {std::pair{"material:binding", &here.material}, std::pair{"material:binding:physics", &here.of_physics}}) {
        const auto targets = stage_.targets(prim, binding);
        if (!targets.empty()) *bound = targets[0];
    }
    const double per_volume = units_.kilograms / (units_.meters * units_.meters * units_.meters);
    if (prim.applies("PhysicsMassAPI"))
        if (const double density = stage_.number(prim, "physics:density", 0); density > 0) here.density = density * per_volume;
    if (prim.applies("PhysicsRigidBodyAPI") && stage_.flag(prim, "physics:rigidBodyEnabled", true)) {
        UsdRigid rigid{&prim, path, here.world, parent};
        rigid.resets = resets;
        if (above.body != world_body) rigid.carrier = above.body - 1;
        rigid.instancer = above.instancer, rigid.instance = above.instance;
        rigid.of_instancer = above.of_instancer, rigid.within = local;
        add_body(std::move(rigid));
        here.body = found.bodies.size();
    }
    collect(prim, here, path);
    if (prim.type == "PointInstancer") {
        instances(prim, here, path);
        return;
    }
    for (const auto& child : prim.children) walk(*child, here, path + "/" + child->name);
}

}  // namespace

UsdFound found_in(const UsdStage& stage, const UsdUnits& units, Model* model, Notes& notes, std::size_t most_bodies) {
    Walk walk(stage, units, notes, most_bodies);
    walk.model = model;
    walk.all();
    return std::move(walk.found);
}

}  // namespace scree::imports
