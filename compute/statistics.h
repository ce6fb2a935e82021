// Statistics and hash of a state on the host.
#pragma once

#include <cstdint>
#include <optional>

#include "compute/tables/state.h"
#include "compute/world.h"

namespace scree {

// What is summed over the contacts of the last step.
struct ContactSums {
    std::uint64_t manifolds = 0, points = 0, penetrating = 0;  // the last one: points
    double depth = 0;                                          // of these, m, in all
    double greatest = 0, greatest_resting = 0;                 // Statistics::penetration_max, penetration_resting
};
// Over the contacts in the tables, if ranks share the world over those that this one owns.
ContactSums contact_sums(const State& state, std::optional<std::uint32_t> copy = std::nullopt);
ContactSums operator+(const ContactSums& a, const ContactSums& b);

// What statistics read of a body in the tables.
struct BodyRecord {
    physics::uint motion = 0, rest = 0;
    physics::Pose pose;
    physics::Velocity velocity;
    static BodyRecord of(const State& state, std::uint32_t row);
};
// Sums over bodies; of all, the sums over some and over the others put together.
class BodySums {
public:
    // `planes`: those of its world. `sleep_steps`: Parameters::sleep_steps.
    void add(const Body& body, const BodyRecord& now, vec3 gravity, const std::vector<Plane>& planes, physics::uint sleep_steps);
    void add(const BodySums& others);
    Statistics statistics() const;  // without contacts and joints

private:
    void add_motion(const Body& body, const BodyRecord& now, vec3 gravity);
    Statistics sums_;
    glm::dvec3 momentum_{0}, spin_{0};
};
void add_contacts(const ContactSums& contacts, Statistics& sums);
// The planes of a scene's bodies first .. last that its bodies can fall through.
std::vector<Plane> solid_planes(const Scene& scene, std::size_t first, std::size_t last);

// `scene`: the checked scene with which the state began. `copy`: of one copy of the scene alone.
Statistics statistics_of(const Scene& scene, const State& state, const ContactSums& contacts,
                         std::optional<std::uint32_t> copy = std::nullopt);

// Appends what a hash has of a body.
void append_hashed(std::vector<float>& values, const physics::Pose& pose, const physics::Velocity& velocity);
// XXH64 over position, orientation, velocity and angular velocity of every body in id order; if bodies may break, also
// over which of them exist.
std::uint64_t hash_of(const State& state, std::optional<std::uint32_t> copy = std::nullopt);

}  // namespace scree
