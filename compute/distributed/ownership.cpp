// Owners of bodies, and bodies that change ranks.
#include "compute/distributed/ownership.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "compute/distributed/packing.h"
#include "compute/tables/memory_order.h"

namespace scree {

namespace {

// With more samples borders are better; exchanged between all, 1,000 ranks send 4 MB each time.
constexpr int samples_of_rank = 256;
// Borders stay while no rank has more than this much of the mean cost.
constexpr double uneven = 1.05;

struct Sample {
    std::uint64_t place = 0;
    double cost = 0;
};

// All that lasts of a body.
struct MovedBody {
    std::uint32_t id = 0;
    RowRecords records;
};

MovedBody moved_body(const State& state, std::uint32_t row) {
    return {state.id_of(row), RowRecords::of(state, row)};
}
void take_body(State& state, MovedBody body) {
    const std::uint32_t row = state.row_of(body.id);
    // Properties are sent to shares alone: others have them.
    body.records.properties = state.is_share() ? owned_by(row, body.records.properties) : state.properties[row];
    body.records.put(state, row);
}

template <class Records>
void put_list(Bytes& bytes, const Records& records) {
    put(bytes, static_cast<std::uint64_t>(records.size()));
    for (const auto& record : records) put(bytes, record);
}
template <class Record>
std::vector<Record> take_list(Unpacker& from) {
    std::vector<Record> records(from.take<std::uint64_t>());
    for (Record& record : records) from.take(record);
    return records;
}

bool is_dynamic(const State& state, std::uint32_t row) {
    return state.properties[row].motion == physics::MOTION_DYNAMIC;
}

}  // namespace

std::uint64_t Ownership::place_of(const State& state, std::uint32_t id) const {
    const std::uint32_t row = state.row_of(group_.empty() ? id : group_[id]);
    return place_on_curve(state.poses[row].position, state.fixed().inverse_cell);
}

void Ownership::group(const State& state) {
    const auto n = static_cast<std::uint32_t>(owner_.size());
    std::vector<std::uint32_t> parent(n);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t id) {
        while (parent[id] != id) id = parent[id] = parent[parent[id]];
        return id;
    };
    const std::uint32_t blocks = state.fixed().joint_blocks;
    const auto moves = [&](std::uint32_t row) {
        return row != physics::NONE && state.properties[row].motion != physics::MOTION_FIXED &&
               state.properties[row].motion != physics::MOTION_KINEMATIC;
    };
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        for (std::uint32_t k = block.first_joint; k < block.first_joint + block.joints; ++k) {
            const physics::Joint& joint = state.joints[k];
            if (!moves(joint.a) || !moves(joint.b)) continue;
            const std::uint32_t a = root(state.id_of(joint.a)), b = root(state.id_of(joint.b));
            parent[std::max(a, b)] = std::min(a, b);
        }
        if (block.couplings == 0) continue;  // else no joint may connect its bodies
        std::optional<std::uint32_t> first;
        for (std::uint32_t m = block.first_body; m < block.first_body + block.bodies; ++m) {
            if (!moves(state.block_bodies[m].body)) continue;
            const std::uint32_t id = root(state.id_of(state.block_bodies[m].body)), other = root(first.value_or(id));
            first = id;
            parent[std::max(id, other)] = std::min(id, other);
        }
    }
    for (std::uint32_t id = 0; id < n; ++id) parent[id] = root(id);
    group_ = std::move(parent);
}

const std::vector<std::uint64_t>& Ownership::divide(std::vector<std::uint64_t> places, int ranks) {
    std::sort(places.begin(), places.end());
    borders_.clear();
    const auto count = static_cast<std::size_t>(ranks);
    for (std::size_t r = 1; r < count; ++r) borders_.push_back(places.empty() ? 0 : places[r * places.size() / count]);
    return borders_;
}

void Ownership::begin(std::vector<int> owners) {
    owner_ = std::move(owners);
    was_dynamic_.resize(owner_.size());
    was_everywhere_.resize(owner_.size());
}

void Ownership::adapt(const State& state, const Exchange& exchange) {
    if (state.is_share()) return;
    const auto known = static_cast<std::uint32_t>(owner_.size());
    const std::uint32_t n = state.body_count;
    owner_.resize(n);
    was_dynamic_.resize(n);
    was_everywhere_.resize(n);
    group(state);
    if (known == 0) {  // as many bodies to each rank
        std::vector<std::uint64_t> places;
        for (std::uint32_t id = 0; id < n; ++id)
            if (is_dynamic(state, state.row_of(id))) places.push_back(place_of(state, id));
        divide(std::move(places), exchange.ranks());
    }
    for (std::uint32_t id = known; id < n; ++id)
        owner_[id] = static_cast<int>(std::upper_bound(borders_.begin(), borders_.end(), place_of(state, id)) - borders_.begin());
    for (std::uint32_t id = 0; id < n; ++id) regrouped_ |= owner_[id] != owner_[group_[id]];
    if (known == 0) {
        for (std::uint32_t id = 0; id < n; ++id) owner_[id] = owner_[group_[id]];
        regrouped_ = false;
    }
}

bool Ownership::has_started(const State& state, std::uint32_t row) const {
    const std::uint32_t id = state.id_of(row);
    return id < owner_.size() && was_everywhere_[id] && is_dynamic(state, row);
}

// In a share motions do not change; without presence all contacts are here.
bool Ownership::any_started(const State& state) const {
    if (state.is_share() || state.presence.empty()) return false;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row)
        if (has_started(state, row)) return true;
    return false;
}

void Ownership::give_contacts(State& state, Exchange& exchange) {
    const auto ranks = static_cast<std::size_t>(exchange.ranks());
    std::vector<std::vector<OwnedContact>> contacts(ranks);
    for (std::uint32_t row = 0; row < state.fixed().bodies; ++row)
        for (std::uint32_t k = state.first_contacts[row]; k < state.first_contacts[row + 1]; ++k) {
            const physics::Contact& contact = state.contacts_before[k];
            for (const std::uint32_t end : {state.body_of(contact.a), state.body_of(contact.b)})
                if (has_started(state, end) && owner_of(state, end) != exchange.rank())
                    contacts[static_cast<std::size_t>(owner_of(state, end))].push_back(
                        by_ids(state, {row, ContactRecords::of_last_step(state, k)}));
        }
    std::vector<Bytes> to(ranks);
    for (std::size_t r = 0; r < ranks; ++r) put_list(to[r], contacts[r]);
    std::vector<OwnedContact> more;
    for (const Bytes& one : exchange.all_to_all(to)) {
        Unpacker from(one);
        for (const OwnedContact& contact : take_list<OwnedContact>(from)) more.push_back(by_rows(state, contact));
    }
    state.turn_over();
    merge_contacts(state, more, [](const physics::Contact&) { return true; });
    state.turn_over();
}

void Ownership::note_motions(const State& state) {
    for (std::uint32_t id = 0; id < owner_.size(); ++id) {
        const std::uint32_t row = state.row_of(id);
        was_dynamic_[id] = is_dynamic(state, row);
        was_everywhere_[id] = !is_dynamic(state, row) && !physics::is_absent(state.properties[row].motion);
    }
}

bool Ownership::any_stopped(const State& state) const {
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        const std::uint32_t id = state.id_of(row);
        if (id < owner_.size() && was_dynamic_[id] && !is_dynamic(state, row)) return true;
    }
    return false;
}

void Ownership::place(State& state, Exchange& exchange) {
    const std::uint32_t rows = state.fixed().bodies, first_part = state.fixed().first_part;
    state.presence.assign(rows, Presence::elsewhere);
    Bytes no_longer_dynamic;
    bool any_stopped = false;
    for (std::uint32_t row = 0; row < first_part; ++row) {
        const std::uint32_t id = state.id_of(row);
        // An empty row, or of a ghost that comes in this step.
        if (id >= owner_.size() || (state.is_share() && physics::is_absent(state.properties[row].motion))) continue;
        const bool own = owner_[id] == exchange.rank(), dynamic = is_dynamic(state, row);
        const physics::uint motion = state.properties[row].motion;
        if (dynamic)
            state.presence[row] = own ? Presence::owned : Presence::elsewhere;
        else if (!physics::is_absent(motion))
            state.presence[row] = Presence::everywhere;
        if (was_dynamic_[id] && !dynamic) {
            any_stopped = true;
            if (own) put(no_longer_dynamic, moved_body(state, row));
        }
        was_dynamic_[id] = dynamic;
        was_everywhere_[id] = state.presence[row] == Presence::everywhere;
    }
    for (std::uint32_t row = first_part; row < rows; ++row) state.presence[row] = state.presence[state.properties[row].owner];
    if (!any_stopped) return;
    for (const Bytes& received : exchange.all_gather(no_longer_dynamic))
        for (Unpacker from(received); from.has_more();) take_body(state, from.take<MovedBody>());
}

void Ownership::balance(State& state, Exchange& exchange, Share& share) {
    std::vector<Sample> own;
    double total = 0;
    std::vector<std::uint32_t> ids;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        const std::uint32_t id = state.id_of(row);
        if (id >= owner_.size() || owner_[id] != exchange.rank() || !is_dynamic(state, row)) continue;
        const std::uint32_t slots = state.slot_ends[row] - state.first_slot_of(row);
        own.push_back({place_of(state, id), 1.0 + slots});
        ids.push_back(id);
        total += own.back().cost;
    }
    const std::vector<Sample> unsorted = own;
    std::sort(own.begin(), own.end(), [](const Sample& a, const Sample& b) { return a.place < b.place; });
    Bytes sent;
    put(sent, total);
    double passed = 0;
    int taken = 0;
    for (const Sample& body : own) {
        passed += body.cost;
        for (; taken < samples_of_rank && passed >= (taken + 0.5) * total / samples_of_rank; ++taken)
            put(sent, Sample{body.place, total / samples_of_rank});
    }
    std::vector<Sample> all;
    double most = 0, sum = 0;
    for (const Bytes& received : exchange.all_gather(sent)) {
        Unpacker from(received);
        const auto cost = from.take<double>();
        most = std::max(most, cost);
        sum += cost;
        while (from.has_more()) all.push_back(from.take<Sample>());
    }
    const auto ranks = static_cast<std::size_t>(exchange.ranks());
    if (most * static_cast<double>(ranks) > uneven * sum) {
        std::sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.place < b.place; });
        double before = 0;
        std::size_t border = 0;
        for (const Sample& sample : all) {
            before += sample.cost;
            while (border < borders_.size() && before >= sum * static_cast<double>(border + 1) / static_cast<double>(ranks))
                borders_[border++] = sample.place;
        }
    }
    Moves moves;
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const auto target =
            static_cast<int>(std::upper_bound(borders_.begin(), borders_.end(), unsorted[k].place) - borders_.begin());
        if (target != exchange.rank()) moves.push_back({ids[k], target});
    }
    move(state, exchange, share, moves);
}

void Ownership::follow_joints(State& state, Exchange& exchange, Share& share) {
    if (!regrouped_) return;
    regrouped_ = false;
    Moves moves;
    for (std::uint32_t id = 0; id < owner_.size(); ++id)
        if (owner_[id] == exchange.rank() && owner_[group_[id]] != exchange.rank()) moves.push_back({id, owner_[group_[id]]});
    move(state, exchange, share, moves);
}

void Ownership::move(State& state, Exchange& exchange, Share& share, const Moves& own_moves) {
    Bytes sent;
    for (const auto& [id, target] : own_moves) {
        put(sent, id);
        put(sent, target);
    }
    const std::vector<Bytes> received = exchange.all_gather(sent);
    if (std::all_of(received.begin(), received.end(), [](const Bytes& one) { return one.empty(); })) return;
    const int own = exchange.rank();
    std::unordered_set<std::uint32_t> left;
    for (const Bytes& one : received)
        for (Unpacker from(one); from.has_more(); ++migrations_) {
            const auto id = from.take<std::uint32_t>();
            if (owner_[id] == own) left.insert(id);
            owner_[id] = from.take<int>();
        }
    const auto ranks = static_cast<std::size_t>(exchange.ranks());
    const auto leaves_for = [&](std::uint32_t row) {  // -1: it stays, or was not here
        if (row >= state.fixed().first_part) row = state.properties[row].owner;
        const std::uint32_t id = state.id_of(row);
        return left.contains(id) && owner_[id] != own && is_dynamic(state, row) ? owner_[id] : -1;
    };
    std::vector<std::vector<MovedBody>> bodies(ranks);
    for (const auto& [id, target] : own_moves)
        bodies[static_cast<std::size_t>(target)].push_back(moved_body(state, state.row_of(id)));
    std::vector<std::vector<OwnedContact>> contacts(ranks);
    for (std::uint32_t row = 0; row < state.fixed().bodies; ++row)
        for (std::uint32_t k = state.first_contacts[row]; k < state.first_contacts[row + 1]; ++k) {
            const physics::Contact& contact = state.contacts_before[k];
            const int to_a = leaves_for(contact.a), to_b = leaves_for(contact.b);
            const OwnedContact sent_contact = by_ids(state, {row, ContactRecords::of_last_step(state, k)});
            if (to_a >= 0) contacts[static_cast<std::size_t>(to_a)].push_back(sent_contact);
            if (to_b >= 0 && to_b != to_a) contacts[static_cast<std::size_t>(to_b)].push_back(sent_contact);
        }
    std::vector<Bytes> joints(ranks), vehicles(ranks);
    for (std::uint32_t i = 0; i < state.fixed().joint_blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        int of_block = -1;
        for (std::uint32_t k = block.first_body; k < block.first_body + block.bodies; ++k)
            of_block = std::max(of_block, leaves_for(state.block_bodies[k].body));
        for (std::uint32_t k = block.first_joint; k < block.first_joint + block.joints; ++k) {
            // Not all of a block: a new joint may have united it with one of the other rank. A joint whose ends are both in
            // quarantine, or broken, goes with the others.
            int target = -1;
            bool is_dead = true;
            for (const std::uint32_t end : {state.joints[k].a, state.joints[k].b}) {
                if (end == physics::NONE || !is_dynamic(state, end)) continue;
                is_dead = false;
                target = std::max(target, leaves_for(end));
            }
            if (is_dead) target = of_block;
            if (target < 0) continue;
            put(joints[static_cast<std::size_t>(target)], k);
            put(joints[static_cast<std::size_t>(target)], state.joints[k]);
        }
    }
    for (std::uint32_t i = 0; i < state.fixed().vehicles; ++i) {
        const int target = leaves_for(state.vehicles[i].dynamics.chassis);
        if (target < 0) continue;
        put(vehicles[static_cast<std::size_t>(target)], i);
        put(vehicles[static_cast<std::size_t>(target)], state.vehicles[i]);
    }
    std::vector<Bytes> to(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        put_list(to[r], bodies[r]);
        put_list(to[r], contacts[r]);
        put_list(to[r], joints[r]);
        put_list(to[r], vehicles[r]);
    }
    std::vector<MovedBody> come;
    std::vector<OwnedContact> more;
    for (const Bytes& one : exchange.all_to_all(to)) {
        Unpacker from(one);
        const auto some_bodies = take_list<MovedBody>(from);
        come.insert(come.end(), some_bodies.begin(), some_bodies.end());
        const auto some = take_list<OwnedContact>(from);
        more.insert(more.end(), some.begin(), some.end());
        const auto joint_bytes = take_list<std::byte>(from), vehicle_bytes = take_list<std::byte>(from);
        for (Unpacker records(joint_bytes); records.has_more();) {
            const auto k = records.take<std::uint32_t>();
            records.take(state.joints[k]);
        }
        for (Unpacker records(vehicle_bytes); records.has_more();) {
            const auto k = records.take<std::uint32_t>();
            records.take(state.vehicles[k]);
        }
    }
    std::vector<std::uint32_t> needed;  // and who touches them: ghosts of this step
    for (const MovedBody& body : come) needed.push_back(body.id);
    for (const OwnedContact& one : more) needed.insert(needed.end(), {one.records.contacts.a, one.records.contacts.b});
    share.take_in(state, needed);
    for (const MovedBody& body : come) take_body(state, body);
    for (OwnedContact& one : more) one = by_rows(state, one);
    state.turn_over();
    merge_contacts(state, more, [&](const physics::Contact& contact) {
        const auto is_own = [&](std::uint32_t row) {
            const std::uint32_t body = state.body_of(row);
            return is_dynamic(state, body) && owner_[state.id_of(body)] == own;
        };
        return is_own(contact.a) || is_own(contact.b);
    });
    state.turn_over();
}

void Ownership::inherit(const State& state, std::uint32_t row) {
    const physics::Fracturing& fracturing = state.fractures[state.properties[row].fracture];
    for (std::uint32_t k = 0; k < fracturing.count; ++k) owner_[state.id_of(fracturing.first_row + k)] = owner_[state.id_of(row)];
}

OwnedContact by_ids(const State& state, OwnedContact contact) {
    for (std::uint32_t* row : {&contact.owner, &contact.records.contacts.a, &contact.records.contacts.b})
        *row = state.id_of(*row);
    return contact;
}
OwnedContact by_rows(const State& state, OwnedContact contact) {
    for (std::uint32_t* id : {&contact.owner, &contact.records.contacts.a, &contact.records.contacts.b})
        *id = state.row_with(*id);
    return contact;
}

void merge_contacts(State& state, const std::vector<OwnedContact>& more,
                    const std::function<bool(const physics::Contact&)>& keeps) {
    struct Place {
        std::uint32_t owner, other, from;  // row, id, index of a kept contact; behind all of those of one that is added
        auto key() const { return std::pair(owner, other); }
    };
    const std::uint32_t rows = state.fixed().bodies, before = state.first_contacts[rows];
    const auto place_of = [&](std::uint32_t owner, const physics::Contact& contact, std::uint32_t from) {
        return Place{owner, state.id_of(contact.a == owner ? contact.b : contact.a), from};
    };
    std::vector<Place> all;
    all.reserve(before + more.size());
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t k = state.first_contacts[row]; k < state.first_contacts[row + 1]; ++k)
            if (keeps(state.contacts[k])) all.push_back(place_of(row, state.contacts[k], k));
    for (std::uint32_t k = 0; k < more.size(); ++k) all.push_back(place_of(more[k].owner, more[k].records.contacts, before + k));
    std::sort(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.key() < b.key(); });
    all.erase(std::unique(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.key() == b.key(); }), all.end());
    if (all.size() > state.fixed().contact_capacity) {
        state.fixed().contact_capacity = State::with_reserve(all.size());
        state.allocate();
    }
    std::fill(state.first_contacts.begin(), state.first_contacts.end(), 0u);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::uint32_t from = all[k].from;
        ++state.first_contacts[all[k].owner + 1];
        (from < before ? ContactRecords::of(state, from) : more[from - before].records).put_before(state, k);
    }
    state.turn_over();
    std::partial_sum(state.first_contacts.begin(), state.first_contacts.end(), state.first_contacts.begin());
    state.counted().contacts = static_cast<std::uint32_t>(all.size());
}

}  // namespace scree
