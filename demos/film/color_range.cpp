// The range of a quantity in a scene, from percentiles over its bodies.
#include "demos/film/color_range.h"

#include <algorithm>
#include <cmath>

#include "compute/scene/shape_geometry.h"

namespace scree::demos {

namespace {

constexpr double rehearsed_seconds = 2;       // of simulated time
constexpr double most_body_steps = 1e6;       // of the rehearsal: a second or two of work
constexpr std::size_t most_bodies = 200'000;  // more are not rehearsed: another world would not fit beside the first

float rounded(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9))));
    for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (value <= step * power * 1.001) return static_cast<float>(step * power);
    }
    return static_cast<float>(10 * power);
}

// A dynamic body's share in a quantity at a speed and a spin.
struct Inertia {
    double mass = 0;      // kg
    double gyration = 0;  // m, least radius of gyration
    double reach = 0;     // m
    explicit Inertia(const Body& body) : reach(bounding_radius(body.shape)) {
        const MassProperties properties = mass_properties(body);
        mass = properties.mass;
        const vec3 i = properties.inertia;
        gyration = mass > 0 ? std::sqrt(static_cast<double>(std::min({i.x, i.y, i.z})) / mass) : 0;
    }
    double value(const std::string& quantity, double speed, double spin) const {
        const double around = gyration * spin;
        if (quantity == "speed") return speed;
        if (quantity == "spin") return spin;
        if (quantity == "kinetic-energy") return 0.5 * mass * (speed * speed + around * around);
        if (quantity == "angular-momentum") return mass * gyration * around;
        return mass * speed;
    }
    // Of a body that moves at a speed and turns as fast as if it rolled.
    double value_at(const std::string& quantity, double speed) const {
        return value(quantity, speed, speed / std::max(2 * gyration, 1e-4));
    }
};

bool is_moving_quantity(const std::string& quantity) {
    for (const char* known : {"momentum", "speed", "spin", "kinetic-energy", "angular-momentum"})
        if (quantity == known) return true;
    return false;
}

// The greatest value of each body in the first seconds. The world's script acts as in the run.
void rehearse(const LoadedScene& subject, const Settings& settings, const std::string& quantity, int steps,
              std::vector<double>& greatest) {
    World world(subject.scene, settings);
    for (int i = 0; i <= steps; ++i) {
        if (subject.before_step) subject.before_step(world);
        const std::vector<double> now = values_now(world, quantity);
        greatest.resize(std::max(greatest.size(), now.size()));
        for (std::size_t k = 0; k < now.size(); ++k) greatest[k] = std::max(greatest[k], now[k]);
        if (i < steps) world.step();
    }
}

// Impulse at the base of a column as high as the scene.
double column_impulse(const LoadedScene& subject, const Settings& settings) {
    double highest = subject.low.y;
    std::vector<double> masses, reaches;
    for (const Body& body : subject.scene.bodies) {
        if (body.motion != Motion::dynamic) continue;
        const Inertia inertia(body);
        masses.push_back(inertia.mass);
        reaches.push_back(inertia.gyration);
        highest = std::max<double>(highest, body.position.y);
    }
    const double mass = nearly_greatest(masses), reach = nearly_greatest(reaches);
    const double above = std::max(3.0, 0.5 * (highest - subject.low.y) / std::max(2 * reach, 1e-3));
    const double weight = mass * std::max(1.0, static_cast<double>(glm::length(subject.scene.gravity)));
    return 2 * above * weight / static_cast<double>(settings.rate) / settings.substeps;
}

}  // namespace

double nearly_greatest(std::vector<double> values) {
    if (values.empty()) return 0;
    const std::size_t left_out = std::max<std::size_t>(values.size() / 20, values.size() >= 6 ? 1 : 0);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1 - left_out);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<double> values_now(const World& world, const std::string& quantity) {
    std::vector<double> values;
    if (!is_moving_quantity(quantity)) return values;
    const std::vector<Body>& bodies = world.scene().bodies;
    const std::vector<BodyState> states = world.bodies();
    values.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].motion != Motion::dynamic || !states[i].exists) continue;
        values.push_back(
            Inertia(bodies[i]).value(quantity, glm::length(states[i].velocity), glm::length(states[i].angular_velocity)));
    }
    return values;
}

std::pair<float, float> color_range(const LoadedScene& subject, const Settings& settings, const std::string& quantity,
                                    bool rehearses) {
    if (quantity == "contacts") return {0.0f, 12.0f};  // the kissing number of equal spheres
    if (quantity == "sleep") return {0.0f, settings.sleep_time};
    if (quantity == "height") return {std::min(subject.low.y, subject.high.y - 1e-3f), subject.high.y};
    if (quantity == "contact-impulse") return {0.0f, rounded(column_impulse(subject, settings))};
    if (!is_moving_quantity(quantity)) return {0.0f, 1.0f};
    const std::size_t bodies = subject.scene.bodies.size();
    const double rate = static_cast<double>(settings.rate), gravity = glm::length(subject.scene.gravity);
    const double steps = rehearses && bodies <= most_bodies
                             ? std::min(rehearsed_seconds * rate, most_body_steps / static_cast<double>(bodies + 1))
                             : 0;
    // Even where all rests, a body that falls by a part of its size is seen.
    std::vector<double> greatest;
    for (const Body& body : subject.scene.bodies) {
        if (body.motion != Motion::dynamic || body.piece_of != no_body) continue;
        const Inertia inertia(body);
        const double own_fall = std::sqrt(2 * std::max(gravity, 0.5) * 0.1 * inertia.reach);
        const double fall = std::sqrt(2 * gravity * 0.3 * std::max(0.3, static_cast<double>(body.position.y - subject.low.y)));
        const double speed = std::max<double>(glm::length(body.velocity), steps < rate ? fall : own_fall);
        greatest.push_back(inertia.value_at(quantity, speed));
    }
    if (greatest.empty()) return {0.0f, 1.0f};
    std::vector<double> measured;
    if (steps >= 1) rehearse(subject, settings, quantity, static_cast<int>(steps), measured);
    return {0.0f, rounded(std::max(nearly_greatest(std::move(greatest)), nearly_greatest(std::move(measured))))};
}

std::pair<float, float> logarithmic_range(std::pair<float, float> range) {
    return {range.second / 1000, range.second};
}

bool MeasuredRange::update(double value, double seconds) {
    constexpr double patience = 4;  // s
    if (value > 1.25 * static_cast<double>(high_)) {
        high_ = rounded(1.5 * value);
        below_ = most_ = 0;
        return true;
    }
    most_ = std::max(most_, value);
    below_ = value * 6 < static_cast<double>(high_) ? below_ + seconds : 0;
    if (below_ == 0) most_ = 0;
    if (below_ < patience || most_ <= 0) return false;
    high_ = rounded(2 * most_);
    below_ = most_ = 0;
    return true;
}

}  // namespace scree::demos
