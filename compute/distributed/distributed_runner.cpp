// A rank's part of a step.
#include "compute/distributed/distributed_runner.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "compute/distributed/distributed.h"
#include "compute/distributed/gathering.h"
#include "compute/plan/stage_slices.h"

namespace scree {

namespace {

// Steps between two looks at who owns what. Bodies may be anywhere meanwhile: ghosts follow them.
constexpr std::uint64_t steps_between_balances = 32;

// While messages travel, contacts are solved in parts of so many or more, because some networks look after them only when asked.
constexpr std::uint32_t least_together = 1024, most_parts = 8;

bool starts_with(const std::string& text, const char* begin) {
    return text.rfind(begin, 0) == 0;
}

TableRanges without_contacts(TableRanges ranges) {
    std::erase_if(ranges, [](const TableRange& range) { return is_of_contacts(range.table); });
    return ranges;
}

}  // namespace

std::string DistributedRunner::device() const {
    const auto counted = [](int n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); };
    return counted(exchange_->ranks(), "rank") + " of " +
           (device_ ? device_.runner().device() : counted(threads_.count(), "thread"));
}

void DistributedRunner::attach(State& state) {
    if (state.has_copies()) throw std::invalid_argument("a world of several copies runs on one rank");
    if (state.is_periodic())
        throw std::invalid_argument("a world with a periodic cell runs on one rank; leave out --distributed");
    if (!state.bonds.empty()) throw std::invalid_argument("a world with bonds runs on one rank; leave out --distributed");
    state_ = &state;
    device_.attach(state);
    adapt();
}

std::vector<std::uint64_t> DistributedRunner::borders_of(std::vector<std::uint64_t> places) {
    return ownership_.divide(std::move(places), exchange_->ranks());
}

void DistributedRunner::attach_share(State& state, std::vector<int> owners, std::span<const std::uint32_t> own,
                                     const std::function<void()>& fill) {
    state_ = &state;
    ownership_.begin(std::move(owners));
    state.allocate_all();
    ownership_.place(state, *exchange_);  // what every rank has
    share_.begin(state, own);
    fill();
    ownership_.place(state, *exchange_);
    device_.attach(state);
    adapt();
}

void DistributedRunner::adapt() {
    device_.adapt();
    ownership_.adapt(*state_, *exchange_);
    // New rows are the same on all ranks until the next step.
    if (!state_->presence.empty() && !state_->is_share()) {
        std::vector<Presence>& presence = state_->presence;
        const std::uint32_t first_part = state_->fixed().first_part;
        presence.resize(state_->fixed().bodies, Presence::everywhere);
        for (std::uint32_t row = std::min(placed_bodies_, first_part); row < first_part; ++row)
            presence[row] = Presence::everywhere;
        for (std::uint32_t row = first_part; row < presence.size(); ++row)
            presence[row] = presence[state_->properties[row].owner];
    }
    if (planned_substeps_ == state_->substeps && planned_features_ == state_->features()) return;
    planned_substeps_ = state_->substeps;
    planned_features_ = state_->features();
    plan_ = plan(planned_substeps_, planned_features_);
    clock_ = StageClock(plan_);
    before_.assign(plan_.size(), SyncPoint::none);
    after_ = before_;
    bool met = false;  // the ghosts of this step
    for (std::size_t i = 0; i < plan_.size(); ++i) {
        const std::string& name = plan_[i].name;
        if (!met && (name == "pose_parts" || name == "compute_bounds")) {
            before_[i] = SyncPoint::ghosts;
            met = true;
        }
        if (name == "compute_bounds") after_[i] = SyncPoint::flags;
        if (name == "scan_pairs_spine" || name == "scan_contacts_spine") after_[i] = SyncPoint::room;
        if (starts_with(name, "predict_impacts")) after_[i] = SyncPoint::struck;
        if (name == "propagate_wake") before_[i] = SyncPoint::wake;
        if (name == "propagate_wake" && plan_[i].pass == 2) after_[i] = SyncPoint::wake;
        if (name == "begin_substep") after_[i] = SyncPoint::velocities;
        if (name == "move_bodies") after_[i] = SyncPoint::motion;
        if (name == "end_step") after_[i] = SyncPoint::ends;
        if (starts_with(name, "find_impacts") && !planned_features_.joints) after_[i] = SyncPoint::stops;
        if (name == "share_stops" && plan_[i].pass % 2 == 1) after_[i] = SyncPoint::stops;
        if (name == "find_broken") after_[i] = SyncPoint::kept;
        if (name == "break_bodies") before_[i] = SyncPoint::broken;
    }
}

bool DistributedRunner::can_share_out() const {
    const bool was_read = gathered_[static_cast<std::size_t>(Table::contacts)];
    const bool is_fresh = state_->presence.empty() && state_->counted().contacts == 0;
    return !was_read && (is_fresh || !state_->presence.empty()) && Share::can_be_made(*state_);
}

void DistributedRunner::share_out() {
    State& state = *state_;
    download_share();
    // What is no longer dynamic goes to all.
    if (state.presence.empty() || ownership_.any_stopped(state)) ownership_.place(state, *exchange_);
    share_.make(state);
    device_.attach_anew();
    ownership_.forget_groups();
    halo_.forget();
    adapt();
}

void DistributedRunner::download_share() {
    if (!device_ || std::exchange(has_share_on_host_, true)) return;
    device_.fetch(DeviceSide::Tables(row_tables.begin(), row_tables.end()));
    device_.fetch({Table::slot_ends});
    device_.fetch_contacts();
}

void DistributedRunner::make_whole() {
    download_share();
    share_.end(*state_, *exchange_);
    ownership_.note_motions(*state_);
    device_.attach_anew();
    placed_bodies_ = state_->fixed().first_part;
    halo_.forget();
    adapt();
    gathered_.assign(table_count, false);
}

bool DistributedRunner::step() {
    State& state = *state_;
    if (gathered_[static_cast<std::size_t>(Table::contacts)]) forget_contacts();
    gathered_.assign(table_count, false);
    has_share_on_host_ = false;
    device_.adapt_if_changed();
    if (std::exchange(edited_contacts_, false)) device_.store_contacts();
    if (!state.fixed().redo && exchange_->ranks() > 1) {
        move_bodies_between_ranks();
        place_bodies();
    } else if (!state.fixed().redo) {
        state.turn_over();
    }
    device_.mark_presence();
    if (device_) device_.runner().begin_step();
    wakes_ = knows_waking_ = knows_border_ = false;
    spin_limited_ = state.counted().spin_limited;
    quarantined_ = state.counted().quarantined;
    const bool timed = !device_ || profiles_device_;
    if (timed) clock_.begin_step();
    const Watch watch(threads_);
    for (std::size_t i = 0; i < plan_.size();) {
        if (!sync(before_[i])) return false;
        if (device_) {
            i = run_on_device(i);
        } else {
            run(i++);
        }
        if (!sync(after_[i - 1])) return false;
        const bool travels = after_[i - 1] == SyncPoint::velocities || after_[i - 1] == SyncPoint::motion;
        if (travels && !device_ && exchange_->ranks() > 1) i = pass_meanwhile(i);
    }
    device_.fetch_counts();
    if (state.changes_motions()) device_.fetch({Table::properties});
    if (timed) clock_.end_step();
    return state.counted().overflow == 0;
}

// Turns the tables over; what moves is read and written as the last step left it.
void DistributedRunner::move_bodies_between_ranks() {
    State& state = *state_;
    if (!ownership_.knows(state)) ownership_.adapt(state, *exchange_);  // new bodies in spare rows
    const bool balances = begun_++ % steps_between_balances == 0, start = ownership_.any_started(state);
    const bool may_move = balances || start || ownership_.will_follow_joints();
    const auto lasting = [&] {
        TableRanges ranges = lasting_ranges(state);
        ranges.push_back({Table::slot_ends, 0, state.fixed().bodies});
        return ranges;
    };
    if (device_ && may_move) {
        device_.fetch_counts();
        device_.fetch(lasting());
    }
    const std::uint64_t migrations = ownership_.migrations();
    state.turn_over();
    ownership_.follow_joints(state, *exchange_, share_);
    if (balances) ownership_.balance(state, *exchange_, share_);
    if (start) ownership_.give_contacts(state, *exchange_);
    if (!device_ || (ownership_.migrations() == migrations && !start)) return;
    state.turn_over();
    device_.adapt_if_changed();
    device_.store(lasting());
    if (share_.changes().any()) device_.store({Table::ids});
    state.turn_over();
}

void DistributedRunner::place_bodies() {
    const bool any_stopped = device_ && ownership_.any_stopped(*state_);
    if (any_stopped) device_.fetch(tables_of_owners());
    ownership_.place(*state_, *exchange_);
    placed_bodies_ = state_->fixed().first_part;
    if (any_stopped) device_.store(tables_of_owners());
}

std::size_t DistributedRunner::run_on_device(std::size_t first) {
    std::size_t last = first + 1;
    while (last < plan_.size() && !profiles_device_ && after_[last - 1] == SyncPoint::none && before_[last] == SyncPoint::none)
        ++last;
    const auto begin = std::chrono::steady_clock::now();
    device_.runner().run_stages(first, last);
    const auto end = std::chrono::steady_clock::now();
    if (profiles_device_) clock_.add(first, std::chrono::duration<double>(end - begin).count());
    if (Timeline* told = timeline()) tell(*told, Timeline::caller, plan_[first], *state_, begin, end);
    return last;
}

void DistributedRunner::run(std::size_t stage) {
    Timeline* const told = timeline();
    const Stage& ran = plan_[stage];
    if (told) threads_.watch(told, ran.name);
    const auto begin = std::chrono::steady_clock::now();
    ran.reference(*state_, threads_, ran.pass);
    const auto end = std::chrono::steady_clock::now();
    clock_.add(stage, std::chrono::duration<double>(end - begin).count());
    if (told) tell(*told, Timeline::caller, ran, *state_, begin, end);
}

std::size_t DistributedRunner::pass_meanwhile(std::size_t first) {
    const auto is_of_contacts = [&](std::size_t i) {
        return plan_[i].name == "solve_contacts" || plan_[i].name == "relax_contacts";
    };
    const auto is_of_joints = [&](std::size_t i) { return plan_[i].name == "solve_joints" || plan_[i].name == "relax_joints"; };
    std::size_t last = first;
    while (last < plan_.size() && (is_of_contacts(last) || is_of_joints(last))) ++last;
    if (!std::exchange(knows_border_, true)) border_.find(*state_);
    State::PassRange& range = state_->pass_range;
    const std::uint32_t inner = state_->inner_contacts, parts = std::clamp(inner / least_together, 1u, most_parts);
    const auto begin_of = [&](std::uint64_t part) { return static_cast<std::uint32_t>(part * inner / parts); };
    for (std::size_t i = first; i < last; ++i)
        for (std::uint32_t part = 0; part < (is_of_contacts(i) ? parts : 1); ++part) {
            range = {begin_of(part), begin_of(part + 1), State::Blocks::inner};
            run(i);
            exchange_->progress();
        }
    {
        const TimedSlice slice(timeline(), "exchange");
        halo_.finish(*state_, *exchange_);
    }
    range = {inner, physics::NONE, State::Blocks::border};
    for (std::size_t i = first; i < last; ++i) run(i);
    range = {};
    return last;
}

// Restored tables are whole on every rank, until the next step.
void DistributedRunner::send(const std::vector<TableRange>& ranges) {
    const auto has_whole = [&](Table table) {
        return std::any_of(ranges.begin(), ranges.end(), [&](const TableRange& range) {
            return range.table == table && range.first == 0 && range.count >= state_->fixed().bodies;
        });
    };
    if (has_whole(Table::poses) && has_whole(Table::first_contacts))
        std::vector<Presence>().swap(state_->presence);  // so that sanitizers see who looks behind its new end
    if (!device_ || state_->presence.empty() || !gathered_[static_cast<std::size_t>(Table::contacts)])
        return device_.store(ranges);
    // The host has the contacts of all ranks, in other places than the device has its own: the next step brings those.
    const TableRanges others = without_contacts(ranges);
    edited_contacts_ |= others.size() < ranges.size();
    device_.store(others);
}

void DistributedRunner::forget_contacts() {
    State& state = *state_;
    if (state.presence.empty() || exchange_->ranks() == 1) return;
    merge_contacts(state, {}, [&](const physics::Contact& contact) {
        return state.is_owned(state.body_of(contact.a)) || state.is_owned(state.body_of(contact.b));
    });
    if (own_capacity_ < state.fixed().contact_capacity) state.shrink_contacts(std::max(own_capacity_, state.counted().contacts));
}

void DistributedRunner::fetch_from_device(const TableRanges& ranges) {
    const TableRanges others = without_contacts(ranges);
    device_.fetch(others);
    if (others.size() < ranges.size()) device_.fetch_contacts();
}

void DistributedRunner::download_own_contacts() {
    if (!gathered_[static_cast<std::size_t>(Table::contacts)]) device_.fetch_contacts();
}

void DistributedRunner::receive(const std::vector<TableRange>& ranges) {
    if (state_->presence.empty()) return device_.fetch(ranges);  // all is here
    if (!gathered_[static_cast<std::size_t>(Table::contacts)]) own_capacity_ = state_->fixed().contact_capacity;
    TableRanges missing;
    for (TableRange range : ranges) {
        if (gathered_[static_cast<std::size_t>(range.table)]) continue;
        if (range.table == Table::joints || range.table == Table::vehicles) {  // gathered as a whole
            const auto is_same = [&](const TableRange& other) { return other.table == range.table; };
            if (std::any_of(missing.begin(), missing.end(), is_same)) continue;
            range = range.table == Table::joints ? joint_ranges(*state_).front() : vehicle_ranges(*state_).front();
        }
        missing.push_back(range);
    }
    fetch_from_device(missing);
    gather_ranges(*state_, *exchange_, missing);
    using enum Table;
    const auto note = [&](Table table) { gathered_[static_cast<std::size_t>(table)] = true; };
    for (const TableRange& range : missing) {
        if (is_of_contacts(range.table)) {
            for (const Table table : {contacts, impulses, impacts, first_contacts, carried}) note(table);
            continue;
        }
        switch (range.table) {
            case joints:
            case vehicles:
                note(range.table);
                break;
            default:
                if (range.first == 0 && range.count >= state_->fixed().bodies) note(range.table);
        }
    }
}

std::unique_ptr<Runner> make_distributed_runner(std::shared_ptr<Exchange> exchange, int threads) {
    return std::make_unique<DistributedRunner>(std::move(exchange), threads);
}

}  // namespace scree
