// Filters by pairs of groups: which of up to 32 groups of bodies collide with which.
//
//     scree::FilterGroups groups;
//     groups.separate(debris, debris);  // pieces pass through each other
//     body.filter = groups.filter_of(debris);
//
// Bodies without a filter are of group 0. Single pairs of bodies: Scene::exclusions, World::set_exclusion.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "compute/shapes.h"

namespace scree {

class FilterGroups {
public:
    static constexpr int count = 32;

    // Groups all collide at first. Filters that were given before do not change. Throw std::out_of_range for a group.
    void separate(int a, int b) { set(a, b, false); }
    void unite(int a, int b) { set(a, b, true); }
    bool collide(int a, int b) const { return (masks_[checked(a)] >> checked(b) & 1u) != 0; }
    Filter filter_of(int group) const { return {.category = 1u << checked(group), .mask = masks_[checked(group)]}; }

private:
    static std::uint32_t checked(int group) {
        if (group < 0 || group >= count) throw std::out_of_range("group " + std::to_string(group) + " is not 0 to 31");
        return static_cast<std::uint32_t>(group);
    }
    void set(int a, int b, bool collide) {
        for (const auto& [own, other] : {std::array{checked(a), checked(b)}, std::array{checked(b), checked(a)}}) {
            const std::uint32_t bit = 1u << other;
            masks_[own] = collide ? masks_[own] | bit : masks_[own] & ~bit;
        }
    }

    std::array<std::uint32_t, count> masks_ = [] {
        std::array<std::uint32_t, count> all;
        all.fill(0xFFFFFFFFu);
        return all;
    }();
};

}  // namespace scree
