// The knobs of a step. The defaults stand; each says what it costs to turn it.
#pragma once

#include <cstdint>

namespace scree {

struct Settings {
    float rate = 60;   // steps per second, 10 to 1000
    int substeps = 8;  // per step, 1 to 64. Contact stiffness grows with its square, cost in proportion

    // Contact constraint: a damped spring solved implicitly (Catto, Soft Constraints, GDC 2011).
    float contact_hertz = 0.14f;         // of the substep rate. Above 0.14 split contacts over-react and stacks buzz
    float contact_damping_ratio = 10;    // 1 to 40: below, what was pushed apart springs
    float push_speed = 3;                // m/s, greatest speed at which overlapping bodies are pushed apart
    float relaxation = 1.5f;             // mass splitting: s = max(1, contacts / this). Converges below 2; 1.95 fell over
    float speculative_distance = 0.02f;  // m, contacts are made this far ahead (and as far as the pair moves in a step)
    float restitution_threshold = 1;     // m/s, slower impacts do not bounce: bodies at rest would hop
    float max_speed = 400;               // m/s, velocities are clamped to it
    float max_turn = 0.785f;             // rad per substep, angular velocity is clamped to it

    // What has been quiet for a while sleeps: it moves no more and costs next to nothing, until something wakes it.
    bool sleeping = true;
    float sleep_speed = 0.05f;  // m/s, slower is quiet (or a tenth of a smaller body's half width in a second). Higher, and slow
                                // creep freezes
    float sleep_time = 0.5f;    // s of quiet. Shorter, and a body sleeps at the turning point of its swing

    // On top of what the bodies' materials say; see World::set_friction_factor and World::set_least_restitution.
    float friction_factor = 1;    // 0 to 10, on the friction of every pair
    float least_restitution = 0;  // 0 to 1, of every pair

    // Where there are thousands of bodies, those that are near each other are put side by side in memory, again and again as they
    // move, in a fiftieth of the time at most. No result depends on it, nor any index.
    bool reordering = true;

    // Where the buffers start. They grow when a step needs more, and no result depends on it.
    std::uint32_t pairs_at_first = 0;     // 0: from the number of bodies
    std::uint32_t contacts_at_first = 0;  // 0: from the number of bodies
};

// The settings, if every one is in its range; else throws std::invalid_argument naming the one that is not.
Settings checked(const Settings& settings);

}  // namespace scree
