// What happened in the steps since one last looked: bodies that began and ceased to touch, hit each other, broke, fell
// asleep or woke; and all contacts of the last step at once.
//
//     world.set_events({.contacts = true, .hit_speed = 1});
//     world.step(60);
//     for (const scree::Event& event : world.take_events())
//         if (event.kind == scree::EventKind::hit) ...
//
// Ordered by step, kind, bodies and parts, and equal on every backend. None is lost: every begin has one end, also when a
// body is removed, breaks or is put elsewhere. Sleep ends no contact.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace scree {

enum class EventKind : std::uint8_t {
    begin,         // of two parts: the first step in which they pressed on each other
    end,           // they are apart; or one of them is gone
    hit,           // they pressed on each other, as they did not in the step before, faster than EventSettings::hit_speed
    body_broke,    // a: the body; its fragments are there from now on
    joint_broke,   // joint: its index; a and b: its bodies
    fell_asleep,   // a
    woke,          // a
    sensor_begin,  // a: a sensor, part_a: its part; b, part_b: what began to overlap it in the step
    sensor_end,    // they overlap no more; or one of them is gone
    bond_broke,    // joint: the index of the bond; a and b: its bodies
};

struct EventSettings {
    bool contacts = false;    // begin and end
    float hit_speed = 1e30f;  // m/s, least approach speed of a hit, >= 0; needs contacts
    bool breaks = false;      // body_broke, joint_broke and bond_broke
    bool sleep = false;       // fell_asleep and woke
    bool sensors = false;     // sensor_begin and sensor_end
    bool any() const { return contacts || breaks || sleep || sensors; }
    bool operator==(const EventSettings& o) const {
        return contacts == o.contacts && hit_speed == o.hit_speed && breaks == o.breaks && sleep == o.sleep &&
               sensors == o.sensors;
    }
};

// A sensor (Role::sensor) and a solid part that overlaps it, awake or asleep, of any motion; of a fixed sensor only what is
// not fixed, and what its filter admits.
struct SensorOverlap {
    std::uint32_t sensor = 0, sensor_part = 0;  // body; part of a compound, else 0
    std::uint32_t body = 0, part = 0;           // likewise; the triangles of a mesh count as one part
    auto operator<=>(const SensorOverlap&) const = default;
};

struct Event {
    std::uint64_t step = 0;  // the number of steps done after the one in which it happened
    EventKind kind = EventKind::begin;
    // Bodies by index and generation (BodyHandle): of pairs that touch a is the lower index. Of the world in place of a body the
    // index is all ones.
    std::uint32_t a = 0, a_generation = 0, b = 0, b_generation = 0;
    std::uint32_t part_a = 0, part_b = 0;  // of compounds; else 0. The triangles of a mesh count as one part
    std::uint32_t joint = 0;
    float speed = 0;      // of a hit: approach along the normal before the step, m/s
    float impulse = 0;    // of a begin or a hit: normal impulse in the step, N s
    glm::vec3 point{0};   // of a begin or a hit: middle of the contact, m
    glm::vec3 normal{0};  // of a begin or a hit: unit, from a to b
};

// A contact of the last step, touching or speculative. Of a compound or mesh two bodies may have several.
struct ContactState {
    struct Point {
        glm::vec3 position{0};  // m, midway between the surfaces
        float separation = 0;   // m, < 0: the bodies overlap
        float force = 0;        // normal force in the last substep, N
    };
    std::size_t a = 0, b = 0;              // bodies
    std::uint32_t part_a = 0, part_b = 0;  // of compounds the part, of meshes and height fields the triangle
    glm::vec3 normal{0};                   // unit, from a to b
    glm::vec3 friction{0};                 // on b, in the last substep, N
    std::uint32_t count = 0;               // points
    std::array<Point, 4> points{};
};

}  // namespace scree
