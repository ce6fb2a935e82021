// Follows a world for the writers of animations.
#include "demos/film/export/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "compute/scene/shape_geometry.h"
#include "compute/tables/state.h"
#include "host/canvas/colors.h"

namespace scree::demos {

AnimationRecorder::AnimationRecorder(const World& world, int every, std::unique_ptr<AnimationWriter> writer)
    : writer_(std::move(writer)), start_time_(world.time()) {
    all_.rate = world.settings().rate;
    all_.every = every;
    take_bodies(world);
    writer_->begin(all_);
    record(world);
}

void AnimationRecorder::take_bodies(const World& world) {
    const Scene& scene = world.scene();
    const std::vector<BodyState> states = world.bodies();
    const State& state = world.state();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (std::holds_alternative<Plane>(scene.bodies[i].shape) || !states[i].exists) continue;
        const float reach = bounding_radius(scene.bodies[i].shape);
        low = glm::min(low, states[i].position - reach);
        high = glm::max(high, states[i].position + reach);
    }
    if (low.x > high.x) low = glm::vec3(-1), high = glm::vec3(1);
    const float plane_reach = std::max(20.0f, 2 * glm::length(high - low));
    MeshCollection meshes;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const scree::Body& described = scene.bodies[i];
        AnimatedBody body;
        try {
            body.handle = world.handle_of(i);
        } catch (const std::out_of_range&) {
            continue;  // removed before
        }
        body.id = i;
        body.name = described.name.empty() ? fmt::format("body {}", i) : described.name;
        body.plane = std::holds_alternative<Plane>(described.shape);
        body.drawn = meshes.add(described.shape, plane_reach, 0.5f * (low + high));
        if (described.color) body.color = host::linear_from_srgb(*described.color);
        body.moves = described.motion != Motion::fixed;
        body.inverse_mass = double{state.properties[state.row_of(i)].inverse_mass};
        body.exists = body.existed = states[i].exists;
        body.now = states[i];
        body.origin = described.origin;
        if (!body.plane) body.start_position = states[i].position, body.start_orientation = states[i].orientation;
        all_.bodies.push_back(std::move(body));
    }
    all_.meshes = meshes.meshes();
    arrangements_ = world.arrangements();
}

void AnimationRecorder::record(const World& world) {
    if (recorded_ == world.steps()) return;
    recorded_ = world.steps();
    const bool rearranged = arrangements_ != world.arrangements();
    arrangements_ = world.arrangements();
    const std::vector<BodyState> states = world.bodies();
    for (AnimatedBody& body : all_.bodies) {
        if (body.plane || body.id >= states.size()) continue;
        const BodyState& now = states[body.id];
        body.exists = now.exists && ((!rearranged && body.exists) || world.is_valid(body.handle));
        if (body.exists)
            body.now = now;
        else
            body.now.velocity = body.now.angular_velocity = glm::vec3(0);
    }
    writer_->add(all_, {world.steps(), world.time() - start_time_});
}

int AnimationRecorder::steps_until_due(const World& world) const {
    const auto every = static_cast<std::uint64_t>(all_.every);
    return static_cast<int>(every - world.steps() % every);
}

void AnimationRecorder::after_step(const World& world) {
    if (world.steps() % static_cast<std::uint64_t>(all_.every) == 0) record(world);
}

}  // namespace scree::demos
