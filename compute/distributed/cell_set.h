// The cells of a grid in which a rank has bodies, to be sent to another that asks which of its own are near.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "compute/distributed/packing.h"
#include "shaders/physics/collide/grid.h"

namespace scree {

class CellSet {
public:
    explicit CellSet(float inverse_cell) : inverse_cell_(inverse_cell), slots_(256, empty) {}
    CellSet(float inverse_cell, const Bytes& bytes) : CellSet(inverse_cell) {
        Unpacker from(bytes);
        auto boxes = from.take<std::uint64_t>();
        while (boxes-- > 0) {
            const auto lower = from.take<physics::vec3>();
            boxes_.emplace_back(lower, from.take<physics::vec3>());
        }
        while (from.has_more()) insert(from.take<std::uint64_t>());
    }
    void add(physics::vec3 lower, physics::vec3 upper) {
        if (is_wide(lower, upper))
            boxes_.emplace_back(lower, upper);
        else
            for_each_cell(lower, upper, [&](std::uint64_t key) {
                insert(key);
                return false;
            });
    }
    // Whether a box may overlap one of those added; true whenever it does.
    bool meets(physics::vec3 lower, physics::vec3 upper) const {
        if (is_wide(lower, upper)) return true;
        for (const auto& [from, to] : boxes_)
            if (physics::boxes_overlap(lower, upper, from, to)) return true;
        return for_each_cell(lower, upper, [&](std::uint64_t key) { return slots_[slot_of(key)] == key; });
    }
    Bytes bytes() const {
        Bytes all;
        put(all, static_cast<std::uint64_t>(boxes_.size()));
        for (const auto& [lower, upper] : boxes_) {
            put(all, lower);
            put(all, upper);
        }
        for (const std::uint64_t key : slots_)
            if (key != empty) put(all, key);
        return all;
    }

private:
    static constexpr std::uint64_t empty = ~std::uint64_t{0};
    // Boxes over more cells than this along an axis are kept as boxes.
    static constexpr float widest = 6;

    bool is_wide(physics::vec3 lower, physics::vec3 upper) const {
        const physics::vec3 cells = (upper - lower) * inverse_cell_;
        return !(cells.x <= widest && cells.y <= widest && cells.z <= widest);
    }
    template <class Visit>  // until it returns true; whether it did
    bool for_each_cell(physics::vec3 lower, physics::vec3 upper, const Visit& visit) const {
        const physics::ivec3 first = physics::cell_at(lower, 0, inverse_cell_), last = physics::cell_at(upper, 0, inverse_cell_);
        // Cells 2,097,152 apart share a key: that costs a ghost, no more.
        const auto part = [](int cell) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell) & 0x1FFFFFu); };
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x)
                    if (visit(part(x) | part(y) << 21 | part(z) << 42)) return true;
        return false;
    }
    std::size_t slot_of(std::uint64_t key) const {
        // The upper bits of the product alone depend on all of the key.
        std::size_t slot = (key * 0x9E3779B97F4A7C15u) >> (std::countl_zero(slots_.size()) + 1);
        while (slots_[slot] != empty && slots_[slot] != key) slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }
    void insert(std::uint64_t key) {
        std::uint64_t& slot = slots_[slot_of(key)];
        if (slot == key) return;
        slot = key;
        if (2 * ++count_ < slots_.size()) return;
        std::vector<std::uint64_t> before(2 * slots_.size(), empty);
        before.swap(slots_);
        for (const std::uint64_t one : before)
            if (one != empty) slots_[slot_of(one)] = one;
    }

    float inverse_cell_;
    std::vector<std::uint64_t> slots_;
    std::size_t count_ = 0;
    std::vector<std::pair<physics::vec3, physics::vec3>> boxes_;
};

}  // namespace scree
