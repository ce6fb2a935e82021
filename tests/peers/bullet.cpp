// Bullet in the race: its solver at default settings (10 sequential impulse iterations, warm starting, one thread),
// with the scene's shapes, masses, inertias, friction, restitution and damping. Friction, restitution and rolling
// resistance of pairs are combined as in scree; Bullet's products would give other piles. Bullet's rolling resistance
// is almost nothing for bodies over some kilograms, since its impulse (N m s) is bounded by the resistance arm (m).
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "compute/scene/meshes/hull.h"
#include "tests/peers/engine.h"

namespace scree::peers {

namespace {

btVector3 vector_of(vec3 v) {
    return {v.x, v.y, v.z};
}

// m, by which Bullet inflates hulls; its default of 4 cm is half a stone of the bins.
constexpr float hull_margin = 0.001f;

std::unique_ptr<btCollisionShape> shape_of(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return std::make_unique<btSphereShape>(sphere->radius);
    if (const auto* capsule = std::get_if<Capsule>(&shape))
        return std::make_unique<btCapsuleShape>(capsule->radius, 2 * capsule->half_height);
    if (const auto* box = std::get_if<Box>(&shape)) return std::make_unique<btBoxShape>(vector_of(box->half_extents));
    if (const auto* plane = std::get_if<Plane>(&shape))
        return std::make_unique<btStaticPlaneShape>(vector_of(plane->normal), plane->offset);
    if (const auto* hull = std::get_if<Hull>(&shape)) {
        auto solid = std::make_unique<btConvexHullShape>();
        for (const glm::dvec3& v : hull->form->vertices) solid->addPoint(vector_of(vec3(v)), false);
        solid->setMargin(hull_margin);
        solid->recalcLocalAabb();
        return solid;
    }
    throw Unsupported("a shape which the race does not translate");
}

// Fraction of velocity lost per second, from a damping rate (1/s).
btScalar damping_of(float rate) {
    return 1 - std::exp(-rate);
}

btScalar friction_of_pair(const btCollisionObject* a, const btCollisionObject* b) {
    return std::sqrt(a->getFriction() * b->getFriction());
}
btScalar restitution_of_pair(const btCollisionObject* a, const btCollisionObject* b) {
    return std::max(a->getRestitution(), b->getRestitution());
}
btScalar rolling_of_pair(const btCollisionObject* a, const btCollisionObject* b) {
    return std::max(a->getRollingFriction(), b->getRollingFriction());
}

class Bullet : public Engine {
public:
    Bullet(const Scene& scene, int substeps, bool sleeps) : substeps_(substeps), sleeps_(sleeps) {
        gCalculateCombinedFrictionCallback = friction_of_pair;
        gCalculateCombinedRestitutionCallback = restitution_of_pair;
        gCalculateCombinedRollingFrictionCallback = rolling_of_pair;
        world_.setGravity(vector_of(scene.gravity));
        for (const Body& body : scene.bodies) add(body, scene.gravity);
    }
    ~Bullet() override {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }

    std::string name() const override {
        const int version = btGetVersion();
        return "Bullet " + std::to_string(version / 100) + "." + std::to_string(version % 100) + ", 1 thread" +
               (substeps_ > 1 ? ", steps of 1/" + std::to_string(60 * substeps_) + " s" : "");
    }
    void step() override { world_.stepSimulation(step_seconds, substeps_, step_seconds / static_cast<float>(substeps_)); }
    std::vector<Pose> poses() const override {
        std::vector<Pose> all;
        for (const auto& body : bodies_) {
            const btVector3& place = body->getWorldTransform().getOrigin();
            const btQuaternion turn = body->getWorldTransform().getRotation();
            all.push_back({vec3(place.x(), place.y(), place.z()), {turn.x(), turn.y(), turn.z(), turn.w()}});
        }
        return all;
    }
    std::size_t points() const override {
        std::size_t sum = 0;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
            sum += static_cast<std::size_t>(dispatcher_.getInternalManifoldPointer()[i]->getNumContacts());
        return sum;
    }

private:
    void add(const Body& body, vec3 gravity) {
        if (body.motion == Motion::kinematic) throw Unsupported("a kinematic body, which the race does not drive");
        shapes_.push_back(shape_of(body.shape));
        const bool moves = body.motion == Motion::dynamic;
        const MassProperties mass = moves ? mass_properties(body.shape, body.density) : MassProperties{};
        btRigidBody::btRigidBodyConstructionInfo info(mass.mass, nullptr, shapes_.back().get(), vector_of(mass.inertia));
        if (!std::holds_alternative<Plane>(body.shape)) {
            const vec4 q = body.orientation;
            info.m_startWorldTransform = btTransform(btQuaternion(q.x, q.y, q.z, q.w), vector_of(body.position));
        }
        info.m_friction = body.friction;
        info.m_restitution = body.restitution;
        info.m_rollingFriction = body.rolling_resistance;
        info.m_linearDamping = damping_of(body.linear_damping);
        info.m_angularDamping = damping_of(body.angular_damping);
        auto& added = *bodies_.emplace_back(std::make_unique<btRigidBody>(info));
        if (!sleeps_) added.setActivationState(DISABLE_DEACTIVATION);
        if (moves) {
            added.setLinearVelocity(vector_of(body.velocity));
            added.setAngularVelocity(vector_of(body.angular_velocity));
        }
        world_.addRigidBody(&added);
        if (moves) added.setGravity(vector_of(gravity * body.gravity_scale));  // after adding, which sets the world's gravity
    }

    int substeps_;
    bool sleeps_;
    btDefaultCollisionConfiguration configuration_;
    mutable btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const Scene& scene, int substeps, bool sleeps) {
    return std::make_unique<Bullet>(scene, substeps, sleeps);
}

}  // namespace scree::peers
