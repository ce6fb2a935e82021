// User commands on a running world, as data: performed, recorded, replayed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "compute/world.h"

namespace scree::replay {

struct Grab {              // see World::grip
    std::size_t grip = 0;  // the lowest free one, 0 to most_grips - 1
    std::size_t body = 0;
    vec3 anchor{0};  // body frame, m
    vec3 target{0};  // m
};
struct Drag {
    std::size_t grip = 0;
    vec3 target{0};  // m
};
struct Release {
    std::size_t grip = 0;
};
struct Add {
    Body body;
};
struct Join {
    Joint joint;
};
struct Unjoin {  // see World::remove_joint
    std::size_t joint = 0;
};
struct Remove {  // see World::remove_body
    std::size_t body = 0;
};
struct SetMaterial {  // the three plain coefficients; empty ones stay, as does the rest of the material
    std::size_t body = 0;
    std::optional<float> friction;
    std::optional<float> restitution;
    std::optional<float> rolling_resistance;  // m
};
struct SetMass {
    std::size_t body = 0;
    float mass = 1;  // kg
};
struct SetMotion {
    std::size_t body = 0;
    Motion motion = Motion::dynamic;
};
struct Push {  // a force for one step
    std::size_t body = 0;
    vec3 force{0};  // N
};
struct Explode {
    vec3 centre{0};    // m
    float radius = 1;  // m
    float speed = 0;   // m/s
};
struct Drive {  // until the next one; see World::drive
    std::size_t vehicle = 0;
    Controls controls;
};
struct Righten {  // see World::reset_upright
    std::size_t vehicle = 0;
};
struct Turn {  // settings; empty ones stay
    std::optional<vec3> gravity;
    std::optional<int> substeps;
    std::optional<float> friction_factor;
    std::optional<float> least_restitution;
    std::optional<bool> sleeping;
};

using UserCommand = std::variant<Grab, Drag, Release, Add, Push, Explode, Turn, Join, Unjoin, Drive, Righten, Remove, SetMaterial,
                                 SetMass, SetMotion>;

struct TimedAct {
    std::uint64_t step = 0;  // number of steps done before it
    UserCommand act;
};

// Performs a command. Throws what World throws, and std::invalid_argument for a grip that is not the lowest free one.
void perform(const UserCommand& act, World& world);

}  // namespace scree::replay
