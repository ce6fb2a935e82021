// Energy, momentum, contacts and step times over the last minute, of the world or of one body.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"

namespace scree::demos {

class History {
public:
    enum Series { kinetic, potential, total, momentum, contacts, step_ms };
    static constexpr std::size_t count = 6;
    static const std::array<const char*, count> names;
    static const std::array<const char*, count> units;

    // Takes a sample if a twentieth of a simulated second has passed, or less often in large worlds. Begins anew when
    // the body or the world (`beginning`) changes, or time runs backwards.
    void look(const World& world, std::optional<std::size_t> body, std::uint64_t beginning, double milliseconds_a_step);

    const std::vector<float>& times() const { return times_; }  // s
    const std::vector<float>& of(Series series) const { return values_[series]; }
    std::string csv() const;  // a heading with units, then a line per sample

private:
    std::vector<float> times_;
    std::array<std::vector<float>, count> values_;
    std::optional<std::size_t> body_;
    std::uint64_t beginning_ = 0;
};

}  // namespace scree::demos
