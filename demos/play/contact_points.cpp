// The contact points of one body.
#include "demos/play/contact_points.h"

#include <glm/gtc/quaternion.hpp>

#include "compute/tables/state.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// An arm turned from one orientation to another.
vec3 turned_on(vec4 before, vec4 now, vec3 arm) {
    return physics::rotate(now, physics::rotate_back(before, arm));
}

}  // namespace

std::vector<ContactPoint> contact_points_of(const World& world, std::size_t body) {
    const State& state = world.state();
    const std::uint32_t row = static_cast<std::uint32_t>(world.row_of(body));
    std::vector<ContactPoint> points;
    for (std::size_t i = 0; i < state.counted().contacts; ++i) {
        const physics::Contact& contact = state.contacts[i];
        const std::uint32_t a = state.body_of(contact.a), b = state.body_of(contact.b);
        if (a != row && b != row) continue;
        for (std::uint32_t k = 0; k < contact.count; ++k) {
            const vec3 arm(contact.points[k]);
            const physics::Pose& on_a = state.poses[a];
            physics::Pose on_b = state.poses[b];
            if (state.is_periodic())
                on_b = physics::at_image(on_b, physics::image_of_b(state.properties[a], state.properties[b],
                                                                   on_b.position - on_a.position, state.fixed()));
            ContactPoint point;
            point.other = state.id_of(a == row ? b : a);
            // The mean of the point as it moves with either body.
            point.position = 0.5f * (on_a.position + turned_on(contact.orientation_a, on_a.orientation, arm) + on_b.position +
                                     turned_on(contact.orientation_b, on_b.orientation, arm - contact.center_offset));
            point.normal = a == row ? -contact.normal : contact.normal;
            point.force = state.impulses[i].normal[static_cast<int>(k)] * state.fixed().inverse_h;
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace scree::demos
