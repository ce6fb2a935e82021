// Poses and velocities of many bodies as frames of a recording: quantised, and told as differences from what readers expect.
//
// Readers repeat the arithmetic of Follower bit for bit: integers, and doubles that are added, multiplied, divided and rooted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "demos/film/pages/chunk_bytes.h"

namespace scree::demos {

// What a unit of each number is. A value is told again where readers would be off by more than `slack` units.
struct FrameUnits {
    static constexpr std::int32_t parts = 8;             // of a told unit of position, in which readers go on
    static constexpr double orientation = 1.0 / 8192;    // of a quaternion's component
    static constexpr double levels_per_octave = 8;       // of forces
    static constexpr std::int32_t most = 1 << 26;        // units of any number
    static constexpr double level_slack = 0.75;          // of levels of forces
    static constexpr std::int32_t coarse_velocity = 64;  // units: largest step of velocities in short frames
    static constexpr std::uint32_t forces_apart = 8;     // short frames tell the forces of each eighth body, in turn

    bool crowd = false;  // of so many bodies that frames may have to be short
    double slack = 0.75;
    double turn = 1.0 / 2048;            // tangent of half the angle
    double position = 1.0 / 1024;        // m
    double velocity = 1.0 / 128;         // m/s: half a frame at this is a part of a unit of position
    std::array<std::int32_t, 3> fall{};  // what gravity adds to a velocity from one frame to the next
    double force = 1e-3;                 // N, the least that is not 0

    double part() const { return position / parts; }
    // Units for bodies of this bounding radius, within this distance of the origin, m; frames are `seconds` apart.
    // A crowd's poses have the same errors.
    static FrameUnits of(double radius, double reach, double seconds, glm::dvec3 gravity, double force, bool crowd = false);

    // Greatest errors of a frame: m and m/s along an axis; rad; a ratio minus 1. Of a crowd those of short frames.
    double position_error() const { return slack * position; }
    double velocity_error() const { return (crowd ? 0.5 * coarse_velocity : slack) * velocity; }
    double angle_error() const;
    static double force_error();
};

struct BodyMoment {
    bool exists = false, asleep = false;
    glm::vec3 position{0};              // m
    glm::vec4 orientation{0, 0, 0, 1};  // unit quaternion
    glm::vec3 velocity{0};              // m/s
    float force = 0;                    // N
};

// What a reader knows of a body after a frame.
struct Follower {
    bool exists = false, asleep = false, falls = false;
    std::array<std::int32_t, 3> velocity{}, position{}, turn{};  // of position parts
    std::array<double, 4> orientation{0, 0, 0, 1};

    std::array<std::int32_t, 3> expected_velocity(const FrameUnits& units) const;
    std::array<std::int32_t, 3> expected_position(const std::array<std::int32_t, 3>& new_velocity) const;
    void advance(const FrameUnits& units, const std::array<std::int32_t, 3>& new_velocity,
                 const std::array<std::int32_t, 3>& new_position, const std::array<std::int32_t, 3>& new_turn);
};

// Values such as forces by levels of a logarithmic scale; level 0 is nothing.
class LevelTrack {
public:
    // `turn`: of so many of FrameUnits::forces_apart values alone; of others what was told stays.
    void encode(ChunkBytes& to, std::span<const float> values, double least, bool whole, std::optional<std::uint32_t> turn = {});

private:
    std::vector<std::int32_t> told_;
};

class FrameEncoder {
public:
    explicit FrameEncoder(const FrameUnits& units) : units_(units) {}
    // Appends the bodies of a frame. `whole`: readers may begin here.
    void encode(ChunkBytes& to, std::span<const BodyMoment> bodies, bool whole);
    // Later frames are short: velocities that change much in larger steps, forces in turn. Poses are as exact as ever.
    void set_short(bool on) { short_ = on; }
    bool is_short() const { return short_; }
    const std::vector<Follower>& followers() const { return followers_; }

private:
    void tell_whole(ChunkBytes& to, std::span<const BodyMoment> bodies, const std::vector<std::uint32_t>& which,
                    const std::vector<Follower>& known);
    void tell_changes(ChunkBytes& to, std::span<const BodyMoment> bodies, const std::vector<bool>& told);

    FrameUnits units_;
    bool short_ = false;
    std::uint32_t turn_ = 0;  // of forces in short frames
    std::vector<Follower> followers_;
    LevelTrack forces_;
    std::vector<float> force_values_;
};

}  // namespace scree::demos
