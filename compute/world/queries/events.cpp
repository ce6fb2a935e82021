// Events of a world.
#include "compute/world/queries/events.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "compute/world/queries/sensors.h"
#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

// Of a body, in bodies_.
constexpr std::uint8_t there = 1, asleep = 2;

std::uint32_t generation_of(const std::vector<std::uint32_t>& generations, std::uint32_t body) {
    return body < generations.size() ? generations[body] : 0;
}

bool happens_before(const Event& x, const Event& y) {
    const auto order = [](const Event& e) { return std::tuple(e.step, e.kind, e.a, e.b, e.part_a, e.part_b, e.joint); };
    return order(x) < order(y);
}

template <class Visit>
void for_each_value(auto& e, const Visit& visit) {
    visit(e.step), visit(e.kind), visit(e.a), visit(e.a_generation), visit(e.b), visit(e.b_generation), visit(e.part_a);
    visit(e.part_b), visit(e.joint), visit(e.speed), visit(e.impulse), visit(e.point), visit(e.normal);
}

bool may_break(const Scene& scene) {
    return std::any_of(scene.joints.begin(), scene.joints.end(), [](const Joint& joint) {
        return joint.break_force < unlimited || joint.break_torque < unlimited || joint.broken;
    });
}

}  // namespace

struct Events::Seen {
    const Scene& scene;
    const State& state;
    const std::vector<std::uint32_t>& generations;
    std::uint64_t step;
};

void Events::set(const EventSettings& settings, const Scene& scene, const State& state) {
    settings_ = settings;
    before_.clear();
    pairs_.clear();
    bodies_.clear();
    joints_.clear();
    sensed_.clear();
    if (settings_.breaks) note_joints(scene, state);
    bonds_.clear();
    if (settings_.breaks) bonds_.assign(state.bond_states.begin(), state.bond_states.end());
    if (!settings_.any()) return;
    const std::vector<std::uint32_t> none;
    compare_bodies({scene, state, none, 0});  // notes them
    first_part_ = ~0u;
}

void Events::before_step(const State& state) {
    velocities_ = state.velocities;
    poses_.clear();
    if (settings_.sensors && has_sensors(state)) poses_ = poses_before(state);
}

TableRanges Events::needed(const Scene& scene, const State& state) const {
    TableRanges ranges = body_ranges(state);
    if (settings_.contacts) {
        const std::size_t contacts = state.live(BufferLength::contacts);
        append(ranges, {{Table::contacts, 0, contacts},
                        {Table::carried, 0, contacts},
                        {Table::first_contacts, 0, state.fixed().bodies + 1}});
    }
    if (settings_.breaks && may_break(scene)) append(ranges, joint_ranges(state));
    if (settings_.breaks) append(ranges, bond_ranges(state));
    return ranges;
}

void Events::after_step(const Scene& scene, const State& state, const std::vector<std::uint32_t>& generations,
                        std::uint64_t arrangement, std::uint64_t step, const Threads& threads) {
    const Seen seen{scene, state, generations, step};
    const std::size_t first = events_.size();
    if (settings_.contacts) {
        if (arrangement != arrangement_ || state.fixed().first_part != first_part_) rearrange(state);
        arrangement_ = arrangement;
        list_contacts(seen, threads);
        match(seen);
        before_.swap(now_);
    }
    compare_bodies(seen);
    if (settings_.breaks) compare_joints(seen);
    if (settings_.breaks) compare_bonds(seen);
    if (settings_.sensors) compare_sensors(seen, threads);
    std::sort(events_.begin() + static_cast<std::ptrdiff_t>(first), events_.end(), happens_before);
}

// ---- contacts
// Numbers of parts within their bodies; the triangles of a mesh count as one.
void Events::find_parts(const State& state) {
    const physics::Parameters& p = state.fixed();
    part_numbers_.assign(p.bodies - p.first_part, 0);
    for (std::uint32_t k = 1; k < part_numbers_.size(); ++k) {
        const physics::BodyProperties& row = state.properties[p.first_part + k];
        if (row.owner == state.properties[p.first_part + k - 1].owner && row.shape != physics::SHAPE_TRIANGLE)
            part_numbers_[k] = part_numbers_[k - 1] + 1;
    }
}

// The rows of bodies or parts have changed: ids of parts move with the first part's row.
void Events::rearrange(const State& state) {
    const std::uint32_t first = state.fixed().first_part, moved = first_part_ == ~0u ? 0 : first - first_part_;
    for (Entry& entry : before_) {
        for (std::uint32_t* id : {&entry.id_a, &entry.id_b})
            if (*id >= first_part_) *id += moved;
        const std::uint32_t owner = entry.owned_by_a ? entry.id_a : entry.id_b,
                            other = entry.owned_by_a ? entry.id_b : entry.id_a;
        entry.place = std::uint64_t{owner < first ? state.row_of(owner) : owner} << 32 | other;
    }
    std::sort(before_.begin(), before_.end(), [](const Entry& x, const Entry& y) { return x.place < y.place; });
    first_part_ = first;
    find_parts(state);
}

void Events::list_contacts(const Seen& seen, const Threads& threads) {
    const State& state = seen.state;
    const std::uint32_t sleep_steps = state.fixed().sleep_steps, contacts = state.counted().contacts;
    if (part_numbers_.size() != state.fixed().bodies - state.fixed().first_part) find_parts(state);
    const auto movable = [&](std::uint32_t row) {
        const std::uint32_t body = state.body_of(row);
        return physics::is_movable(state.properties[body].motion, state.sleep_states[body], sleep_steps);
    };
    now_.resize(contacts);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const auto row = static_cast<std::uint32_t>(i);
        for (std::uint32_t k = state.first_contacts[row]; k < std::min(contacts, state.first_contacts[row + 1]); ++k) {
            const physics::Contact& contact = state.contacts[k];
            Entry& entry = now_[k];
            entry.id_a = state.id_of(contact.a);
            entry.id_b = state.id_of(contact.b);
            entry.owned_by_a = contact.a == row;
            entry.place = std::uint64_t{row} << 32 | (entry.owned_by_a ? entry.id_b : entry.id_a);
            // Contacts of sleepers are not solved, and their sums are those of others.
            entry.pressed = state.carried[k] > 0 && (movable(contact.a) || movable(contact.b));
            entry.touches = entry.pressed;
            entry.contact = k;
        }
    });
}

// Both lists ascend by place. A contact whose owner has changed is in both under other places.
void Events::match(const Seen& seen) {
    std::vector<std::size_t> lost, found, pressing;
    const auto pass_on = [&](const Entry& was, Entry& is) {
        is.touches |= was.touches;
        if (is.touches && !was.touches) found.push_back(static_cast<std::size_t>(&is - now_.data()));
        if (is.pressed && !was.pressed) pressing.push_back(static_cast<std::size_t>(&is - now_.data()));
    };
    std::vector<std::size_t> unmatched;
    std::size_t i = 0;
    for (std::size_t j = 0; j < now_.size(); ++j) {
        while (i < before_.size() && before_[i].place < now_[j].place) lost.push_back(i++);
        if (i < before_.size() && before_[i].place == now_[j].place)
            pass_on(before_[i++], now_[j]);
        else
            unmatched.push_back(j);
    }
    while (i < before_.size()) lost.push_back(i++);
    const auto ids = [](const Entry& e) { return std::pair(e.id_a, e.id_b); };
    std::sort(lost.begin(), lost.end(), [&](std::size_t x, std::size_t y) { return ids(before_[x]) < ids(before_[y]); });
    for (const std::size_t j : unmatched) {
        const auto same = std::lower_bound(lost.begin(), lost.end(), ids(now_[j]),
                                           [&](std::size_t x, const auto& key) { return ids(before_[x]) < key; });
        if (same != lost.end() && ids(before_[*same]) == ids(now_[j])) {
            pass_on(before_[*same], now_[j]);
            lost.erase(same);
        } else {
            pass_on({}, now_[j]);
        }
    }
    for (const std::size_t j : found) add(pair_of(now_[j], seen.state), now_[j], seen);
    Pairs told;
    for (const std::size_t j : pressing) hit(pair_of(now_[j], seen.state), now_[j], seen, told);
    for (const std::size_t k : lost)
        if (before_[k].touches) drop(pair_of(before_[k], seen.state), seen.generations, seen.step);
}

// Two rounds of the mixing of SplitMix64 (Steele, Lea, Flood 2014).
std::size_t Events::HashOfPair::operator()(const Pair& pair) const {
    std::uint64_t mixed = std::uint64_t{pair.a} << 32 | pair.b;
    for (const std::uint64_t more : {std::uint64_t{0}, std::uint64_t{pair.part_a} << 32 | pair.part_b}) {
        mixed = (mixed ^ more ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
        mixed ^= mixed >> 27;
    }
    return static_cast<std::size_t>(mixed);
}

Events::Pair Events::pair_of(const Entry& entry, const State& state) const {
    const auto side = [&](std::uint32_t id) {
        if (id < first_part_) return std::pair(id, 0u);
        return std::pair(state.id_of(state.body_of(id)), part_numbers_[id - first_part_]);
    };
    auto [a, part_a] = side(entry.id_a);
    auto [b, part_b] = side(entry.id_b);
    return a < b ? Pair{a, b, part_a, part_b} : Pair{b, a, part_b, part_a};
}

Event Events::event_of(EventKind kind, const Pair& pair, const std::vector<std::uint32_t>& generations,
                       std::uint64_t step) const {
    Event event;
    event.step = step;
    event.kind = kind;
    event.a = pair.a;
    event.b = pair.b;
    event.part_a = pair.part_a;
    event.part_b = pair.part_b;
    event.a_generation = generation_of(generations, pair.a);
    event.b_generation = generation_of(generations, pair.b);
    return event;
}

// Speed, impulse, point and normal of a contact.
void Events::describe(Event& event, const Entry& entry, const State& state) const {
    const physics::Contact& contact = state.contacts[entry.contact];
    const std::uint32_t a = state.body_of(contact.a), b = state.body_of(contact.b);
    physics::vec3 middle(0);
    event.speed = 0;
    for (physics::uint k = 0; k < contact.count; ++k) {
        const physics::vec3 arm(contact.points[k]);
        const physics::vec3 on_a = velocities_[a].linear + physics::cross3(velocities_[a].angular, arm);
        const physics::vec3 on_b = velocities_[b].linear + physics::cross3(velocities_[b].angular, arm - contact.center_offset);
        event.speed = std::max(event.speed, physics::dot3(contact.normal, on_a - on_b));
        middle += arm;
    }
    event.impulse = state.carried[entry.contact];
    event.point = state.poses[a].position + middle / static_cast<float>(std::max(1u, contact.count));
    event.normal = state.id_of(a) == event.a ? contact.normal : -contact.normal;
}

void Events::add(const Pair& pair, const Entry& entry, const Seen& seen) {
    if (++pairs_[pair] > 1) return;
    Event event = event_of(EventKind::begin, pair, seen.generations, seen.step);
    describe(event, entry, seen.state);
    events_.push_back(event);
}

// Of the triangles of a mesh that a body hits at once the first counts.
void Events::hit(const Pair& pair, const Entry& entry, const Seen& seen, Pairs& told) {
    if (!(settings_.hit_speed < unlimited)) return;
    Event event = event_of(EventKind::hit, pair, seen.generations, seen.step);
    describe(event, entry, seen.state);
    if (event.speed < settings_.hit_speed) return;
    if (told.insert(pair).second) events_.push_back(event);
}

void Events::drop(const Pair& pair, const std::vector<std::uint32_t>& generations, std::uint64_t step) {
    const auto found = pairs_.find(pair);
    if (found == pairs_.end() || --found->second > 0) return;
    pairs_.erase(found);
    events_.push_back(event_of(EventKind::end, pair, generations, step));
}

void Events::end_contacts_of(const std::vector<std::size_t>& gone, const State& state,
                             const std::vector<std::uint32_t>& generations, std::uint64_t step) {
    if (!settings_.any()) return;
    const std::size_t first = events_.size();
    for (Entry& entry : before_) {
        if (!entry.touches) continue;
        const Pair pair = pair_of(entry, state);
        if (!std::binary_search(gone.begin(), gone.end(), pair.a) && !std::binary_search(gone.begin(), gone.end(), pair.b))
            continue;
        entry.touches = entry.pressed = 0;
        drop(pair, generations, step);
    }
    std::erase_if(sensed_, [&](const SensorOverlap& one) {
        const bool ends = std::binary_search(gone.begin(), gone.end(), std::size_t{one.sensor}) ||
                          std::binary_search(gone.begin(), gone.end(), std::size_t{one.body});
        if (ends) tell_sensor(EventKind::sensor_end, one, generations, step);
        return ends;
    });
    for (const std::size_t body : gone)
        if (body < bodies_.size()) bodies_[body] = 0;
    std::sort(events_.begin() + static_cast<std::ptrdiff_t>(first), events_.end(), happens_before);
}

// ---- bodies and joints
void Events::compare_bodies(const Seen& seen) {
    const State& state = seen.state;
    bodies_.resize(state.body_count);
    for (std::uint32_t id = 0; id < state.body_count; ++id) {
        const std::uint32_t row = state.row_of(id);
        const physics::uint motion = state.properties[row].motion;
        std::uint8_t now = physics::is_absent(motion) ? 0 : there;
        if (now && physics::is_asleep(state.sleep_states[row], state.fixed().sleep_steps) && motion == physics::MOTION_DYNAMIC)
            now |= asleep;
        const std::uint8_t was = std::exchange(bodies_[id], now);
        if (was == now || seen.step == 0) continue;
        const auto tell = [&](EventKind kind) {
            events_.push_back(event_of(kind, {id, 0, 0, 0}, seen.generations, seen.step));
            events_.back().b_generation = 0;
        };
        if (settings_.breaks && motion == physics::MOTION_BROKEN) tell(EventKind::body_broke);
        if (settings_.sleep && (was & there) && (now & there)) tell(now & asleep ? EventKind::fell_asleep : EventKind::woke);
    }
}

void Events::note_joints(const Scene& scene, const State& state) {
    joints_.resize(scene.joints.size());
    for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j] = state.joints[state.joint_records[j]].broken != 0;
}

void Events::forget_joint(std::size_t joint) {
    if (joint < joints_.size()) joints_[joint] = 1;
}

void Events::compare_joints(const Seen& seen) {
    if (joints_.size() != seen.scene.joints.size()) return note_joints(seen.scene, seen.state);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        const bool broken = seen.state.joints[seen.state.joint_records[j]].broken != 0;
        if (!broken || joints_[j]) continue;
        joints_[j] = 1;
        const Joint& joint = seen.scene.joints[j];
        Event event =
            event_of(EventKind::joint_broke, {static_cast<std::uint32_t>(joint.a), static_cast<std::uint32_t>(joint.b), 0, 0},
                     seen.generations, seen.step);
        event.joint = static_cast<std::uint32_t>(j);
        events_.push_back(event);
    }
}

void Events::compare_bonds(const Seen& seen) {
    bonds_.resize(seen.state.bond_states.size());
    for (std::size_t i = 0; i < bonds_.size(); ++i) {
        if (seen.state.bond_states[i] == 0 || std::exchange(bonds_[i], std::uint8_t{1}) != 0) continue;
        const Bond& bond = seen.scene.bonds[i];
        Event event =
            event_of(EventKind::bond_broke, {static_cast<std::uint32_t>(bond.a), static_cast<std::uint32_t>(bond.b), 0, 0},
                     seen.generations, seen.step);
        event.joint = static_cast<std::uint32_t>(i);
        events_.push_back(event);
    }
}

// ---- sensors
void Events::tell_sensor(EventKind kind, const SensorOverlap& one, const std::vector<std::uint32_t>& generations,
                         std::uint64_t step) {
    events_.push_back(event_of(kind, {one.sensor, one.body, one.sensor_part, one.part}, generations, step));
}

void Events::compare_sensors(const Seen& seen, const Threads& threads) {
    if (!has_sensors(seen.state) && sensed_.empty()) return;
    auto [now, passed] = sensed_in_step(seen.state, poses_, threads);
    std::vector<SensorOverlap> begun, ended;
    std::set_difference(now.begin(), now.end(), sensed_.begin(), sensed_.end(), std::back_inserter(begun));
    std::set_difference(passed.begin(), passed.end(), sensed_.begin(), sensed_.end(), std::back_inserter(begun));
    std::set_difference(sensed_.begin(), sensed_.end(), now.begin(), now.end(), std::back_inserter(ended));
    std::set_difference(passed.begin(), passed.end(), sensed_.begin(), sensed_.end(), std::back_inserter(ended));
    for (const SensorOverlap& one : begun) tell_sensor(EventKind::sensor_begin, one, seen.generations, seen.step);
    for (const SensorOverlap& one : ended) tell_sensor(EventKind::sensor_end, one, seen.generations, seen.step);
    sensed_ = std::move(now);
}

std::vector<Event> Events::take() {
    return std::exchange(events_, {});
}

// ---- checkpoints
void Events::put(ByteWriter& out) const {
    out.put(settings_.contacts), out.put(settings_.hit_speed), out.put(settings_.breaks), out.put(settings_.sleep);
    out.put(settings_.sensors);
    out.put_list(std::span(sensed_));
    out.put(std::uint64_t{events_.size()});
    for (const Event& event : events_) for_each_value(event, [&](const auto& value) { out.put(value); });
    out.put_list(std::span(before_));
    out.put(std::uint64_t{pairs_.size()});
    std::vector<std::pair<Pair, std::uint32_t>> in_order(pairs_.begin(), pairs_.end());
    std::sort(in_order.begin(), in_order.end());
    for (const auto& [pair, contacts] : in_order) out.put(pair), out.put(contacts);
    out.put_list(std::span(bodies_));
    out.put_list(std::span(joints_));
    out.put_list(std::span(bonds_));
    out.put(settings_.any() ? first_part_ : 0u);
}

void Events::restore(ByteReader& in) {
    settings_.contacts = in.take<bool>();
    settings_.hit_speed = in.take<float>();
    settings_.breaks = in.take<bool>();
    settings_.sleep = in.take<bool>();
    settings_.sensors = in.take<bool>();
    sensed_ = in.take_list<SensorOverlap>();
    events_.clear();
    for (auto left = in.take<std::uint64_t>(); left > 0; --left)
        for_each_value(events_.emplace_back(), [&](auto& value) { value = in.take<std::remove_reference_t<decltype(value)>>(); });
    before_ = in.take_list<Entry>();
    pairs_.clear();
    for (auto left = in.take<std::uint64_t>(); left > 0; --left) {
        const Pair pair = in.take<Pair>();
        pairs_[pair] = in.take<std::uint32_t>();
    }
    bodies_ = in.take_list<std::uint8_t>();
    joints_ = in.take_list<std::uint8_t>();
    bonds_ = in.take_list<std::uint8_t>();
    first_part_ = in.take<std::uint32_t>();
    part_numbers_.clear();
    arrangement_ = ~std::uint64_t{0};
}

bool Events::fits(std::uint32_t rows, std::uint32_t first_part) const {
    if (before_.empty()) return true;
    if (first_part_ > first_part) return false;
    const auto is_row = [&](std::uint32_t id) { return id < first_part_ || id < rows - (first_part - first_part_); };
    return std::all_of(before_.begin(), before_.end(), [&](const Entry& e) { return is_row(e.id_a) && is_row(e.id_b); });
}

}  // namespace scree
