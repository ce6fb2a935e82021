// World: kinematic bodies that move to target poses, and the user's own numbers.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <string>

#include "compute/scene/portable_math.h"

#include "compute/world/world_impl.h"

namespace scree {

namespace {

glm::dquat unit_quaternion_of(vec4 q) {
    return glm::normalize(glm::dquat{q.w, q.x, q.y, q.z});
}

// Rotation vector of the shorter way from one orientation to another, rad.
glm::dvec3 turn_between(vec4 from, vec4 to) {
    glm::dquat turn = unit_quaternion_of(to) * glm::conjugate(unit_quaternion_of(from));
    if (turn.w < 0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 1e-12 ? axis * (2 * portable::atan2(sine, turn.w) / sine) : 2.0 * axis;
}

struct Way {
    vec3 velocity, angular_velocity;
};
Way way_to(const BodyTarget& target, const physics::Pose& pose, double rate) {
    const double per_second = rate / target.steps;
    return {vec3((glm::dvec3(target.position) - glm::dvec3(pose.position)) * per_second),
            vec3(turn_between(pose.orientation, target.orientation) * per_second)};
}

}  // namespace

void World::Impl::require_reachable(const BodyTarget& target) const {
    require_body(target.body);
    const auto demand = [&](bool condition, const std::string& what) {
        if (!condition) throw std::invalid_argument(name_of_body(target.body) + ": " + what);
    };
    const auto near = [](float x) { return std::abs(x) <= 1e6f; };
    const double squared = glm::dot(glm::dvec4(target.orientation), glm::dvec4(target.orientation));
    demand(scene.bodies[target.body].motion == Motion::kinematic, "only a kinematic body can be moved to a target");
    demand(near(target.position.x) && near(target.position.y) && near(target.position.z),
           "the target must be within 1000000 m of 0");
    demand(std::isfinite(squared) && squared >= 1e-12, "the target's orientation must be finite and not of length 0");
    demand(target.steps >= 1 && target.steps <= 1000000, "a target is reached in 1 to 1000000 steps");
}

void World::move_bodies(std::span<const BodyTarget> targets) {
    Impl& in = whole();
    TableRanges poses;
    for (const BodyTarget& target : targets) {
        in.require_reachable(target);
        poses.push_back({Table::poses, in.state.row_of(target.body), 1});
    }
    in.runner->download(poses);
    std::vector<Way> ways;
    for (const BodyTarget& target : targets) {
        const Way& way = ways.emplace_back(way_to(target, in.state.poses[in.state.row_of(target.body)], in.settings.rate));
        const float most_spin = in.state.fixed().max_spin;
        const auto refuse = [&](const char* what, float value, float most, const char* unit) {
            throw std::invalid_argument(in.name_of_body(target.body) + ": to be there in " + std::to_string(target.steps) +
                                        " steps it would " + what + " at " + std::to_string(value) + unit + ", above " +
                                        std::to_string(most) + unit + "; give it more steps");
        };
        if (const float speed = glm::length(way.velocity); speed > in.settings.max_speed)
            refuse("move", speed, in.settings.max_speed, " m/s");
        if (const float spin = glm::length(way.angular_velocity); spin > most_spin) refuse("turn", spin, most_spin, " rad/s");
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
        set_velocity(targets[i].body, ways[i].velocity, ways[i].angular_velocity);
        in.jump_to_velocity(targets[i].body);  // or it would not be there in time
        in.arrivals[targets[i].body] = in.steps + static_cast<std::uint64_t>(targets[i].steps);
    }
}

void World::Impl::stop_arrived() {
    for (auto arrival = arrivals.begin(); arrival != arrivals.end();) {
        if (arrival->second > steps) {
            ++arrival;
            continue;
        }
        physics::Action& action = actions[arrival->first];
        action.flags = physics::ACTION_SETS_VELOCITY;
        action.velocity = action.angular_velocity = vec3(0);
        arrival = arrivals.erase(arrival);
    }
}

int World::Impl::steps_until_arrival() const {
    std::uint64_t least = 1u << 20;
    for (const auto& [body, step] : arrivals) least = std::min(least, step > steps ? step - steps : 0);
    return static_cast<int>(least);
}

void World::set_user_data(std::size_t body, std::uint64_t data) {
    Impl& in = whole();
    in.require_body(body);
    in.keep_original(body);
    in.scene.bodies[body].user_data = data;
    in.edits.clear();
}

std::uint64_t World::user_data(std::size_t body) const {
    whole().require_body(body);
    return whole().scene.bodies[body].user_data;
}

}  // namespace scree
