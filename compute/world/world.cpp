// World: stepping, growing tables, user actions.
#include "compute/world.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/fracture.h"
#include "compute/statistics.h"
#include "compute/tables/memory_order.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

// Clamped so that no impulse over a mass leaves the range of a float.
physics::Action bounded(physics::Action action) {
    constexpr float most = 1e15f;
    for (vec3* push : {&action.force, &action.torque, &action.impulse, &action.angular_impulse})
        *push = glm::clamp(*push, vec3(-most), vec3(most));
    return action;
}

// Moment of a force at an offset from the centre. In double precision: products of floats overflow at 1e38.
vec3 moment(vec3 offset, vec3 push) {
    const glm::dvec3 turn = glm::cross(glm::dvec3(offset), glm::dvec3(push));
    constexpr double most = std::numeric_limits<float>::max();
    return vec3(glm::clamp(turn, glm::dvec3(-most), glm::dvec3(most)));
}

bool finite(vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

CopiedScene copied_as_said(const Scene& scene, std::size_t copies, const VaryCopy& vary) {
    if (copies < 1 || copies > physics::MOST_COPIES)
        throw std::invalid_argument("a world has between 1 and " + std::to_string(physics::MOST_COPIES) +
                                    " copies of its scene, not " + std::to_string(copies));
    return copied(scree::checked(scene), copies, vary);
}

}  // namespace

World::Impl::Impl(CopiedScene s, const Settings& t, std::unique_ptr<Runner> r, std::size_t copies)
    : scene(std::move(s.scene)),
      settings(t),
      runner(std::move(r)),
      // On several ranks its share needs the working tables, or make_whole() makes them.
      state(scene, settings, runner->group_size(), runner->in_place() && !ranks, static_cast<std::uint32_t>(copies),
            ranks ? static_cast<std::uint32_t>(ranks->exchange().ranks()) : 1),
      bodies_at_start(scene.bodies.size()),
      shapes_at_start(StartLengths::of(state)),
      fingerprint(fingerprint_of(state)) {
    count_joints();
    if (state.has_copies()) keep_start();
    if (!s.gravities.empty()) {
        state.gravities = records_of_gravities(s.gravities);
        state.allocate();
    }
    begin_in_order();
    runner->attach(state);
}

void World::Impl::require_body(std::size_t body) const {
    if (is_gone(body)) throw std::out_of_range("body " + std::to_string(body) + " has been removed");
    if (body < scene.bodies.size()) return;
    throw std::out_of_range("body " + std::to_string(body) + " of " + std::to_string(scene.bodies.size()));
}

physics::Action& World::Impl::action_on(std::size_t body, vec3 value, vec3 second, bool kinematic_too) {
    require_body(body);
    if (!finite(value) || !finite(second)) throw std::invalid_argument("body " + std::to_string(body) + ": not finite");
    const Motion motion = scene.bodies[body].motion;
    if (motion == Motion::fixed || (motion == Motion::kinematic && !kinematic_too))
        throw std::invalid_argument("body " + std::to_string(body) + " is not dynamic");
    return actions[body];
}

void World::Impl::make_room_for_actions() {
    state.action_room = std::bit_ceil(static_cast<std::uint32_t>(actions.size()));
    state.make(Table::actions);
    runner->adapt();
}

// The body that owns most pairs, from how the pairs were counted or listed. One rank alone may ask, which then talks to no other.
std::string World::Impl::most_paired_body() const {
    const std::uint32_t bodies = state.fixed().bodies;
    const physics::uint overflow = state.counted().overflow;
    if (bodies == 0 || (ranks && (runner->backend() != "cpu" || overflow == 0))) return "";
    if (!ranks) runner->download({{Table::pair_starts, 0, bodies + 1}, {Table::velocities, 0, bodies}});
    const bool are_counts = ranks && (overflow & physics::OVERFLOW_PAIRS) != 0;  // its step ended before they were summed
    const auto pairs_of = [&](std::uint32_t row) {
        return are_counts ? state.pair_starts[row] : state.pair_starts[row + 1] - state.pair_starts[row];
    };
    std::uint32_t most = 0;
    for (std::uint32_t row = 1; row < bodies; ++row)
        if (pairs_of(row) > pairs_of(most)) most = row;
    if (pairs_of(most) == 0) return "";
    const std::uint32_t body = state.body_of(most);
    const auto speed = static_cast<double>(glm::length(state.velocities[body].linear));
    char text[160];
    int end = std::snprintf(text, sizeof text, " alone may touch %u others", pairs_of(most));
    if (const double way = speed / static_cast<double>(settings.rate); way > 0.1)
        std::snprintf(text + end, sizeof text - static_cast<std::size_t>(end), ", moving at %.3g m/s by %.3g m in the step",
                      speed, way);
    return "; " + (shared ? "body " + std::to_string(state.id_of(body)) : name_of_body(state.id_of(body))) + text;
}

std::string World::Impl::beyond_memory(std::size_t needed) const {
    const physics::Counts& counts = state.counted();
    const bool of_pairs = (counts.overflow & physics::OVERFLOW_CONTACTS) == 0;
    char text[200];
    std::snprintf(text, sizeof text, "step %llu is beyond memory: %u %s take %.3g GB of tables, and ",
                  static_cast<unsigned long long>(steps) + 1, of_pairs ? counts.required_pairs : counts.required_contacts,
                  of_pairs ? "pairs of bodies that may touch" : "contacts", static_cast<double>(needed) * 1e-9);
    std::string message = text;
    if (needed > memory_limit) {
        std::snprintf(text, sizeof text, "%.3g GB are allowed", static_cast<double>(memory_limit) * 1e-9);
        message += text;
    } else {
        message += "the system gave less";
    }
    return message + most_paired_body() + ". Fewer bodies or fragments, lower speeds, a higher rate or more memory would do";
}

void World::Impl::make_room_for_lists() {
    const auto begin = Timeline::Clock::now();
    const std::size_t needed = state.bytes_when_grown(runner->in_place());
    if (needed > memory_limit) throw std::length_error(beyond_memory(needed));
    state.grow();
    ++growths;
    state.fixed().redo = 1;
    runner->adapt();
    runner->upload({{Table::counts, 0, 1}});  // clears the overflow
    if (!timeline) return;
    const auto bytes = static_cast<double>(state.bytes());
    timeline->slice(Timeline::caller, "grow buffers", begin, Timeline::Clock::now(), {{"bytes", bytes}});
    timeline->instant("buffers grew, step is redone", begin, {{"bytes", bytes}});
}

// Calls attempt() until it has done the whole step, with longer lists after each that had no room.
template <class Attempt>
void World::Impl::step_with_room(const Attempt& attempt) {
    try {
        while (!attempt()) make_room_for_lists();
    } catch (const std::bad_alloc&) {  // from any stage: those on the CPU have lists of their own
        throw std::length_error(beyond_memory(state.bytes_when_grown(runner->in_place())));
    }
}

void World::Impl::tell_timeline(Timeline::Time begin, std::uint64_t steps_before) {
    const Timeline::Time end = Timeline::Clock::now();
    const physics::Counts& counts = state.counted();
    timeline->slice(Timeline::caller, "step", begin, end,
                    {{"first", static_cast<double>(steps_before + 1)}, {"steps", static_cast<double>(steps - steps_before)}});
    timeline->counter("pairs", end, counts.pairs);
    timeline->counter("contacts", end, counts.contacts);
    if (state.has_fractures() && counts.broken > 0)
        timeline->instant("bodies broke", end, {{"bodies", double{1} * counts.broken}});
}

void World::Impl::step() {
    if (broken) throw std::logic_error("a previous step ran out of memory; the world can be read but not stepped");
    require_room_in_cell();
    broken = true;
    const auto begin = Timeline::Clock::now();
    const std::uint64_t steps_before = steps;
    share_out_when_due();
    catch_up();
    keep_order();
    take_up_grips();
    stop_arrived();
    if (actions.size() > state.action_room) make_room_for_actions();
    physics::Parameters& parameters = state.fixed();
    parameters.actions = 0;
    for (const auto& [body, action] : actions) {
        physics::Action& told = state.actions[parameters.actions++] = bounded(action);
        told.body = state.row_of(body);
    }
    actions.clear();
    parameters.redo = 0;
    const bool watched = events.settings().any();
    if (watched) events.before_step(state);
    step_with_room([&] { return runner->step(); });
    state.fixed().wake_all = 0;
    state.fixed().removed = 0;
    release_indices();
    ++steps;
    stretch_cell();
    note_stillness();
    if (shared && state.counted().quarantined > 0) make_whole();
    if (watched) {
        const TimedSlice slice(timeline.get(), "events");
        runner->download(events.needed(scene, state));
        events.after_step(scene, state, generations, arrangements, steps, runner->threads());
    }
    if (timeline) tell_timeline(begin, steps_before);
    broken = false;
}

int World::Impl::steps_alone(int count) {
    if (std::any_of(grips.begin(), grips.end(), [](const auto& grip) { return grip.has_value(); })) return 0;
    if (is_stretching(state.fixed())) return 0;  // each step has a cell of its own
    broken = true;
    share_out_when_due();
    state.fixed().actions = 0;
    state.fixed().redo = 0;
    const std::uint64_t before = steps;
    const auto begin = Timeline::Clock::now();
    int attempts = 0;
    step_with_room([&] { return attempts++ == 0 ? runner->steps(ranks ? 1 : count, steps) : runner->step(); });
    if (attempts > 1) ++steps;
    note_stillness();
    if (shared && state.counted().quarantined > 0) make_whole();
    if (timeline) tell_timeline(begin, before);
    broken = false;
    return static_cast<int>(steps - before);
}

namespace {

std::unique_ptr<Runner> required(std::unique_ptr<Runner> runner) {
    if (!runner) throw std::invalid_argument("World: there is no runner; make_reference_runner() makes one on the CPU");
    return runner;
}

}  // namespace

World::World(const Scene& scene, const Settings& settings, std::unique_ptr<Runner> runner)
    : World(Scene(scene), settings, std::move(runner)) {}
World::World(Scene&& scene, const Settings& settings, std::unique_ptr<Runner> runner)
    : impl_(std::make_unique<Impl>(CopiedScene{scree::checked(std::move(scene)), {}}, scree::checked(settings),
                                   required(std::move(runner)), 0)) {}
World::World(const StreamedScene& scene, const Settings& settings, std::unique_ptr<Runner> runner)
    : impl_(Impl::of_streamed(scene, settings, required(std::move(runner)))) {}
World::World(const Scene& scene, const Settings& settings, std::unique_ptr<Runner> runner, std::size_t copies,
             const VaryCopy& vary)
    : impl_(std::make_unique<Impl>(copied_as_said(scene, copies, vary), scree::checked(settings), required(std::move(runner)),
                                   copies)) {}
World::World(const Scene& scene, const Settings& settings, int threads)
    : World(scene, settings, make_reference_runner(threads)) {}
World::Impl& World::whole() const {
    impl_->make_whole();
    return *impl_;
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step(int count) {
    constexpr int most_alone = 64;  // between them the memory order is checked
    Impl& in = local();
    if (count < 0) throw std::invalid_argument("step: " + std::to_string(count) + " steps; the number must not be negative");
    while (count > 0) {
        if (in.is_still()) return in.pass_over(count);
        in.step();
        --count;
        if (count > 0 && !in.events.settings().any())
            if (const int alone = std::min({count, most_alone, in.steps_until_arrival()}); alone > 0)
                count -= in.steps_alone(alone);
    }
}

void World::set_memory_limit(std::size_t bytes) {
    local().memory_limit = bytes;
}

std::uint64_t World::steps() const {
    return local().steps;
}
std::size_t World::bodies_there() const {
    const Impl& in = local();
    const std::vector<std::uint8_t>& gone = in.gone;
    if (!in.state.has_fractures())
        return in.bodies() - static_cast<std::size_t>(std::count(gone.begin(), gone.end(), std::uint8_t{1}));
    const std::vector<BodyState> all = bodies();
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const BodyState& body) { return body.exists; }));
}
double World::time() const {
    return static_cast<double>(steps()) / settings().rate;
}
const Scene& World::scene() const {
    Impl& in = local();
    if (in.shared) in.make_whole();
    return in.scene;
}
const Settings& World::settings() const {
    return local().settings;
}
Runner& World::runner() {
    return *local().runner;
}

void World::apply_force(std::size_t body, vec3 force, vec3 offset) {
    physics::Action& action = whole().action_on(body, force, offset);
    action.force += force;
    action.torque += moment(offset, force);
}
void World::apply_torque(std::size_t body, vec3 torque) {
    whole().action_on(body, torque, torque).torque += torque;
}
void World::apply_impulse(std::size_t body, vec3 impulse, vec3 offset) {
    physics::Action& action = whole().action_on(body, impulse, offset);
    action.impulse += impulse;
    action.angular_impulse += moment(offset, impulse);
}
void World::apply_angular_impulse(std::size_t body, vec3 impulse) {
    whole().action_on(body, impulse, impulse).angular_impulse += impulse;
}
void World::set_velocity(std::size_t body, vec3 velocity, vec3 angular_velocity) {
    Impl& in = whole();
    physics::Action& action = in.action_on(body, velocity, angular_velocity, /* kinematic_too */ true);
    if (in.scene.bodies[body].motion == Motion::kinematic) {
        const std::uint32_t row = in.state.row_of(body);
        in.runner->download({{Table::velocities, row, 1}});
        in.change_velocity(body, in.state.velocities[row]);
    }
    action.flags |= physics::ACTION_SETS_VELOCITY;
    action.velocity = velocity;
    action.angular_velocity = angular_velocity;
    in.arrivals.erase(body);
}

// Over the next step, from what it was before the first change.
physics::Action& World::Impl::change_velocity(std::size_t body, const physics::Velocity& before) {
    physics::Action& action = actions[body];
    if ((action.flags & physics::ACTION_CHANGES_VELOCITY) != 0) return action;
    action.flags |= physics::ACTION_CHANGES_VELOCITY;
    action.velocity_before = before.linear;
    action.angular_velocity_before = before.angular;
    return action;
}
// In the next step it has at once the velocity that it is given.
void World::Impl::jump_to_velocity(std::size_t body) {
    if (const auto found = actions.find(body); found != actions.end()) found->second.flags &= ~physics::ACTION_CHANGES_VELOCITY;
}

void World::wake(std::size_t body) {
    whole().action_on(body, vec3(0), vec3(0));
}
void World::wake_all() {
    whole().state.fixed().wake_all = 1;
}
BodyState World::Impl::body_state(std::size_t i) const {
    const std::uint32_t row = state.row_of(i);
    return {state.poses[row].position,
            state.poses[row].orientation,
            state.velocities[row].linear,
            state.velocities[row].angular,
            physics::is_asleep(state.sleep_states[row], state.fixed().sleep_steps),
            !physics::is_absent(state.properties[row].motion),
            physics::is_quarantined(state.properties[row].motion)};
}

std::vector<Quarantine> World::quarantines() const {
    if (local().state.counted().quarantined == 0) return {};
    const Impl& in = whole();
    in.bring(body_ranges);
    in.runner->download({{Table::masses, 0, in.state.fixed().bodies}});
    std::vector<Quarantine> found;
    for (std::size_t i = 0; i < in.scene.bodies.size(); ++i) {
        const std::uint32_t row = in.state.row_of(i);
        if (!physics::is_quarantined(in.state.properties[row].motion)) continue;
        const float code = in.state.masses[row].shares;  // quarantine.h
        const auto steps_and_stage = static_cast<std::uint64_t>(std::max(code, 0.0f));
        const bool ended = code < 0 ? code == physics::AFTER_STEP : (steps_and_stage & 1) != 0;
        const auto hung = std::ranges::count_if(in.scene.joints, [&](const Joint& one) { return one.a == i || one.b == i; });
        found.push_back(
            {i, code < 0 ? in.steps : steps_and_stage / 2, ended ? "end_step" : "move_bodies", static_cast<std::size_t>(hung)});
    }
    return found;
}

std::vector<BodyState> World::bodies() const {
    whole().bring(body_ranges);
    std::vector<BodyState> bodies(whole().scene.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = whole().body_state(i);
    return bodies;
}

BodyState World::body(std::size_t index) const {
    whole().require_body(index);
    whole().runner->download(row_ranges(whole().state, whole().state.row_of(index)));
    return whole().body_state(index);
}

std::vector<BodyContact> World::contacts_of(std::size_t body) const {
    whole().require_body(body);
    whole().bring(body_ranges);
    whole().bring(contact_ranges);
    const State& state = whole().state;
    std::vector<BodyContact> found;
    for (const std::uint32_t i : contacts_by_id(state)) {
        const physics::Contact& contact = state.contacts[i];
        const std::size_t a = state.id_of(state.body_of(contact.a)), b = state.id_of(state.body_of(contact.b));
        if (a != body && b != body) continue;
        const physics::vec4 pushes = state.impulses[i].normal;
        const float force = (pushes.x + pushes.y + pushes.z + pushes.w) * state.fixed().inverse_h;
        found.push_back({a == body ? b : a, static_cast<int>(contact.count), force});
    }
    return found;
}

// Of the contacts of all ranks, each of which reads its own.
ContactSums World::Impl::all_contact_sums() const {
    if (state.presence.empty()) {
        bring(contact_ranges);
        return contact_sums(state);
    }
    ranks->download_own_contacts();
    const ContactSums own = contact_sums(state);
    Bytes sent(sizeof own);
    std::memcpy(sent.data(), &own, sizeof own);
    ContactSums all, one;
    for (const Bytes& received : ranks->exchange().all_gather(sent)) {
        std::memcpy(&one, received.data(), sizeof one);
        all = all + one;
    }
    return all;
}

Statistics World::statistics() const {
    if (local().shared) return local().statistics_of_shares();
    whole().bring(body_ranges);
    whole().bring(joint_ranges);
    whole().bring(bond_ranges);
    Statistics found = scree::statistics_of(whole().scene, whole().state, whole().all_contact_sums());
    const std::vector<std::uint8_t>& gone = whole().joints_gone;
    const auto removed = static_cast<std::size_t>(std::count(gone.begin(), gone.end(), std::uint8_t{1}));
    found.joints -= removed;
    found.joints_broken -= removed;
    return found;
}

const State& World::state() const {
    whole().bring(body_ranges);
    whole().bring(contact_ranges);
    whole().bring(joint_ranges);
    whole().bring(vehicle_ranges);
    return whole().state;
}

std::uint64_t World::state_hash() const {
    if (local().shared) return local().hash_of_shares();
    whole().bring(body_ranges);
    return hash_of(whole().state);
}

std::uint64_t World::buffer_growths() const {
    return local().growths;
}
std::size_t World::buffer_bytes() const {
    const Impl& in = local();
    return in.state.bytes() + in.state.bytes_of_loops();
}
void World::set_profiling(bool on) {
    local().runner->set_profiling(on);
}
void World::set_timeline(std::shared_ptr<Timeline> timeline) {
    local().runner->set_timeline(timeline);
    local().timeline = std::move(timeline);
}
StageTimes World::stage_times() const {
    return local().runner->stage_times();
}
StageTimes World::last_stage_times() const {
    return local().runner->last_stage_times();
}

}  // namespace scree
