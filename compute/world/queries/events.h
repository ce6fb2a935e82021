// Events of a world: compares the contacts, bodies and joints of a step with those of the step before.
#pragma once

#include <compare>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "compute/events.h"
#include "compute/parallel/threads.h"
#include "compute/scene.h"
#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"
#include "compute/world/states/byte_stream.h"

namespace scree {

class Events {
public:
    // From the present state on: pairs that touch already begin with the next step.
    void set(const EventSettings& settings, const Scene& scene, const State& state);
    const EventSettings& settings() const { return settings_; }
    TableRanges needed(const Scene& scene, const State& state) const;  // from the runner, after each step
    void before_step(const State& state);
    // `arrangement`: a number that changes with the rows of bodies.
    void after_step(const Scene& scene, const State& state, const std::vector<std::uint32_t>& generations,
                    std::uint64_t arrangement, std::uint64_t step, const Threads& threads);
    // Before bodies are removed: ends their contacts. `gone`: ascending.
    void end_contacts_of(const std::vector<std::size_t>& gone, const State& state, const std::vector<std::uint32_t>& generations,
                         std::uint64_t step);
    void note_joints(const Scene& scene, const State& state);  // their indices have changed
    void forget_joint(std::size_t joint);                      // it is removed
    std::vector<Event> take();

    void put(ByteWriter& out) const;
    void restore(ByteReader& in);
    // Whether restored contacts are of rows that there are.
    bool fits(std::uint32_t rows, std::uint32_t first_part) const;

private:
    // A contact of two rows.
    struct Entry {
        std::uint64_t place = 0;           // owner's row, other's id: ascending in the order of contacts
        std::uint32_t id_a = 0, id_b = 0;  // of the rows
        std::uint16_t owned_by_a = 0;
        std::uint8_t touches = 0;  // has pressed since it is there
        std::uint8_t pressed = 0;  // in the last step
        std::uint32_t contact = 0;
    };
    // Two parts.
    struct Pair {
        std::uint32_t a = 0, b = 0, part_a = 0, part_b = 0;
        auto operator<=>(const Pair&) const = default;
    };
    struct HashOfPair {
        std::size_t operator()(const Pair& pair) const;
    };
    using Pairs = std::unordered_set<Pair, HashOfPair>;
    struct Seen;  // what after_step sees

    void list_contacts(const Seen& seen, const Threads& threads);
    void rearrange(const State& state);
    void match(const Seen& seen);
    void compare_bodies(const Seen& seen);
    void compare_joints(const Seen& seen);
    void compare_bonds(const Seen& seen);
    void compare_sensors(const Seen& seen, const Threads& threads);
    void tell_sensor(EventKind kind, const SensorOverlap& one, const std::vector<std::uint32_t>& generations, std::uint64_t step);
    Pair pair_of(const Entry& entry, const State& state) const;
    void add(const Pair& pair, const Entry& entry, const Seen& seen);
    void drop(const Pair& pair, const std::vector<std::uint32_t>& generations, std::uint64_t step);
    void hit(const Pair& pair, const Entry& entry, const Seen& seen, Pairs& told);
    Event event_of(EventKind kind, const Pair& pair, const std::vector<std::uint32_t>& generations, std::uint64_t step) const;
    void describe(Event& event, const Entry& entry, const State& state) const;
    void find_parts(const State& state);

    EventSettings settings_;
    std::vector<Event> events_;
    std::vector<Entry> before_, now_;
    std::unordered_map<Pair, std::uint32_t, HashOfPair> pairs_;  // that touch, and in how many contacts
    std::vector<physics::Velocity> velocities_;                  // before the step
    std::vector<physics::Pose> poses_;                           // likewise, if there are sensors
    std::vector<std::uint8_t> bodies_;                           // by id
    std::vector<std::uint8_t> joints_;                           // by joint of the scene: broken
    std::vector<std::uint8_t> bonds_;                            // broken
    std::vector<SensorOverlap> sensed_;
    std::vector<std::uint32_t> part_numbers_;  // by part row behind the first
    std::uint32_t first_part_ = 0;
    std::uint64_t arrangement_ = 0;
};

}  // namespace scree
