// Frames of a recording.
#include "demos/film/pages/frame_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace scree::demos {

namespace {

using Three = std::array<std::int32_t, 3>;

double largest_power_below(double value) {
    return std::exp2(std::floor(std::log2(value)));
}

// The unit nearest to a value, given in units.
std::int32_t nearest_unit(double value) {
    constexpr double most = FrameUnits::most;
    if (!(value > -most)) return -FrameUnits::most;  // not a number, too
    return static_cast<std::int32_t>(std::lround(std::min(value, most)));
}
// `expected`, unless the value is too far from it.
std::int32_t kept_or_nearest_unit(double value, std::int32_t expected, double slack) {
    return std::abs(value - expected) <= slack ? expected : nearest_unit(value);
}

Three nearest_units(glm::vec3 value, double unit) {
    return {nearest_unit(static_cast<double>(value.x) / unit), nearest_unit(static_cast<double>(value.y) / unit),
            nearest_unit(static_cast<double>(value.z) / unit)};
}
Three kept_or_nearest_units(glm::vec3 value, double unit, const Three& expected, double slack) {
    Three made;
    for (std::size_t i = 0; i < 3; ++i)
        made[i] = kept_or_nearest_unit(static_cast<double>(value[static_cast<glm::length_t>(i)]) / unit, expected[i], slack);
    return made;
}
// In steps of up to a change that is no fall, so that few distinct numbers are told.
Three coarse_units(glm::vec3 value, const FrameUnits& units, const Three& before, const Three& expected, const Three& told) {
    std::int32_t most = 0, step = 1;
    bool falls = true;
    for (std::size_t i = 0; i < 3; ++i) {
        most = std::max(most, std::abs(told[i] - expected[i]));
        falls = falls && std::abs(told[i] - before[i] - units.fall[i]) <= 2;
    }
    while (step < FrameUnits::coarse_velocity && 2 * step <= most) step *= 2;
    if (falls || step == 1) return told;
    Three made;
    for (std::size_t i = 0; i < 3; ++i) {
        const double way = static_cast<double>(value[static_cast<glm::length_t>(i)]) / units.velocity - expected[i];
        made[i] = nearest_unit(expected[i] + step * std::round(way / step));
    }
    return made;
}

// The turn from one orientation to another: twice the half angle's tangent along the axis in the body's frame, in units.
std::array<double, 3> turn_between(const std::array<double, 4>& q, glm::vec4 to, double unit) {
    const double x = static_cast<double>(to.x), y = static_cast<double>(to.y), z = static_cast<double>(to.z),
                 w = static_cast<double>(to.w);
    double rx = q[3] * x - q[0] * w - q[1] * z + q[2] * y, ry = q[3] * y - q[1] * w - q[2] * x + q[0] * z,
           rz = q[3] * z - q[2] * w - q[0] * y + q[1] * x, rw = q[3] * w + q[0] * x + q[1] * y + q[2] * z;
    if (rw < 0) rx = -rx, ry = -ry, rz = -rz, rw = -rw;
    rw = std::max(rw, 1e-4) * unit;
    return {rx / rw, ry / rw, rz / rw};
}

// The largest component is left out: its place, and the others in units.
struct SmallestThree {
    std::uint32_t largest = 3;
    Three others{};
    explicit SmallestThree(glm::vec4 q) {
        for (std::uint32_t i = 0; i < 4; ++i)
            if (std::abs(q[static_cast<int>(i)]) > std::abs(q[static_cast<int>(largest)])) largest = i;
        const double sign = q[static_cast<int>(largest)] < 0 ? -1 : 1;
        std::size_t k = 0;
        for (std::uint32_t i = 0; i < 4; ++i)
            if (i != largest)
                others[k++] = nearest_unit(sign * static_cast<double>(q[static_cast<int>(i)]) / FrameUnits::orientation);
    }
    std::array<double, 4> orientation() const {
        const double a = others[0] * FrameUnits::orientation, b = others[1] * FrameUnits::orientation,
                     c = others[2] * FrameUnits::orientation;
        const double rest = std::sqrt(std::max(0.0, 1 - ((a * a + b * b) + c * c)));
        std::array<double, 4> q{};
        const std::array<double, 3> given{a, b, c};
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i) q[i] = i == largest ? rest : given[k++];
        return q;
    }
};

// Integers that lie side by side by what they mean, so that like stands beside like.
class Columns {
public:
    explicit Columns(std::size_t count) : columns_(count) {}
    void add(std::size_t column, std::int32_t value) { columns_[column].integer(value); }
    void add(std::size_t first, const Three& values) {
        for (std::size_t i = 0; i < 3; ++i) columns_[first + i].integer(values[i]);
    }
    void put(ChunkBytes& to) const {
        for (const ChunkBytes& column : columns_) to.part(column);
    }

private:
    std::vector<ChunkBytes> columns_;
};

Three difference(const Three& a, const Three& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The places at which something changed: their number, and the way from each to the next.
void put_places(ChunkBytes& to, const std::vector<std::uint32_t>& places) {
    to.count(places.size());
    std::uint32_t before = 0;
    for (const std::uint32_t place : places) {
        to.count(place - before);
        before = place;
    }
}

}  // namespace

FrameUnits FrameUnits::of(double radius, double reach, double seconds, glm::dvec3 gravity, double least_force, bool crowd) {
    FrameUnits units;
    units.crowd = crowd;
    if (crowd) {  // larger units and less slack: fewer bits where everything changes, more where little does
        units.slack /= 1.5;
        units.turn *= 1.5;
    }
    const double finest = 4 * reach / most;  // bodies may leave the scene by as much again
    units.position = largest_power_below(std::clamp(radius / 512, std::max(finest, 1e-6), 1e3)) * (crowd ? 1.5 : 1);
    units.velocity = 2 * units.position / (seconds * parts);
    // Gravity adds a whole number of units, so that free flight needs no correction.
    const double added = glm::length(gravity) * seconds;
    if (const double count = std::ceil(added / units.velocity); count >= 1 && count < most) {
        units.velocity = added / count;
        units.position = units.velocity * seconds * parts / 2;
    }
    for (std::size_t i = 0; i < 3; ++i)
        units.fall[i] = nearest_unit(gravity[static_cast<glm::length_t>(i)] * seconds / units.velocity);
    units.force = std::max(least_force, 1e-30);
    return units;
}

double FrameUnits::angle_error() const {
    return 2 * slack * turn * std::sqrt(3.0);
}
double FrameUnits::force_error() {
    return std::exp2(level_slack / levels_per_octave) - 1;
}

Three Follower::expected_velocity(const FrameUnits& units) const {
    if (!falls) return velocity;
    return {velocity[0] + units.fall[0], velocity[1] + units.fall[1], velocity[2] + units.fall[2]};
}

Three Follower::expected_position(const Three& new_velocity) const {
    Three made;
    for (std::size_t i = 0; i < 3; ++i) made[i] = position[i] + velocity[i] + new_velocity[i];
    return made;
}

void Follower::advance(const FrameUnits& units, const Three& new_velocity, const Three& new_position, const Three& new_turn) {
    bool falling = units.fall != Three{};
    for (std::size_t i = 0; i < 3; ++i) falling = falling && std::abs(new_velocity[i] - velocity[i] - units.fall[i]) <= 2;
    falls = falling;
    velocity = new_velocity;
    position = new_position;
    turn = new_turn;
    if (turn == Three{}) return;
    const double ux = turn[0] * units.turn, uy = turn[1] * units.turn, uz = turn[2] * units.turn;
    const double x = orientation[0], y = orientation[1], z = orientation[2], w = orientation[3];
    const double rx = ((w * ux + x) + y * uz) - z * uy, ry = ((w * uy + y) + z * ux) - x * uz,
                 rz = ((w * uz + z) + x * uy) - y * ux, rw = ((w - x * ux) - y * uy) - z * uz;
    const double length = std::sqrt(((rx * rx + ry * ry) + rz * rz) + rw * rw);
    orientation = {rx / length, ry / length, rz / length, rw / length};
}

void LevelTrack::encode(ChunkBytes& to, std::span<const float> values, double least, bool whole,
                        std::optional<std::uint32_t> turn) {
    told_.resize(values.size());
    if (whole) std::fill(told_.begin(), told_.end(), 0);
    BitRow changed;
    ChunkBytes levels;
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::int32_t& told = told_[i];
        std::int32_t now = 0;
        if (turn && !whole && i % FrameUnits::forces_apart != *turn) {
            now = told;
        } else if (static_cast<double>(values[i]) >= least) {  // not for what is no number
            const double at = 1 + FrameUnits::levels_per_octave * std::log2(static_cast<double>(values[i]) / least);
            now = told > 0 ? kept_or_nearest_unit(at, told, FrameUnits::level_slack) : nearest_unit(at);
        }
        changed.add(now != told);
        if (now != told) levels.integer(now - told);
        told = now;
    }
    to.part(changed.row);
    to.part(levels);
}

void FrameEncoder::encode(ChunkBytes& to, std::span<const BodyMoment> bodies, bool whole) {
    followers_.resize(std::max(followers_.size(), bodies.size()));
    std::vector<std::uint32_t> came_or_went, slept_or_woke, fresh;
    std::vector<bool> told(bodies.size(), false);
    std::vector<Follower> before;
    if (whole) {  // readers may know nothing
        before = std::move(followers_);
        followers_.assign(before.size(), {});
    }
    force_values_.assign(bodies.size(), 0);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
        const BodyMoment& body = bodies[i];
        Follower& follower = followers_[i];
        if (body.exists != follower.exists) {
            came_or_went.push_back(i);
            if (body.exists) {
                fresh.push_back(i);
                told[i] = true;
            }
            follower.exists = body.exists;
        }
        if (body.asleep != follower.asleep) slept_or_woke.push_back(i);
        follower.asleep = body.asleep;
        if (body.exists) force_values_[i] = body.force;
    }
    to.count(bodies.size());
    put_places(to, came_or_went);
    put_places(to, slept_or_woke);
    tell_whole(to, bodies, fresh, before);
    tell_changes(to, bodies, told);
    turn_ = (turn_ + 1) % FrameUnits::forces_apart;
    forces_.encode(to, force_values_, units_.force, whole, short_ ? std::optional(turn_) : std::nullopt);
}

void FrameEncoder::tell_whole(ChunkBytes& to, std::span<const BodyMoment> bodies, const std::vector<std::uint32_t>& which,
                              const std::vector<Follower>& known) {
    Columns columns(13);
    Three before{};
    for (const std::uint32_t i : which) {
        Follower& follower = followers_[i];
        const Three velocity = nearest_units(bodies[i].velocity, units_.velocity),
                    position = nearest_units(bodies[i].position, units_.position);
        Three turn{};
        follower.falls = false;
        if (i < known.size() && known[i].exists) {  // the next frame is expected to go on like the last
            follower.velocity = known[i].velocity;
            const std::array<double, 3> exact = turn_between(known[i].orientation, bodies[i].orientation, units_.turn);
            turn = {nearest_unit(exact[0]), nearest_unit(exact[1]), nearest_unit(exact[2])};
            follower.advance(units_, velocity, position, {});
        }
        follower.velocity = velocity;
        for (std::size_t k = 0; k < 3; ++k) follower.position[k] = FrameUnits::parts * position[k];
        follower.turn = turn;
        const SmallestThree three(bodies[i].orientation);
        follower.orientation = three.orientation();
        columns.add(0, follower.velocity);
        columns.add(3, difference(position, before));
        columns.add(6, follower.turn);
        columns.add(9, static_cast<std::int32_t>(2 * three.largest + (follower.falls ? 1 : 0)));
        columns.add(10, three.others);
        before = position;
    }
    columns.put(to);
}

void FrameEncoder::tell_changes(ChunkBytes& to, std::span<const BodyMoment> bodies, const std::vector<bool>& told) {
    Columns columns(9);
    BitRow changed;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Follower& follower = followers_[i];
        if (!follower.exists || told[i]) continue;
        const Three expected_velocity = follower.expected_velocity(units_);
        Three velocity = kept_or_nearest_units(bodies[i].velocity, units_.velocity, expected_velocity, units_.slack);
        if (short_) velocity = coarse_units(bodies[i].velocity, units_, follower.velocity, expected_velocity, velocity);
        const Three expected_position = follower.expected_position(velocity);
        Three of_position, position;
        for (std::size_t k = 0; k < 3; ++k) {  // told in whole units
            const double exact_position =
                static_cast<double>(bodies[i].position[static_cast<glm::length_t>(k)]) / units_.position;
            const double wrong = exact_position - expected_position[k] / static_cast<double>(FrameUnits::parts);
            of_position[k] = kept_or_nearest_unit(wrong, 0, units_.slack);
            position[k] = expected_position[k] + FrameUnits::parts * of_position[k];
        }
        const std::array<double, 3> exact = turn_between(follower.orientation, bodies[i].orientation, units_.turn);
        Three turn;
        for (std::size_t k = 0; k < 3; ++k) turn[k] = kept_or_nearest_unit(exact[k], follower.turn[k], units_.slack);
        const Three of_velocity = difference(velocity, expected_velocity), of_turn = difference(turn, follower.turn);
        const bool differs = of_velocity != Three{} || of_position != Three{} || of_turn != Three{};
        changed.add(differs);
        if (differs) {
            columns.add(0, of_velocity);
            columns.add(3, of_position);
            columns.add(6, of_turn);
        }
        follower.advance(units_, velocity, position, turn);
    }
    to.part(changed.row);
    columns.put(to);
}

}  // namespace scree::demos
