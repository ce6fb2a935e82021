// Series over time for the window's graphs.
#include "demos/play/history.h"

#include <fmt/format.h>

#include <algorithm>

#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float kept_seconds = 60;
constexpr std::size_t most_samples = 1200;
constexpr double most_looked_at = 2e5;  // bodies looked at in a simulated second

// Kinetic and potential energy, momentum.
std::array<float, 3> motion_of(const World& world, std::size_t body) {
    const BodyState state = world.body(body);
    const Body& what = world.scene().bodies[body];
    const MassProperties mass = what.motion == Motion::dynamic ? mass_properties(what) : MassProperties{};
    const vec3 spin = physics::rotate_back(state.orientation, state.angular_velocity);
    const float turning = glm::dot(mass.inertia, spin * spin), speed = glm::length(state.velocity);
    return {0.5f * (mass.mass * speed * speed + turning), -mass.mass * glm::dot(world.scene().gravity, state.position),
            mass.mass * speed};
}

}  // namespace

const std::array<const char*, History::count> History::names{"kinetic energy", "potential energy", "energy",
                                                             "momentum",       "contacts",         "time of a step"};
const std::array<const char*, History::count> History::units{"J", "J", "J", "kg m/s", "", "ms"};

void History::look(const World& world, std::optional<std::size_t> body, std::uint64_t beginning, double milliseconds_a_step) {
    const auto now = static_cast<float>(world.time());
    const bool anew = body != body_ || beginning != beginning_ || (!times_.empty() && now < times_.back());
    if (anew) {
        times_.clear();
        for (auto& values : values_) values.clear();
        body_ = body;
        beginning_ = beginning;
    }
    const double bodies = static_cast<double>(std::max<std::size_t>(1, world.scene().bodies.size()));
    const auto pause = static_cast<float>(std::max(0.05, bodies / most_looked_at));
    if (!times_.empty() && now - times_.back() < pause * 0.999f) return;
    std::array<float, count> values{};
    if (body) {
        const std::array<float, 3> motion = motion_of(world, *body);
        values = {motion[0], motion[1], motion[0] + motion[1], motion[2], static_cast<float>(world.contacts_of(*body).size())};
    } else {
        const Statistics s = world.statistics();
        const vec3 p(s.momentum[0], s.momentum[1], s.momentum[2]);
        values = {static_cast<float>(s.kinetic_energy), static_cast<float>(s.potential_energy),
                  static_cast<float>(s.kinetic_energy + s.potential_energy), glm::length(p), static_cast<float>(s.manifolds)};
    }
    values[step_ms] = static_cast<float>(milliseconds_a_step);
    times_.push_back(now);
    for (std::size_t k = 0; k < count; ++k) values_[k].push_back(values[k]);
    if (times_.size() <= most_samples && now - times_.front() <= kept_seconds) return;
    times_.erase(times_.begin());
    for (auto& series : values_) series.erase(series.begin());
}

std::string History::csv() const {
    std::string text = "time (s)";
    for (std::size_t k = 0; k < count; ++k)
        text += std::string(",") + names[k] + (*units[k] ? fmt::format(" ({})", units[k]) : "");
    text += "\n";
    for (std::size_t i = 0; i < times_.size(); ++i) {
        text += fmt::format("{:.9g}", times_[i]);
        for (const auto& series : values_) text += fmt::format(",{:.9g}", series[i]);
        text += "\n";
    }
    return text;
}

}  // namespace scree::demos
