// Settings of a step; each says the cost of changing it.
#pragma once

#include <cstdint>

namespace scree {

struct Settings {
    float rate = 60;    // steps per second, 10 to 1000
    int substeps = 12;  // per step, 1 to 64. Contact stiffness grows with its square, cost in proportion

    // Contact constraint: a damped spring solved implicitly (Catto, Soft Constraints, GDC 2011).
    float contact_hertz = 0.14f;         // of the substep rate. Above 0.14 split contacts over-react and stacks jitter
    float contact_damping_ratio = 10;    // 1 to 40: below, bodies pushed apart rebound
    float push_speed = 3;                // m/s, greatest push-out speed of penetrating bodies
    float relaxation = 1.5f;             // mass splitting: s = max(1, contacts / this). Converges below 2; 1.95 fell over
    float speculative_distance = 0.02f;  // m, most speculative margin (plus motion in a step); 0.04 half widths if less
    // m/s, slower impacts have no restitution. Nor have those slower than a fall in two steps along their normal (0.33
    // m/s at 60 Hz for what falls on level ground): resting bodies would hop
    float restitution_threshold = 0.02f;
    float max_speed = 400;    // m/s, velocities are clamped to it
    float max_turn = 0.785f;  // rad per substep, angular velocity is clamped to it

    // Bodies that have been quiet for a while sleep, at next to no cost, until something wakes them.
    bool sleeping = true;
    float sleep_speed = 0.05f;  // m/s, slower is quiet (small bodies: 0.1 half widths/s). Higher freezes slow creep
    float sleep_time = 0.5f;    // s of quiet. Shorter, and a body sleeps at the turning point of its swing

    // On top of the bodies' materials; see World::set_friction_factor and World::set_least_restitution.
    float friction_factor = 1;    // 0 to 10, scales the friction of every pair
    float least_restitution = 0;  // 0 to 1, lower bound for every pair

    // Worlds of 4,096 bodies and more keep neighbours side by side in memory, again and again as they move, in at most
    // a fiftieth of the time. No result or index depends on it.
    bool reordering = true;

    // Initial buffer sizes. Buffers grow when a step needs more, and no result depends on them.
    std::uint32_t pairs_at_first = 0;     // 0: derived from the number of bodies
    std::uint32_t contacts_at_first = 0;  // 0: derived from the number of bodies
};

// Returns the settings, or throws std::invalid_argument naming the one out of range.
Settings checked(const Settings& settings);

}  // namespace scree
