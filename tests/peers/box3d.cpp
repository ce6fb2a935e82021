// Box3D in the race, one thread, its world's defaults but for sleep. Its friction of a pair is sqrt(a b) and its restitution
// the larger, as in scree. Its rolling resistance is a part of the radius of what is round, and boxes have none to speak of;
// a pair takes the larger part of the larger radius, which is scree's larger arm wherever bodies are alike. It has no planes:
// a fixed box takes a plane's place, its top in the plane, and reaches beyond all bodies.
#include <box3d/box3d.h>

#include <algorithm>
#include <cmath>

#include "compute/scene/meshes/hull.h"
#include "tests/peers/engine.h"

namespace scree::peers {

namespace {

b3Vec3 vector_of(vec3 v) {
    return {v.x, v.y, v.z};
}

b3Quat quaternion_of(vec4 q) {
    return {{q.x, q.y, q.z}, q.w};
}

// The shortest turn of the axis y to `normal`.
vec4 turn_to(vec3 normal) {
    if (normal.y < -0.9999f) return {1, 0, 0, 0};
    return glm::normalize(vec4(glm::cross(vec3(0, 1, 0), normal), 1 + normal.y));
}

class Box3d : public Engine {
public:
    Box3d(const Scene& scene, int substeps, float contact_hertz, bool sleeps)
        : substeps_(substeps), contact_hertz_(contact_hertz), sleeps_(sleeps) {
        b3WorldDef world = b3DefaultWorldDef();
        world.gravity = vector_of(scene.gravity);
        world.enableSleep = sleeps_;
        if (contact_hertz > 0) world.contactHertz = contact_hertz;
        world.workerCount = 1;
        world_ = b3CreateWorld(&world);
        try {
            for (const Body& body : scene.bodies) reach_ = std::max(reach_, 2 * glm::length(body.position));
            for (const Body& body : scene.bodies) add(body);
        } catch (...) {
            b3DestroyWorld(world_);
            throw;
        }
    }
    Box3d(const Box3d&) = delete;
    Box3d& operator=(const Box3d&) = delete;
    ~Box3d() override { b3DestroyWorld(world_); }

    std::string name() const override {
        const b3Version version = b3GetVersion();
        return "Box3D " + std::to_string(version.major) + "." + std::to_string(version.minor) + ", 1 thread, " +
               std::to_string(substeps_) + " substeps" +
               (contact_hertz_ > 0 ? ", contacts of " + std::to_string(std::lround(contact_hertz_)) + " Hz" : "");
    }
    void step() override { b3World_Step(world_, step_seconds, substeps_); }
    std::vector<Pose> poses() const override {
        std::vector<Pose> all;
        for (const b3BodyId body : bodies_) {
            const b3Pos place = b3Body_GetPosition(body);
            const b3Quat turn = b3Body_GetRotation(body);
            all.push_back({vec3(place.x, place.y, place.z), {turn.v.x, turn.v.y, turn.v.z, turn.s}});
        }
        return all;
    }
    std::size_t points() const override {
        std::size_t twice = 0;  // a contact is told by both its bodies
        std::vector<b3ContactData> contacts;
        for (const b3BodyId body : bodies_) {
            contacts.resize(static_cast<std::size_t>(b3Body_GetContactCapacity(body)));
            const int count = b3Body_GetContactData(body, contacts.data(), static_cast<int>(contacts.size()));
            for (int i = 0; i < count; ++i) {
                const b3ContactData& contact = contacts[static_cast<std::size_t>(i)];
                for (int k = 0; k < contact.manifoldCount; ++k)
                    twice += static_cast<std::size_t>(contact.manifolds[k].pointCount);
            }
        }
        return twice / 2;
    }

private:
    void add(const Body& body) {
        if (body.motion == Motion::kinematic) throw Unsupported("a kinematic body, which the race does not drive");
        if (body.inertial) throw Unsupported("a mass of a body's own, which the race does not translate");
        b3BodyDef def = b3DefaultBodyDef();
        if (body.motion == Motion::dynamic) {
            def.type = b3_dynamicBody;
            def.linearVelocity = vector_of(body.velocity);
            def.angularVelocity = vector_of(body.angular_velocity);
        }
        const auto* plane = std::get_if<Plane>(&body.shape);
        def.position = vector_of(plane ? plane->normal * (plane->offset - plane_depth) : body.position);
        def.rotation = quaternion_of(plane ? turn_to(plane->normal) : body.orientation);
        def.linearDamping = body.linear_damping;
        def.angularDamping = body.angular_damping;
        def.gravityScale = body.gravity_scale;
        def.enableSleep = sleeps_;
        bodies_.push_back(b3CreateBody(world_, &def));
        add_shape(bodies_.back(), body);
    }

    void add_shape(b3BodyId id, const Body& body) const {
        b3ShapeDef def = b3DefaultShapeDef();
        def.density = body.density;
        def.baseMaterial.friction = body.friction;
        def.baseMaterial.restitution = body.restitution;
        if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
            def.baseMaterial.rollingResistance = body.rolling_resistance / sphere->radius;
            const b3Sphere round = {{0, 0, 0}, sphere->radius};
            b3CreateSphereShape(id, &def, &round);
        } else if (const auto* capsule = std::get_if<Capsule>(&body.shape)) {
            def.baseMaterial.rollingResistance = body.rolling_resistance / capsule->radius;
            const b3Capsule round = {{0, -capsule->half_height, 0}, {0, capsule->half_height, 0}, capsule->radius};
            b3CreateCapsuleShape(id, &def, &round);
        } else if (const auto* box = std::get_if<Box>(&body.shape)) {
            const b3BoxHull hull = b3MakeBoxHull(box->half_extents.x, box->half_extents.y, box->half_extents.z);
            b3CreateHullShape(id, &def, &hull.base);
        } else if (std::holds_alternative<Plane>(body.shape)) {
            const b3BoxHull hull = b3MakeBoxHull(reach_, plane_depth, reach_);
            b3CreateHullShape(id, &def, &hull.base);
        } else if (const auto* solid = std::get_if<Hull>(&body.shape)) {
            std::vector<b3Vec3> points;
            for (const glm::dvec3& v : solid->form->vertices) points.push_back(vector_of(vec3(v)));
            b3HullData* hull = b3CreateHull(points.data(), static_cast<int>(points.size()), static_cast<int>(points.size()));
            if (!hull) throw Unsupported("a hull that Box3D refuses");
            b3CreateHullShape(id, &def, hull);
            b3DestroyHull(hull);
        } else {
            throw Unsupported("a shape which the race does not translate");
        }
    }

    // m, half the thickness of the box in a plane's place. A quarter of it counts as a radius where round bodies roll.
    static constexpr float plane_depth = 0.25f;

    b3WorldId world_{};
    int substeps_;
    float contact_hertz_;  // 0: the default
    bool sleeps_;
    float reach_ = 50;  // m, half its width
    std::vector<b3BodyId> bodies_;
};

}  // namespace

std::unique_ptr<Engine> make_box3d(const Scene& scene, int substeps, float contact_hertz, bool sleeps) {
    return std::make_unique<Box3d>(scene, substeps, contact_hertz, sleeps);
}

}  // namespace scree::peers
