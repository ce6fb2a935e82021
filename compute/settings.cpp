// The ranges of the settings.
#include "compute/settings.h"

#include <stdexcept>
#include <string>

namespace scree {

namespace {

void demand(bool condition, const std::string& what) {
    if (!condition) throw std::invalid_argument("settings: " + what);
}

}  // namespace

Settings checked(const Settings& s) {
    demand(s.rate >= 10 && s.rate <= 1000, "rate must be between 10 and 1000 Hz, is " + std::to_string(s.rate));
    demand(s.substeps >= 1 && s.substeps <= 64, "substeps must be between 1 and 64, is " + std::to_string(s.substeps));
    demand(s.contact_hertz > 0 && s.contact_hertz <= 0.5f, "contact_hertz must be in (0, 0.5]");
    demand(s.contact_damping_ratio >= 1 && s.contact_damping_ratio <= 40, "contact_damping_ratio must be between 1 and 40");
    demand(s.push_speed > 0 && s.push_speed <= 100, "push_speed must be in (0, 100] m/s");
    demand(s.split_relaxation >= 1 && s.split_relaxation < 2, "split_relaxation must be in [1, 2)");
    demand(s.speculative_distance > 0 && s.speculative_distance <= 1, "speculative_distance must be in (0, 1] m");
    demand(s.restitution_threshold >= 0, "restitution_threshold must not be negative");
    demand(s.max_speed > 0 && s.max_speed <= 1e4f, "max_speed must be in (0, 10000] m/s");
    demand(s.max_turn > 0 && s.max_turn <= 1.57f, "max_turn must be in (0, 1.57] rad");
    demand(s.sleep_speed >= 1e-6f && s.sleep_speed <= 10, "sleep_speed must be between 1e-6 and 10 m/s");
    demand(s.sleep_time > 0 && s.sleep_time <= 4, "sleep_time must be in (0, 4] s");
    demand(s.friction_factor >= 0 && s.friction_factor <= 10, "friction_factor must be between 0 and 10");
    demand(s.least_restitution >= 0 && s.least_restitution <= 1, "least_restitution must be between 0 and 1");
    return s;
}

}  // namespace scree
