// World: contacts of the last step in bulk, and events.
#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "compute/tables/memory_order.h"
#include "compute/world/queries/sensors.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/shapes.h"

namespace scree {

namespace {

// Of an arm from a body's centre, in world axes when the contact was made: where it is now.
vec3 turned_on(vec4 when_made, vec4 now, vec3 arm) {
    return physics::rotate(now, physics::rotate_back(when_made, arm));
}

// The point moves with both bodies, but does not roll with round ones.
vec3 point_now(const State& state, const physics::Contact& contact, physics::uint k) {
    const vec3 arm(contact.points[k]), arm_b = arm - contact.center_offset;
    const physics::Pose& a = state.poses[state.body_of(contact.a)];
    physics::Pose b = state.poses[state.body_of(contact.b)];
    if (state.is_periodic())
        b = physics::at_image(b, physics::image_of_b(state.properties[contact.a], state.properties[contact.b],
                                                     b.position - a.position, state.fixed()));
    const bool round_a = state.properties[contact.a].shape == physics::SHAPE_SPHERE;
    const bool round_b = state.properties[contact.b].shape == physics::SHAPE_SPHERE;
    if (round_a != round_b) return round_a ? a.position + arm : b.position + arm_b;
    if (round_a) return 0.5f * (a.position + arm + b.position + arm_b);
    return 0.5f * (a.position + turned_on(contact.orientation_a, a.orientation, arm) + b.position +
                   turned_on(contact.orientation_b, b.orientation, arm_b));
}

}  // namespace

std::vector<ContactState> World::contacts() const {
    Impl& in = whole();
    in.bring(body_ranges);
    in.bring(contact_ranges);
    const State& state = in.state;
    const std::vector<std::size_t> first_parts = first_part_rows();
    const auto side = [&](std::uint32_t row) {
        const std::uint32_t body = state.id_of(state.body_of(row));
        const bool part = row >= state.fixed().first_part;
        return std::pair(std::size_t{body}, part ? static_cast<std::uint32_t>(row - first_parts[body]) : 0u);
    };
    std::vector<ContactState> all;
    all.reserve(state.counted().contacts);
    for (const std::uint32_t i : contacts_by_id(state)) {
        const physics::Contact& contact = state.contacts[i];
        const physics::ContactImpulse& impulse = state.impulses[i];
        ContactState& made = all.emplace_back();
        std::tie(made.a, made.part_a) = side(contact.a);
        std::tie(made.b, made.part_b) = side(contact.b);
        made.normal = contact.normal;
        made.friction = impulse.friction * state.fixed().inverse_h;
        made.count = contact.count;
        for (physics::uint k = 0; k < contact.count; ++k) {
            const float force = impulse.normal[static_cast<int>(k)] * state.fixed().inverse_h;
            made.points[k] = {point_now(state, contact, k), impulse.separation[static_cast<int>(k)], std::max(0.0f, force)};
        }
        if (made.a < made.b) continue;
        std::swap(made.a, made.b);
        std::swap(made.part_a, made.part_b);
        made.normal = -made.normal;
        made.friction = -made.friction;
    }
    std::sort(all.begin(), all.end(), [](const ContactState& x, const ContactState& y) {
        return std::tie(x.a, x.b, x.part_a, x.part_b) < std::tie(y.a, y.b, y.part_a, y.part_b);
    });
    return all;
}

std::vector<vec3> World::touch_forces(std::span<const std::size_t> bodies) const {
    for (const std::size_t body : bodies) whole().require_body(body);
    std::vector<vec3> sums(whole().scene.bodies.size(), vec3(0));
    for (const ContactState& contact : contacts()) {
        vec3 on_b = contact.friction;
        for (std::uint32_t k = 0; k < contact.count; ++k) on_b += contact.normal * contact.points[k].force;
        sums[contact.a] -= on_b;
        sums[contact.b] += on_b;
    }
    std::vector<vec3> forces;
    for (const std::size_t body : bodies) forces.push_back(sums[body]);
    return forces;
}

void World::set_events(const EventSettings& settings) {
    Impl& in = whole();
    if (!(settings.hit_speed >= 0)) throw std::invalid_argument("events: hit_speed must be at least 0 m/s");
    if (settings == in.events.settings()) return;
    in.bring(body_ranges);
    in.bring(joint_ranges);
    in.events.set(settings, in.scene, in.state);
    in.state.sums_impulses = settings.contacts;
    in.still = {};
    in.runner->adapt();
}

std::vector<SensorOverlap> World::sensed() const {
    const Impl& in = whole();
    if (!has_sensors(in.state)) return {};
    in.bring(body_ranges);
    return overlaps_of_sensors(in.state, in.runner->threads());
}

const EventSettings& World::event_settings() const {
    return whole().events.settings();
}

std::vector<Event> World::take_events() {
    return whole().events.take();
}

}  // namespace scree
