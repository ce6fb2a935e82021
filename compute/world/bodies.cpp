// World: bodies that come and go, and their handles.
#include <algorithm>
#include <bit>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/compile/scene_compiler.h"
#include "compute/compile/state_editor.h"
#include "compute/scene/error_reason.h"
#include "compute/scene/fracture.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/body/compound.h"

namespace scree {

namespace {

// The body that has not been cut from another one.
std::size_t root_of(const Scene& scene, std::size_t body) {
    while (scene.bodies[body].piece_of != no_body) body = scene.bodies[body].piece_of;
    return body;
}

}  // namespace

std::string World::Impl::name_of_body(std::size_t body) const {
    const std::string& name = scene.bodies[body].name;
    return "body " + std::to_string(body) + (name.empty() ? "" : " (\"" + name + "\")");
}

Body World::Impl::no_longer_there() {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Sphere{};
    return body;
}

void World::Impl::count_bodies() {
    generations.resize(scene.bodies.size());
    gone.resize(scene.bodies.size());
    for (std::size_t i = origins.size(); i < scene.bodies.size(); ++i)
        origins.push_back(i < bodies_at_start ? Origin::start : Origin::none);
}

// A run of that many: the lowest that is free, or at the end.
std::size_t World::Impl::take_indices(std::size_t count) {
    if (const auto free = take_run(free_indices, count)) return *free;
    const std::size_t first = scene.bodies.size();
    scene.bodies.resize(first + count);
    count_bodies();
    return first;
}

// Contacts of the last step still name the row, so it stays empty for a step.
void World::Impl::free_index(std::size_t body) {
    Body& there = scene.bodies[body];
    if (there.fracture && there.fracture->cut.use_count() <= 2) state.shape_places.cuts.erase(there.fracture->cut);
    if (origins[body] == Origin::start) {
        const auto [kept, fresh] = originals.try_emplace(body);
        if (fresh)
            kept->second = std::move(there);
        else
            kept->second.shape = std::move(there.shape);
    }
    there = no_longer_there();
    if (!gone[body]) ++generations[body];
    gone[body] = 1;
    origins[body] = Origin::none;
    freed.push_back(body);
}

void World::Impl::release_indices() {
    if (freed.empty()) return;
    for (const std::size_t index : freed) add_run(free_indices, index, std::size_t{1});
    freed.clear();
    edits.clear();
}

// Keeps what edits may change of a body of the start, the first time.
void World::Impl::keep_original(std::size_t body) {
    if (body >= bodies_at_start || is_gone(body) || (body < origins.size() && origins[body] != Origin::start)) return;
    const auto [kept, fresh] = originals.try_emplace(body);
    if (!fresh) return;
    Shape shape = std::exchange(scene.bodies[body].shape, Box{});
    kept->second = scene.bodies[body];
    scene.bodies[body].shape = std::move(shape);
}

void World::Impl::send(const TableRanges& changed, const TableLengths& before) {
    if (TableLengths::of(state) != before) runner->adapt();
    runner->upload(united(changed));
    begin_impacts(before.features);
}

// Restitution may be new: contacts that are there already are in no impact.
void World::Impl::begin_impacts(const SceneFeatures& before) {
    if (before.bounces || !state.bounces()) return;
    state.clear_impacts();
    runner->upload({{Table::impacts, 0, state.live(BufferLength::impacts)}});
}

// Each body with its fragments. Bodies without any are checked together, and share hulls.
std::vector<std::vector<Body>> World::Impl::checked_families(std::span<const Body> bodies) const {
    Scene together{scene.gravity, {}, {}};
    together.periodic = scene.periodic;
    for (const Body& body : bodies) together.bodies.push_back(on_its_own(body));
    std::vector<std::vector<Body>> families;
    if (std::none_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.fracture.has_value(); })) {
        together = checked(std::move(together));
        for (Body& body : together.bodies) families.emplace_back().push_back(std::move(body));
        return families;
    }
    for (std::size_t i = 0; i < together.bodies.size(); ++i) {
        try {
            families.push_back(checked(Scene{scene.gravity, {std::move(together.bodies[i])}, {}}).bodies);
        } catch (const SceneError& error) {
            const std::string inside = error.pointer.substr(std::string("/bodies/0").size());
            throw SceneError("/bodies/" + std::to_string(i) + inside, reason_of(error));
        }
    }
    return families;
}

std::vector<BodyHandle> World::add_bodies(std::span<const Body> bodies) {
    Impl& in = whole();
    in.require_one_copy("add_bodies");
    std::vector<std::vector<Body>> families = in.checked_families(bodies);
    if (families.empty()) return {};
    // Read before the scene grows, of which the bodies may be.
    const bool parts = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !simple_shape(body.shape); });
    const bool filters = std::any_of(bodies.begin(), bodies.end(), has_filter);
    in.count_bodies();
    std::vector<std::size_t> firsts;
    const std::size_t count_before = in.scene.bodies.size();
    for (const std::vector<Body>& family : families) firsts.push_back(in.take_indices(family.size()));
    const TableLengths before = TableLengths::of(in.state);
    // The grid's cells fit the first bodies, which may be of other sizes, or none: they are chosen anew each time that the number
    // doubles. By what is known on every processor and kept in checkpoints: rows with their motions of by now.
    const bool doubles = std::bit_width(count_before) != std::bit_width(in.scene.bodies.size());
    if (doubles && in.state.changes_motions()) in.runner->download({{Table::properties, 0, in.state.fixed().bodies}});
    StateEditor editor(in.state);
    const auto appended = static_cast<std::uint32_t>(in.scene.bodies.size() - count_before);
    in.runner->download(editor.needed_to_add(appended, parts));
    TableRanges changed = editor.make_room(appended, parts);
    std::vector<BodyHandle> handles;
    // Rows at the end are made in the order of their indices.
    std::vector<std::size_t> order(families.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return firsts[a] < firsts[b]; });
    for (const std::size_t i : order) {
        for (std::size_t k = 0; k < families[i].size(); ++k) {
            Body& one = families[i][k];
            const std::size_t index = firsts[i] + k;
            if (one.piece_of != no_body) one.piece_of += firsts[i];
            if (one.fracture) one.fracture->first_piece += firsts[i];
            const std::size_t hulls = in.state.hulls.size();
            append(changed, editor.put(one, static_cast<std::uint32_t>(index)));
            in.pack_hulls(hulls, static_cast<std::uint32_t>(index), changed);
            in.scene.bodies[index] = std::move(one);
            in.gone[index] = 0;
            in.origins[index] = k == 0 ? Impl::Origin::added : Impl::Origin::fragment;
        }
    }
    for (const std::size_t first : firsts) handles.push_back({static_cast<std::uint32_t>(first), in.generations[first]});
    if (filters || !in.state.filters.empty()) append(changed, editor.filter(in.scene));
    // The last body with a filter may be gone since, and with it the table.
    if (in.state.filters.empty()) std::erase_if(changed, [](const TableRange& range) { return range.table == Table::filters; });
    if (doubles) editor.choose_cell();
    in.send(changed, before);
    // What is dynamic wakes what it touches; what is not stirs nothing by itself.
    if (std::any_of(firsts.begin(), firsts.end(), [&](std::size_t i) { return in.scene.bodies[i].motion != Motion::dynamic; }))
        in.wake_copy_of(firsts.front());
    in.edits.clear();
    ++in.arrangements;
    ++in.changes;
    return handles;
}

std::size_t World::add_body(const Body& body) {
    return add_bodies({&body, 1}).front().index;
}

// ---- removing
void World::Impl::require_removable(const std::vector<std::size_t>& bodies) const {
    std::set<std::size_t> of_vehicles;
    for (const Vehicle& vehicle : scene.vehicles) {
        of_vehicles.insert(vehicle.chassis);
        for (const Wheel& wheel : vehicle.wheels) of_vehicles.insert(scene.joints[wheel.joint].b);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        require_body(bodies[i]);
        const std::string name = name_of_body(bodies[i]);
        if (i > 0 && bodies[i] == bodies[i - 1]) throw std::invalid_argument(name + " is named twice");
        require_there(bodies[i]);
        if (of_vehicles.contains(bodies[i]))
            throw std::invalid_argument(name + " belongs to a vehicle, which cannot be taken apart");
    }
}

TableRanges World::Impl::break_joints_of(const std::vector<std::size_t>& bodies) {
    TableRanges records;
    std::vector<std::size_t> ended;
    count_joints();
    const auto goes = [&](std::size_t body) { return std::binary_search(bodies.begin(), bodies.end(), body); };
    for (std::size_t j = 0; j < scene.joints.size(); ++j)
        if (!is_joint_gone(j) && (goes(scene.joints[j].a) || goes(scene.joints[j].b))) ended.push_back(j);
    const std::vector<std::size_t> couplings = couplings_of(ended);
    ended.insert(ended.end(), couplings.begin(), couplings.end());
    for (const std::size_t j : ended) {
        records.push_back({Table::joints, state.joint_records[j], 1});
        wake(scene.joints[j]);
    }
    runner->download(records);
    for (const std::size_t joint : ended) take_away_joint(joint);
    return records;
}

// The indices of a body and all its fragments become free together, once none of them exists.
TableRanges World::Impl::free_families_of(const std::vector<std::size_t>& bodies) {
    std::vector<std::uint32_t> rows;  // of those that broke, with their fragments
    std::set<std::size_t> roots;
    for (const std::size_t body : bodies) roots.insert(root_of(scene, body));
    const auto absent = [&](std::size_t body) { return physics::is_absent(state.properties[state.row_of(body)].motion); };
    for (const std::size_t root : roots) {
        std::vector<std::size_t> family = fragments_of(scene, root);
        family.push_back(root);
        if (!std::all_of(family.begin(), family.end(), absent)) continue;
        // A body that broke in the last step has its ends before its index has another generation.
        std::sort(family.begin(), family.end());
        events.end_contacts_of(family, state, generations, steps);
        for (const std::size_t member : family) {
            rows.push_back(static_cast<std::uint32_t>(member));
            free_index(member);
        }
    }
    const auto hulls = hulls_of_added(rows);
    TableRanges changed = StateEditor(state).remove(rows);
    free_hulls(hulls);
    return changed;
}

TableRanges World::Impl::break_bonds_of(const std::vector<std::size_t>& bodies) {
    if (scene.bonds.empty()) return {};
    bring(bond_ranges);
    const auto is_of = [&](std::size_t body) { return std::binary_search(bodies.begin(), bodies.end(), body); };
    for (std::size_t i = 0; i < scene.bonds.size(); ++i)
        if (is_of(scene.bonds[i].a) || is_of(scene.bonds[i].b)) state.bond_states[i] = 1;
    return bond_ranges(state);
}

void World::Impl::remove(std::vector<std::size_t> bodies) {
    if (bodies.empty()) return;
    std::sort(bodies.begin(), bodies.end());
    if (state.changes_motions()) bring(body_ranges);
    require_removable(bodies);
    count_bodies();
    TableRanges changed = break_joints_of(bodies);
    std::vector<std::uint32_t> rows;
    for (const std::size_t body : bodies) {
        rows.push_back(static_cast<std::uint32_t>(body));
        for (const std::size_t fragment : fragments_of(scene, body)) rows.push_back(static_cast<std::uint32_t>(fragment));
        actions.erase(body);
        arrivals.erase(body);
        for (std::optional<Held>& grip : grips)
            if (grip && grip->body == body) grip.reset();
    }
    events.end_contacts_of(bodies, state, generations, steps);
    const auto hulls = hulls_of_added(rows);
    append(changed, StateEditor(state).remove(rows));
    free_hulls(hulls);
    for (const std::size_t body : bodies) {
        ++generations[body];
        gone[body] = 1;
    }
    append(changed, free_families_of(bodies));
    const std::size_t excluded =
        std::erase_if(scene.exclusions, [&](const Exclusion& e) { return is_gone(e.a) || is_gone(e.b); });
    append(changed, break_bonds_of(bodies));
    const TableLengths before = TableLengths::of(state);
    if (excluded > 0) append(changed, StateEditor(state).filter(scene));
    state.fixed().removed = 1;
    send(changed, before);
    edits.clear();
    ++arrangements;
    ++changes;
}

void World::remove_bodies(std::span<const BodyHandle> bodies) {
    whole().require_one_copy("remove_bodies");
    std::vector<std::size_t> indices;
    for (const BodyHandle& body : bodies) indices.push_back(index_of(body));
    whole().remove(std::move(indices));
}

void World::remove_body(std::size_t body) {
    whole().require_one_copy("remove_body");
    whole().remove({body});
}

BodyHandle World::handle_of(std::size_t body) const {
    whole().require_body(body);
    return {static_cast<std::uint32_t>(body), body < whole().generations.size() ? whole().generations[body] : 0};
}

bool World::is_valid(BodyHandle body) const {
    const Impl& in = whole();
    const std::uint32_t now = body.index < in.generations.size() ? in.generations[body.index] : 0;
    return body.index < in.scene.bodies.size() && !in.is_gone(body.index) && body.generation == now;
}

std::size_t World::index_of(BodyHandle body) const {
    if (is_valid(body)) return body.index;
    throw std::out_of_range("body " + std::to_string(body.index) + " of generation " + std::to_string(body.generation) +
                            (body.index < whole().scene.bodies.size() ? " has been removed" : " has never been"));
}

std::vector<std::size_t> World::first_part_rows() const {
    const State& state = whole().state;
    std::vector<std::size_t> rows(whole().scene.bodies.size(), no_body);
    for (std::uint32_t row = state.fixed().bodies; row-- > state.fixed().first_part;)
        if (physics::is_part(state.properties[row])) rows[state.id_of(state.properties[row].owner)] = row;
    return rows;
}

std::uint64_t World::arrangements() const {
    return whole().arrangements;
}

}  // namespace scree
