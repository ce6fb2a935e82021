// Editing by the pointer and keys: deleting and duplicating the selected body, joining two bodies.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compute/scene/shape_geometry.h"
#include "demos/play/interaction.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float spring_hertz = 2, spring_damping_ratio = 0.1f;  // of the lighter body on the spring

vec3 place_of(const World& world, const PickedPoint& point) {
    const BodyState body = world.body(point.body);
    return body.position + physics::rotate(body.orientation, point.anchor);
}

float lighter_mass(const Scene& scene, std::size_t a, std::size_t b) {
    float least = std::numeric_limits<float>::max();
    for (const std::size_t one : {a, b})
        if (scene.bodies[one].motion == Motion::dynamic) least = std::min(least, mass_properties(scene.bodies[one]).mass);
    return least;
}

JointKind kind_of(JoinKind kind, float distance, float mass) {
    switch (kind) {
        case JoinKind::ball:
            return Ball{};
        case JoinKind::hinge:
            return Hinge{};
        case JoinKind::slider:
            return Slider{};
        case JoinKind::fixed:
            return Fixed{};
        case JoinKind::rope:
            return Distance{0, distance, {}};
        case JoinKind::rod:
            return Distance{distance, distance, {}};
        case JoinKind::spring:
            break;
    }
    const float omega = 2 * std::numbers::pi_v<float> * spring_hertz;
    Distance spring;
    spring.spring =
        Spring{.stiffness = mass * omega * omega, .damping = 2 * spring_damping_ratio * mass * omega, .rest = distance};
    return spring;
}

}  // namespace

const std::vector<std::string>& join_words() {
    static const std::vector<std::string> words{"ball", "hinge", "slider", "fixed", "rope", "rod", "spring"};
    return words;
}
const std::vector<std::string>& join_axis_words() {
    static const std::vector<std::string> words{"x", "y", "z", "between"};
    return words;
}

void Interaction::remove_selected() {
    if (!selected_) return;
    if (hold_) let_go();
    motion_ = Motion::none;
    perform(Remove{*selected_});
    if (message_.empty()) selected_.reset();
}

void Interaction::duplicate_selected() {
    if (!selected_) return;
    const World& world = session_.world();
    Body body = world.scene().bodies[*selected_];
    if (std::holds_alternative<Plane>(body.shape)) {
        message_ = "a plane is infinite; it cannot be duplicated";
        return;
    }
    const BodyState now = world.body(*selected_);
    const float reach = bounding_radius(body.shape);
    const std::optional<RayHit> highest = world.cast_ray({now.position + vec3(0, 1000, 0), vec3(0, -1, 0)});
    body.position = now.position;
    body.position.y = std::max(highest ? highest->point.y : now.position.y, now.position.y) + 1.05f * reach;
    body.orientation = now.orientation;
    body.velocity = body.angular_velocity = vec3(0);
    body.piece_of = no_body;
    perform(Add{body});
}

void Interaction::begin_joining() {
    joining_ = true;
    first_point_.reset();
    message_.clear();
}

void Interaction::end_joining() {
    joining_ = false;
    first_point_.reset();
}

void Interaction::pick(const RayHit& hit) {
    const BodyState body = session_.world().body(hit.body);
    const PickedPoint point{hit.body, physics::rotate_back(body.orientation, hit.point - body.position)};
    if (!first_point_) {
        first_point_ = point;
        message_.clear();
        return;
    }
    join(*first_point_, point);
    if (message_.empty()) end_joining();
}

void Interaction::join(const PickedPoint& a, const PickedPoint& b) {
    const World& world = session_.world();
    if (a.body == b.body) {
        message_ = "the second point is on the same body; click another one";
        return;
    }
    const vec3 from = place_of(world, a), to = place_of(world, b);
    const float distance = glm::length(to - from);
    const bool along = join_kind == JoinKind::rope || join_kind == JoinKind::rod || join_kind == JoinKind::spring;
    if (distance < 1e-4f && (along || join_axis == JoinAxis::between)) {
        message_ = "the points are at one place; click another one";
        return;
    }
    const std::array<vec3, 4> axes{vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), (to - from) / std::max(distance, 1e-6f)};
    const JointKind kind = kind_of(join_kind, distance, lighter_mass(world.scene(), a.body, b.body));
    try {
        Joint joint = world.joint_at(kind, a.body, b.body, 0.5f * (from + to), axes[static_cast<std::size_t>(join_axis)]);
        if (along) {
            joint.anchor_a = a.anchor;
            joint.anchor_b = b.anchor;
            joint.collide = true;
        }
        perform(Join{joint});
        if (message_.empty()) ++joined_;
    } catch (const std::exception& error) {
        message_ = error.what();
    }
}

}  // namespace scree::demos
