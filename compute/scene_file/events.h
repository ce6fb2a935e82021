// Timed events of a scene file: what acts on the world at given moments of a run. The simulation itself knows none; a
// run performs them before the step whose start is nearest.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "compute/grains.h"
#include "compute/world.h"

namespace scree {

struct ImpulseEvent {  // see World::apply_impulse
    std::size_t body = no_body;
    vec3 impulse{0};  // N s
    vec3 offset{0};   // m, of its point from the centre of mass
};
struct VelocityEvent {  // dynamic and kinematic bodies
    std::size_t body = no_body;
    vec3 linear{0};   // m/s
    vec3 angular{0};  // rad/s
};
// Moves a kinematic body to a pose within a time at constant velocities, and stops it there.
struct GlideEvent {
    std::size_t body = no_body;
    vec3 to{0};          // m, of the centre of mass
    vec3 turn{0};        // rad, rotation vector about world axes
    float duration = 1;  // s
};
struct ExplosionEvent {  // see World::explode
    vec3 centre{0};      // m
    float radius = 1;    // m
    float speed = 0;     // m/s
};
struct ReleaseEvent {  // removes a joint
    std::size_t joint = no_body;
};
struct MotorEvent {  // the motor of a hinge or slider
    std::size_t joint = no_body;
    float speed = 0;      // rad/s or m/s
    float max_force = 0;  // N m or N
};
struct GravityEvent {
    vec3 gravity{0, -9.81f, 0};  // m/s^2
};

// Pours grains from its time on, in bursts, until all are there (see Grains). A grain for which there is no room waits, and those
// behind it. The names of the bodies say how many have come, so that a world that was restored goes on as it would have.
struct PourEvent {
    Grains grains{};
};

// Swings a kinematic body along a way and back, as a sine, and does not turn it: sieves, shakers.
struct ShakeEvent {
    std::size_t body = no_body;
    vec3 way{0};          // m, from where it is to where it turns back
    float frequency = 1;  // Hz, at most an eighth of the steps in a second
    float duration = 0;   // s, after which it stops; 0: never
    float phase = 0;      // part of a period that has passed when it begins, 0 to 1
};

using EventAction = std::variant<ImpulseEvent, VelocityEvent, GlideEvent, ExplosionEvent, ReleaseEvent, MotorEvent, GravityEvent,
                                 PourEvent, ShakeEvent>;

struct TimedEvent {
    float time = 0;  // s
    EventAction action = ImpulseEvent{};
};

// Throws SceneError, with the JSON pointer of the event, for bodies and joints that do not exist or cannot do it.
void check_events(const std::vector<TimedEvent>& events, const Scene& scene);

// The name of the bodies of grains that are poured, without their number.
std::string name_of_poured(const Grains& grains);

// Performs the events due before the world's next step, in their order. Joints keep their numbers of the scene, however
// many were released before. Throws SceneError with the JSON pointer of the event.
void perform_due(const std::vector<TimedEvent>& events, World& world);

// The events that are still to come, for a scene that starts as World::snapshot() shows this world: times count from
// now. None if bodies have broken, since the snapshot numbers them anew.
std::vector<TimedEvent> coming_events(const std::vector<TimedEvent>& events, const World& world);

}  // namespace scree
