// Estimates the range of momentum, speed, spin or energy in a scene.
#include "demos/film/color_range.h"

#include <algorithm>
#include <cmath>

namespace scree::demos {

namespace {

float rounded(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-6))));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * power * 1.001) return static_cast<float>(step * power);
    }
    return static_cast<float>(10 * power);
}

}  // namespace

std::pair<float, float> color_range(const LoadedScene& subject, const Settings& settings, const std::string& quantity) {
    if (quantity == "contacts") return {0.0f, 12.0f};  // the kissing number of equal spheres
    if (quantity == "sleep") return {0.0f, settings.sleep_time};
    if (quantity == "height") return {std::min(subject.low.y, subject.high.y - 1e-3f), subject.high.y};
    double mass = 0, reach = 0, fastest = 0, highest = subject.low.y, count = 0;
    for (const Body& body : subject.scene.bodies) {
        if (body.motion != Motion::dynamic) continue;
        const MassProperties properties = mass_properties(body.shape, body.density);
        mass += properties.mass;
        reach += std::sqrt(static_cast<double>(properties.inertia.x) / properties.mass);  // radius of gyration
        fastest = std::max<double>(fastest, glm::length(body.velocity));
        highest = std::max<double>(highest, body.position.y);
        count += 1;
    }
    if (count == 0) return {0.0f, 1.0f};
    mass /= count;
    reach /= count;
    const double fall = 0.3 * std::max(0.3, highest - subject.low.y);
    const double speed = std::max({fastest, std::sqrt(2 * glm::length(subject.scene.gravity) * fall), 0.1});
    if (quantity == "speed") return {0.0f, rounded(speed)};
    if (quantity == "spin") return {0.0f, rounded(speed / std::max(reach, 1e-3))};
    if (quantity == "kinetic-energy") return {0.0f, rounded(0.5 * mass * speed * speed)};
    if (quantity == "angular-momentum") return {0.0f, rounded(0.5 * mass * speed * reach)};
    // Impulse at the base of a column as high as the scene.
    if (quantity == "contact-impulse") {
        const double above = std::max(3.0, 0.5 * (highest - subject.low.y) / std::max(2 * reach, 1e-3));
        const double weight = mass * std::max(1.0, static_cast<double>(glm::length(subject.scene.gravity)));
        return {0.0f, rounded(2 * above * weight * 1 / static_cast<double>(settings.rate) / settings.substeps)};
    }
    return {0.0f, rounded(mass * speed)};
}

std::pair<float, float> logarithmic_range(std::pair<float, float> range) {
    return {range.second / 1000, range.second};
}

}  // namespace scree::demos
