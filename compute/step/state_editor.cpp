// Edits of a running world's tables. Of joints, blocks and lists are made anew; what lasts of the others stays.
#include "compute/step/state_editor.h"

#include <algorithm>

#include "compute/step/joint_blocks.h"
#include "compute/step/scene_compiler.h"

namespace scree {

namespace {

physics::Impulse scaled(physics::Impulse impulse, float factor) {
    impulse.normal *= factor;
    impulse.friction *= factor;
    impulse.twist *= factor;
    impulse.rolling *= factor;
    impulse.pressed *= factor;
    return impulse;
}

}  // namespace

void StateEditor::tune(vec3 gravity, const Settings& settings) {
    const float h_before = state_.fixed().h;
    state_.fixed() = tuned(state_.fixed(), gravity, settings);
    if (settings.substeps == state_.substeps) return;
    state_.substeps = settings.substeps;
    const float factor = state_.fixed().h / h_before;
    const std::size_t lasting =
        std::min<std::size_t>(state_.counted().contacts, std::min(state_.contacts.size(), state_.impulses.size()));
    for (std::size_t i = 0; i < lasting; ++i) {
        state_.impulses[i] = scaled(state_.impulses[i], factor);
        state_.contacts[i].load *= factor;
    }
    for (physics::Joint& joint : state_.joints)
        for (physics::JointRow& row : joint.rows) {
            row.drive *= factor;
            row.stop *= factor;
        }
}

void StateEditor::add(const Body& body) {
    SceneCompiler compiler(state_);
    physics::Parameters& p = state_.fixed();
    const std::uint32_t n = p.first_part;
    state_.append_row(n);
    const auto make_room = [n](auto& table, const auto& record) {
        if (table.size() >= n) table.insert(table.begin() + n, record);
    };
    state_.traits.resize(p.bodies);  // tables of no bodies have a record all the same
    state_.poses.resize(p.bodies);
    state_.velocities.resize(p.bodies);
    state_.rests.resize(p.bodies);
    state_.strains.resize(p.bodies);
    make_room(state_.traits, compiler.traits_of(body, n));
    make_room(state_.poses, SceneCompiler::start_of(body));
    make_room(state_.velocities, SceneCompiler::start_velocity_of(body));
    make_room(state_.rests, 0u);
    make_room(state_.strains, SceneCompiler::start_strain_of(body, state_.traits[n]));
    if (!state_.masses.empty()) make_room(state_.masses, physics::Mass{});
    // It has no contacts yet: where they begin, they end. Those of parts are told by the parts' new rows.
    std::vector<physics::uint>& starts = state_.first_contacts;
    if (starts.size() > n) make_room(starts, physics::uint{starts[n]});
    for (auto* list : {&state_.contacts, &state_.contacts_before})
        for (physics::Contact& contact : *list)
            for (physics::uint* row : {&contact.a, &contact.b})
                if (*row >= n) ++*row;
    p.first_part = n + 1;
    ++p.bodies;
    const std::uint32_t old_rows = p.bodies;
    compiler.append_parts(body, n);
    p.bodies = static_cast<std::uint32_t>(state_.traits.size());
    p.buckets = std::max(p.buckets, State::buckets_for(p.bodies));
    state_.allocate();
    for (std::uint32_t i = old_rows; i < p.bodies; ++i) {
        compiler.place(i);
        if (starts.size() > i + 1) starts[i + 1] = starts[i];
    }
}

void StateEditor::rejoin(const Scene& scene, std::optional<std::size_t> without) {
    std::vector<physics::Joint> before;
    for (const std::uint32_t record : state_.joint_records) before.push_back(state_.joints[record]);
    if (without) before.erase(before.begin() + static_cast<std::ptrdiff_t>(*without));
    std::vector<physics::Traits> by_id;
    for (std::size_t id = 0; id < state_.fixed().first_part; ++id) {
        by_id.push_back(state_.traits[state_.row_of(id)]);
        by_id.back().joints = physics::NONE;
    }
    JointTables made = joint_tables(scene, by_id);
    for (std::size_t id = 0; id < by_id.size(); ++id) state_.traits[state_.row_of(id)].joints = by_id[id].joints;
    for (physics::Joint& record : made.records)
        for (physics::uint* body : {&record.a, &record.b, &record.member})
            if (*body != physics::NONE) *body = state_.row_of(*body);
    state_.joints = std::move(made.records);
    state_.joint_records = std::move(made.record_of);
    state_.fixed().joint_blocks = made.blocks;
    for (std::size_t j = 0; j < std::min(before.size(), state_.joint_records.size()); ++j) {
        physics::Joint& now = state_.joints[state_.joint_records[j]];
        const physics::Joint& was = before[j];
        std::copy(std::begin(was.rows), std::end(was.rows), now.rows);  // with the impulses that the next step begins with
        now.pins = was.pins;
        now.broken = was.broken;
        now.force = was.force;
        now.greatest_force = was.greatest_force;
        now.torque = was.torque;
        now.greatest_torque = was.greatest_torque;
    }
    for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
        const std::vector<Wheel>& wheels = scene.vehicles[v].wheels;
        for (std::size_t k = 0; k < wheels.size(); ++k) state_.vehicles[v].wheel[k].joint = state_.joint_records[wheels[k].joint];
    }
    state_.allocate();
}

}  // namespace scree
