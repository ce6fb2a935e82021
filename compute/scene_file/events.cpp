// Performing the timed events of a scene.
#include "compute/scene_file/events.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "compute/scene/portable_math.h"
#include "compute/scene_file/pour.h"
#include "compute/schema/range_text.h"

namespace scree {

namespace {

[[noreturn]] void refuse(std::size_t event, const std::string& inside, const std::string& reason) {
    throw SceneError("/events/" + std::to_string(event) + inside, reason);
}

// The step whose start is nearest to a moment.
std::int64_t step_at(double seconds, const World& world) {
    return std::llround(seconds * static_cast<double>(world.settings().rate));
}
bool is_due(double seconds, const World& world) {
    return step_at(seconds, world) == static_cast<std::int64_t>(world.steps());
}

// The velocity at the end of the world's next step. A kinematic body takes it up evenly, so that its way is the sum of the
// trapezoids under the sine; with this factor that sum is way / 2 (1 - cos).
void shake_due(const ShakeEvent& shake, double begin, World& world) {
    const std::int64_t first = step_at(begin, world), now = static_cast<std::int64_t>(world.steps());
    const std::int64_t last = step_at(begin + static_cast<double>(shake.duration), world) - 1;
    if (now < first || (shake.duration > 0 && now > last)) return;
    const double rate = double{world.settings().rate}, half_turn = std::numbers::pi * double{shake.frequency} / rate;
    if (8 * double{shake.frequency} > rate)
        throw std::invalid_argument("shaking with " + plain(double{shake.frequency}) + " Hz needs a rate of at least " +
                                    plain(8 * double{shake.frequency}) + " steps per second");
    const double turns = double{shake.frequency} * static_cast<double>(now + 1 - first) / rate + double{shake.phase};
    const double speed = rate * portable::tan(half_turn) * portable::sin(2 * std::numbers::pi * (turns - std::floor(turns)));
    const bool stops = shake.duration > 0 && now == last;
    world.set_velocity(shake.body, stops ? vec3(0) : static_cast<float>(speed) * shake.way, vec3(0));
}

// The present index of a joint of the scene: removed joints lower those above them.
std::size_t present_joint(const std::vector<TimedEvent>& events, std::size_t event, std::size_t joint) {
    std::size_t lower = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const auto* release = std::get_if<ReleaseEvent>(&events[i].action);
        const bool before = events[i].time < events[event].time || (events[i].time == events[event].time && i < event);
        if (release && before && release->joint < joint) ++lower;
    }
    return joint - lower;
}

// The way of a kinematic body while it stops, as a part of its velocity, s (shaders/physics/body/driven.h). It takes up a
// velocity with as much less way.
float stopping_time(const World& world) {
    return (0.5f - 0.5f / static_cast<float>(world.settings().substeps)) / world.settings().rate;
}

struct Performance {
    const std::vector<TimedEvent>& events;
    std::size_t index;
    World& world;

    void operator()(const ImpulseEvent& event) const { world.apply_impulse(event.body, event.impulse, event.offset); }
    void operator()(const VelocityEvent& event) const { world.set_velocity(event.body, event.linear, event.angular); }
    void operator()(const GlideEvent& event) const {
        const BodyState start = world.body(event.body);
        const vec3 way = event.to - start.position - start.velocity * stopping_time(world);
        const vec3 turn = event.turn - start.angular_velocity * stopping_time(world);
        world.set_velocity(event.body, way / event.duration, turn / event.duration);
    }
    void operator()(const ExplosionEvent& event) const { world.explode(event.centre, event.radius, event.speed); }
    void operator()(const ReleaseEvent& event) const { world.remove_joint(present_joint(events, index, event.joint)); }
    void operator()(const MotorEvent& event) const {
        const std::size_t joint = present_joint(events, index, event.joint);
        world.set_motor(joint, main_axis(world.scene().joints.at(joint).kind), {event.speed, event.max_force});
    }
    void operator()(const GravityEvent& event) const { world.set_gravity(event.gravity); }
    void operator()(const PourEvent&) const {}  // in every step from then on
    void operator()(const ShakeEvent&) const {}
};

// What an action needs of the scene.
struct Check {
    const std::vector<TimedEvent>& events;
    std::size_t index;
    const Scene& scene;

    void operator()(const ImpulseEvent& event) const { require_motion(event.body, "impulse", true, false); }
    void operator()(const VelocityEvent& event) const { require_motion(event.body, "velocity", true, true); }
    void operator()(const GlideEvent& event) const { require_motion(event.body, "glide", false, true); }
    void operator()(const ShakeEvent& event) const { require_motion(event.body, "shake", false, true); }
    void operator()(const ExplosionEvent&) const {}
    void operator()(const ReleaseEvent& event) const {
        require_joint(event.joint, "release");
        for (std::size_t i = 0; i < index; ++i) {
            const auto* other = std::get_if<ReleaseEvent>(&events[i].action);
            if (other && other->joint == event.joint)
                refuse(index, "/action/release/joint", "is released by /events/" + std::to_string(i) + ", too");
        }
        for (const Vehicle& vehicle : scene.vehicles)
            for (const Wheel& wheel : vehicle.wheels)
                if (wheel.joint == event.joint)
                    refuse(index, "/action/release/joint", "is that of a vehicle's wheel, which stays");
    }
    void operator()(const MotorEvent& event) const {
        require_joint(event.joint, "motor");
        const JointKind& kind = scene.joints[event.joint].kind;
        if (!std::holds_alternative<Hinge>(kind) && !std::holds_alternative<Slider>(kind))
            refuse(index, "/action/motor/joint", "must be a hinge or a slider");
        for (std::size_t i = 0; i < events.size(); ++i) {
            const auto* release = std::get_if<ReleaseEvent>(&events[i].action);
            if (release && release->joint == event.joint && events[i].time <= events[index].time)
                refuse(index, "/action/motor/joint", "is released by /events/" + std::to_string(i) + " before");
        }
    }
    void operator()(const GravityEvent&) const {}
    void operator()(const PourEvent& event) const {
        const std::string inside = "/action/pour";
        if (!event.grains.poured()) refuse(index, inside, "needs a \"mass_rate\" or \"count_rate\", above 0");
        supply_of(event.grains, "/events/" + std::to_string(index) + inside);
        if (const std::size_t count = poured(event.grains, scene); count > event.grains.from)
            refuse(index, inside + "/name",
                   "a body of the scene is named \"" + name_of_poured(event.grains) + " " + std::to_string(count - 1) +
                       "\", as a poured grain; give the grains another name, which tells how many have come");
        for (std::size_t i = 0; i < index; ++i) {
            const auto* other = std::get_if<PourEvent>(&events[i].action);
            if (other && name_of_poured(other->grains) == name_of_poured(event.grains))
                refuse(index, inside + "/name",
                       "grains of /events/" + std::to_string(i) + " are named \"" + name_of_poured(event.grains) +
                           "\", too; give them names, which tell how many have come");
        }
    }

    void require_motion(std::size_t body, const char* action, bool dynamic, bool kinematic) const {
        const std::string inside = std::string("/action/") + action + "/body";
        if (body >= scene.bodies.size())
            refuse(index, inside,
                   "there is no body " + std::to_string(body) + "; the scene has " + std::to_string(scene.bodies.size()));
        const Motion motion = scene.bodies[body].motion;
        if ((motion == Motion::dynamic && dynamic) || (motion == Motion::kinematic && kinematic)) return;
        refuse(index, inside,
               dynamic && kinematic ? "must be a dynamic or kinematic body"
               : dynamic            ? "must be a dynamic body"
                                    : "must be a kinematic body");
    }
    void require_joint(std::size_t joint, const char* action) const {
        if (joint < scene.joints.size()) return;
        refuse(index, std::string("/action/") + action + "/joint",
               "there is no joint " + std::to_string(joint) + "; the scene has " + std::to_string(scene.joints.size()));
    }
};

}  // namespace

void check_events(const std::vector<TimedEvent>& events, const Scene& scene) {
    for (std::size_t i = 0; i < events.size(); ++i) std::visit(Check{events, i, scene}, events[i].action);
}

void perform_due(const std::vector<TimedEvent>& events, World& world) {
    for (std::size_t i = 0; i < events.size(); ++i) {
        const auto* glide = std::get_if<GlideEvent>(&events[i].action);
        const auto* pour = std::get_if<PourEvent>(&events[i].action);
        const auto* shake = std::get_if<ShakeEvent>(&events[i].action);
        const bool arrives = glide && is_due(static_cast<double>(events[i].time) + static_cast<double>(glide->duration), world);
        if (!arrives && !pour && !shake && !is_due(events[i].time, world)) continue;
        try {
            if (pour)
                pour_due(pour->grains, events[i].time, world);
            else if (shake)
                shake_due(*shake, events[i].time, world);
            else if (arrives)
                world.set_velocity(glide->body, vec3(0), vec3(0));
            else
                std::visit(Performance{events, i, world}, events[i].action);
        } catch (const std::logic_error& error) {  // std::invalid_argument, std::out_of_range
            refuse(i, "", error.what());
        }
    }
}

std::vector<TimedEvent> coming_events(const std::vector<TimedEvent>& events, const World& world) {
    std::vector<TimedEvent> coming;
    for (const Body& body : world.scene().bodies)
        if (body.piece_of != no_body) return coming;
    const auto now = static_cast<float>(world.time());
    const auto released_below = [&](std::size_t joint) {
        std::size_t count = 0;
        for (const TimedEvent& other : events) {
            const auto* release = std::get_if<ReleaseEvent>(&other.action);
            if (release && other.time < now && release->joint < joint) ++count;
        }
        return count;
    };
    for (const TimedEvent& event : events) {
        TimedEvent next = event;
        next.time -= now;
        auto* glide = std::get_if<GlideEvent>(&next.action);
        const bool under_way = glide && next.time < 0 && next.time + glide->duration > 0;
        if (auto* shake = std::get_if<ShakeEvent>(&next.action); shake && next.time < 0) {
            if (shake->duration > 0 && !(next.time + shake->duration > 0)) continue;
            const float turns = shake->phase - next.time * shake->frequency;
            shake->phase = turns - std::floor(turns);
            if (shake->duration > 0) shake->duration += next.time;
            next.time = 0;
            coming.push_back(next);
            continue;
        }
        if (auto* pour = std::get_if<PourEvent>(&next.action); pour && next.time < 0) {
            pour->grains.from = poured(pour->grains, world.scene());
            next.time = 0;
            if (pour->grains.from < supply_of(pour->grains, "/events")->count()) coming.push_back(next);
            continue;
        }
        if (next.time < 0 && !under_way) continue;
        if (under_way) {
            glide->turn *= (next.time + glide->duration) / glide->duration;
            glide->turn += world.body(glide->body).angular_velocity * stopping_time(world);
            glide->duration += std::exchange(next.time, 0.0f);
        }
        if (auto* release = std::get_if<ReleaseEvent>(&next.action)) release->joint -= released_below(release->joint);
        if (auto* motor = std::get_if<MotorEvent>(&next.action)) motor->joint -= released_below(motor->joint);
        coming.push_back(next);
    }
    return coming;
}

}  // namespace scree
