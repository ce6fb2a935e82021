// Burdens: weights handed down from body to body through contacts.
#include "demos/program/advice/burden.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/tables/state.h"
#include "shaders/physics/body/body_scale.h"

namespace scree::demos {

namespace {

constexpr double least_ratio = 100;  // what bears less, as small bodies in a heap do, is judged by its penetration
constexpr double upright = 0.5;      // cosine between a contact's normal and the vertical from which on it bears

// Two laws, from columns of 2 to 10 boxes of 0.1 to 3 m that bear 100 to 3,000 times the weight of one, over 10 s:
// - A contact under `ratio` weights of the lighter body gives way by 3.6 ratio g h^2 (substep h). Beyond a tenth of the width
//   columns of ten buckle: boxes of 0.1 m stand with 12, 16, 48 substeps at 60 Hz under 100, 300, 1,000.
// - Whatever its size, a column needs 0.7 to 0.96 ratio substeps a second: boxes of 1 m stand with 16 and 48 under 1,000 and
// 3,000.
constexpr double compliance = 3.6, spare = 1.1;
constexpr double crushed = 0.09, falling = 0.75;  // of the width, and substeps a second of the ratio, where columns fall

double substeps_for(double ratio, double width, double gravity, double give) {
    return std::sqrt(compliance * ratio * gravity / (give * width));
}

// Who rests on whom: `below` bears `above`.
struct Resting {
    std::size_t below, above;
};

std::vector<Resting> resting_pairs(const World& world, std::size_t count, const glm::dvec3& up) {
    std::vector<Resting> pairs;
    const double gravity = glm::length(glm::dvec3(world.scene().gravity)), dt = 1 / static_cast<double>(world.settings().rate);
    const double within = gravity * dt * dt;  // m, what is nearer touches within a step
    for (const ContactState& contact : world.contacts()) {
        if (contact.a >= count || contact.b >= count) continue;
        const auto touches = [&](const ContactState::Point& point) { return point.separation < within; };
        if (!std::any_of(contact.points.begin(), contact.points.begin() + contact.count, touches)) continue;
        const double rise = glm::dot(glm::dvec3(contact.normal), up);  // from a to b
        if (rise > upright) pairs.push_back({contact.a, contact.b});
        if (rise < -upright) pairs.push_back({contact.b, contact.a});
    }
    // Pairs in several contacts, as compounds have, bear once.
    const auto order = [](const Resting& x, const Resting& y) { return std::tie(x.above, x.below) < std::tie(y.above, y.below); };
    std::sort(pairs.begin(), pairs.end(), order);
    const auto same = [](const Resting& x, const Resting& y) { return x.above == y.above && x.below == y.below; };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
    return pairs;
}

}  // namespace

// With a fifth of what crushes, contacts give way by too little for other advice.
double needed_substeps(double ratio, double width, double gravity) {
    return spare * std::max(spare * falling * ratio, substeps_for(ratio, width, gravity, 0.2 * crushed));
}

std::vector<Burden> overburdened(const World& world) {
    const Scene& scene = world.scene();
    const double gravity = glm::length(glm::dvec3(scene.gravity));
    if (gravity <= 0) return {};
    const State& state = world.state();
    const std::size_t count = world.copies() > 1 ? world.bodies_of_copy() : scene.bodies.size();
    const glm::dvec3 up = glm::dvec3(scene.gravity) / -gravity;
    const std::vector<Resting> pairs = resting_pairs(world, count, up);
    if (pairs.empty()) return {};
    std::vector<double> own(count, 0), height(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        if (scene.bodies[i].motion != Motion::dynamic) continue;
        own[i] = static_cast<double>(mass_properties(scene.bodies[i]).mass);
        height[i] = glm::dot(glm::dvec3(state.poses[state.row_of(i)].position), up);
    }
    std::vector<double> on(count, 0);  // kg, handed down
    std::vector<std::size_t> order(count), heaviest(count, no_body);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height[a] > height[b]; });
    for (const std::size_t above : order) {  // each when all that lies on it has handed down its weight
        if (own[above] <= 0) continue;
        const auto is_before = [](const Resting& pair, std::size_t body) { return pair.above < body; };
        const auto first = std::lower_bound(pairs.begin(), pairs.end(), above, is_before);
        auto last = first;
        while (last != pairs.end() && last->above == above) ++last;
        for (auto pair = first; pair != last; ++pair) {
            on[pair->below] += (own[above] + on[above]) / static_cast<double>(last - first);
            std::size_t& top = heaviest[pair->below];
            if (top == no_body || own[top] < own[above]) top = above;
        }
    }
    const double present = static_cast<double>(world.settings().rate) * static_cast<double>(world.settings().substeps);
    std::vector<Burden> all;
    for (std::size_t i = 0; i < count; ++i) {
        if (own[i] <= 0 || on[i] < least_ratio * own[i]) continue;
        const physics::BodyProperties& body = state.properties[state.row_of(i)];
        const double width =
            2 * static_cast<double>(physics::face_half_width(body, state.poses[state.row_of(i)].orientation, vec3(up)));
        const double ratio = on[i] / own[i];
        if (std::max(falling * ratio, substeps_for(ratio, width, gravity, crushed)) < present) continue;
        all.push_back({i, heaviest[i], ratio, needed_substeps(ratio, width, gravity)});
    }
    return all;
}

std::string options_for(double substeps_a_second, double rate) {
    constexpr double most_substeps = 64, most_rate = 1000;
    double higher = rate;
    while (substeps_a_second > most_substeps * higher) higher *= 2;
    if (higher > most_rate) return "";
    const std::string substeps = fmt::format("--substeps {}", std::max(1L, std::lround(std::ceil(substeps_a_second / higher))));
    return higher == rate ? substeps : fmt::format("--rate {:g} {}", higher, substeps);
}

}  // namespace scree::demos
