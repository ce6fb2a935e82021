// Reading a world for measures.
#include "compute/measures/scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compute/measures/fixed_sum.h"
#include "compute/scene/portable_math.h"
#include "compute/tables/state.h"

namespace scree::granular {

using glm::dvec3;

double length_of(dvec3 v) {
    return std::sqrt(glm::dot(v, v));
}

double diameter_of(const Grain& grain) {
    return portable::cbrt(6 * grain.volume / std::numbers::pi);
}

namespace {

Touch touch_of(const ContactState& contact) {
    Touch touch{contact.a, contact.b, dvec3(contact.normal)};
    touch.count = contact.count;
    for (std::uint32_t k = 0; k < contact.count; ++k) touch.force += double{contact.points[k].force};
    if (!(touch.force > 0)) return touch;
    for (std::uint32_t k = 0; k < contact.count; ++k) {
        const ContactState::Point& point = contact.points[k];
        // Friction acts on the patch as a whole: each point has as much of it as of the normal force.
        const double share = double{point.force} / touch.force;
        touch.points[k] = {dvec3(point.position), touch.normal * double{point.force} + dvec3(contact.friction) * share};
        touch.middle += dvec3(point.position) * share;
    }
    return touch;
}

}  // namespace

std::vector<std::uint8_t> grains_among(const World& world, const std::vector<BodyState>& states) {
    const Scene& scene = world.scene();
    std::vector<std::uint8_t> grains(scene.bodies.size(), 0);
    for (std::size_t i = 0; i < grains.size(); ++i)
        grains[i] = scene.bodies[i].motion == Motion::dynamic && scene.bodies[i].role == Role::solid && states[i].exists &&
                    !states[i].quarantined;
    for (const Joint& joint : scene.joints)
        for (const std::size_t body : {joint.a, joint.b})
            if (!joint.broken && body < grains.size()) grains[body] = 0;
    return grains;
}

void Scan::take_grains(const World& world, std::size_t first, std::size_t last) {
    const Scene& scene = world.scene();
    const State& state = world.state();
    states = world.bodies();
    grain_of.assign(scene.bodies.size(), no_grain);
    const std::vector<std::uint8_t> is_grain = grains_among(world, states);
    for (std::size_t i = first; i < last; ++i) {
        const Body& body = scene.bodies[i];
        const BodyState& now = states[i];
        if (is_grain[i] == 0) continue;
        Grain grain{i, dvec3(now.position), dvec3(now.velocity)};
        grain.solids = solids_of(body, grain.position, now.orientation);
        if (grain.solids.empty()) continue;
        for (const Solid& solid : grain.solids) grain.volume += solid.volume;
        const double inverse = double{state.properties[state.row_of(i)].inverse_mass};
        grain.mass = inverse > 0 ? 1 / inverse : 0;
        grain_of[i] = grains.size();
        grains.push_back(std::move(grain));
    }
}

void Scan::take_touches(const World& world, std::size_t first, std::size_t last) {
    for (const ContactState& contact : world.contacts()) {
        if (contact.a < first || contact.a >= last) continue;
        if (grain_of[contact.a] == no_grain && grain_of[contact.b] == no_grain) continue;
        Touch touch = touch_of(contact);
        if (touch.force > 0) touches.push_back(touch);
    }
}

void Scan::count_neighbours() {
    // Contacts of two bodies follow each other.
    const auto for_each_pair = [&](const auto& take) {
        for (std::size_t i = 0; i < touches.size(); ++i) {
            const Touch& one = touches[i];
            if (i > 0 && touches[i - 1].a == one.a && touches[i - 1].b == one.b) continue;
            take(grain_of[one.a], grain_of[one.b]);
        }
    };
    neighbours.assign(grains.size(), 0);
    for_each_pair([&](std::size_t a, std::size_t b) {
        if (a != no_grain) ++neighbours[a];
        if (b != no_grain) ++neighbours[b];
    });
    rattler.assign(grains.size(), 0);
    for (std::size_t i = 0; i < grains.size(); ++i) rattler[i] = neighbours[i] < 2;
}

void Scan::choose_units() {
    double force = 0, branch = 0, mass = 0, speed = 0, volume = 0, diameter = 0;
    for (const Touch& touch : touches)
        for (std::uint32_t k = 0; k < touch.count; ++k) {
            force = std::max({force, length_of(touch.points[k].force), touch.force});
            for (const std::size_t body : {touch.a, touch.b})
                if (const Grain* one = grain(body))
                    branch = std::max(branch, length_of(images.nearest(touch.points[k].position - one->position)));
        }
    for (const Grain& one : grains) {
        mass = std::max(mass, one.mass);
        speed = std::max(speed, length_of(one.velocity));
        volume = std::max(volume, one.volume);
        diameter = std::max(diameter, diameter_of(one));
    }
    units = {power_above(force),  power_above(branch),  power_above(mass), power_above(speed), 1,
             power_above(volume), power_above(diameter)};
}

Scan::Scan(const World& world, std::size_t copy) : images(world.scene().periodic) {
    const bool several = world.copies() > 1;
    const std::size_t count = world.bodies_of_copy();
    const std::size_t first = several ? copy * count : 0, last = several ? first + count : world.scene().bodies.size();
    take_grains(world, first, last);
    take_touches(world, first, last);
    count_neighbours();
    choose_units();
}

}  // namespace scree::granular
