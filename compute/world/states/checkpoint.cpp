// World: its whole state as bytes.
//
// A head (magic, format, tables, scene, steps, length, hash), then the edits of the scene since the world was made, the
// world's own values, and the tables of the state.
#define XXH_STATIC_LINKING_ONLY
#include "compute/checkpoint.h"

#include <xxhash.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <map>
#include <utility>

#include "compute/scene/fracture.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/check.h"
#include "compute/statistics.h"
#include "compute/world/states/checkpoint_seal.h"
#include "compute/world/states/scene_bytes.h"
#include "compute/world/states/state_parts.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/contact/tyre.h"

namespace scree {

namespace {

constexpr std::uint32_t format = 10;

struct Head {
    char magic[8];
    std::uint32_t format, settings_bytes;
    std::uint64_t tables, scene, steps;
    std::uint64_t bytes;  // behind the head
    std::uint64_t hash;   // XXH64 of those, seeded with the hash of the head up to here
};
constexpr char magic[8] = {'s', 'c', 'r', 'e', 'e', ' ', 'c', '\n'};
static_assert(sizeof(Head) == 56);

std::uint64_t seed_of(const Head& head) {
    return XXH64(&head, offsetof(Head, hash), 0);
}
std::uint64_t hash_of(const Head& head, std::span<const std::byte> rest) {
    return XXH64(rest.data(), rest.size(), seed_of(head));
}

// Without length and hash.
Head head_of(std::uint64_t scene, std::uint64_t steps) {
    Head head{};
    std::memcpy(head.magic, magic, sizeof magic);
    head.format = format;
    head.settings_bytes = sizeof(Settings);
    head.tables = layout_of_tables();
    head.scene = scene;
    head.steps = steps;
    return head;
}

[[noreturn]] void refuse(const std::string& reason) {
    throw CheckpointError(reason);
}

Head checked_head(std::span<const std::byte> state) {
    Head head;
    if (state.size() < sizeof head || std::memcmp(state.data(), magic, sizeof magic) != 0)
        refuse("this is no checkpoint of scree");
    std::memcpy(&head, state.data(), sizeof head);
    if (head.format != format)
        refuse("the checkpoint has format " + std::to_string(head.format) + ", this version of scree reads format " +
               std::to_string(format));
    const auto rest = state.subspan(sizeof head);
    if (rest.size() != head.bytes)
        refuse("the checkpoint is " + std::string(rest.size() < head.bytes ? "cut short" : "too long") + ": it has " +
               std::to_string(rest.size()) + " bytes behind its head instead of " + std::to_string(head.bytes));
    if (hash_of(head, rest) != head.hash) refuse("the checkpoint is damaged: its bytes do not have the hash that it names");
    if (head.tables != layout_of_tables() || head.settings_bytes != sizeof(Settings))
        refuse("the checkpoint was written by another version of scree, whose tables differ");
    return head;
}

// All members: their bytes in memory may have holes.
template <class Visit>
void for_each_setting(auto& s, const Visit& visit) {
    visit(s.rate), visit(s.substeps), visit(s.contact_hertz), visit(s.contact_damping_ratio), visit(s.push_speed);
    visit(s.relaxation), visit(s.speculative_distance), visit(s.restitution_threshold), visit(s.max_speed), visit(s.max_turn);
    visit(s.sleeping), visit(s.sleep_speed), visit(s.sleep_time), visit(s.friction_factor), visit(s.least_restitution);
    visit(s.reordering), visit(s.pairs_at_first), visit(s.contacts_at_first);
}

}  // namespace

// Values of the world outside of its scene and tables.
struct World::Impl::Own {
    Settings settings;
    vec3 gravity{0};
    std::uint64_t steps = 0;
    bool reorder_now = false;
    std::map<std::size_t, physics::Action> actions;
    std::array<std::optional<Held>, most_grips> grips;
    std::map<std::size_t, std::uint64_t> arrivals;
    Events events;
};

// The scene as it is to be: bodies of the start that changed (without shapes) or are gone, added ones with their fragments,
// all joints, vehicles and exclusions.
struct World::Impl::Edits {
    std::size_t bodies = 0;
    std::vector<std::uint32_t> generations;
    std::vector<std::uint8_t> gone, origins;
    std::vector<std::uint64_t> freed;
    std::vector<std::pair<std::size_t, Body>> changed;
    std::vector<std::pair<std::size_t, std::vector<Body>>> added;  // at an index, with the fragments behind it
    std::vector<Joint> joints;
    std::vector<std::uint32_t> joint_births;
    std::vector<std::uint8_t> joints_gone;
    std::uint32_t births = 0;
    std::vector<Vehicle> vehicles;
    std::vector<Exclusion> exclusions;
    Fields fields;
};

const std::vector<std::byte>& World::Impl::edits_now() const {
    if (!edits.empty()) return edits;
    ByteWriter out;
    out.put(std::uint64_t{bodies()});
    out.put_list(std::span(generations));
    out.put_list(std::span(gone));
    out.put_list(std::as_bytes(std::span(origins)));
    const std::vector<std::uint64_t> free_later(freed.begin(), freed.end());
    out.put_list(std::span(free_later));
    const auto is_of = [&](std::size_t i, Origin origin) { return (i < origins.size() ? origins[i] : Origin::start) == origin; };
    std::vector<std::uint64_t> changed, added;
    for (const auto& [i, body] : originals)
        if (is_of(i, Origin::start)) changed.push_back(i);
    for (std::size_t i = 0; i < origins.size(); ++i)
        if (is_of(i, Origin::added)) added.push_back(i);
    out.put_list(std::span<const std::uint64_t>(changed));
    for (const std::uint64_t i : changed)
        schema::for_each_field<Body>([&](const auto& field) {
            if constexpr (!std::is_same_v<decltype(field.member), Shape Body::*>) put_value(out, scene.bodies[i].*field.member);
        });
    out.put_list(std::span<const std::uint64_t>(added));
    for (const std::uint64_t i : added) put_value(out, scene.bodies[i]);
    put_value(out, scene.joints);
    out.put_list(std::span(joint_births));
    out.put_list(std::span(joints_gone));
    out.put(births);
    put_value(out, scene.vehicles);
    put_value(out, scene.exclusions);
    put_value(out, scene.fields);
    edits = std::move(out.bytes());
    return edits;
}

World::Impl::Edits World::Impl::read_edits(std::span<const std::byte> bytes) const {
    ByteReader in(bytes);
    Edits made;
    made.bodies = in.take<std::uint64_t>();
    made.generations = in.take_list<std::uint32_t>();
    made.gone = in.take_list<std::uint8_t>();
    made.origins = in.take_list<std::uint8_t>();
    made.freed = in.take_list<std::uint64_t>();
    for (const std::uint64_t index : in.take_list<std::uint64_t>()) {
        Body& body = made.changed.emplace_back(index, Body{}).second;
        schema::for_each_field<Body>([&](const auto& field) {
            if constexpr (!std::is_same_v<decltype(field.member), Shape Body::*>) take_value(in, body.*field.member);
        });
    }
    for (const std::uint64_t index : in.take_list<std::uint64_t>()) {
        Scene one;
        one.gravity = scene.gravity;
        take_value(in, one.bodies.emplace_back());
        try {
            one = checked(std::move(one));
        } catch (const SceneError& error) {
            refuse(std::string("the checkpoint is damaged: ") + error.what());
        }
        for (Body& body : one.bodies) {
            if (body.piece_of != no_body) body.piece_of += index;
            if (body.fracture) body.fracture->first_piece += index;
        }
        if (index + one.bodies.size() > made.bodies) refuse("the checkpoint is damaged: it has a body behind the last one");
        made.added.emplace_back(index, std::move(one.bodies));
    }
    take_value(in, made.joints);
    made.joint_births = in.take_list<std::uint32_t>();
    made.joints_gone = in.take_list<std::uint8_t>();
    made.births = in.take<std::uint32_t>();
    if (made.joint_births.size() != made.joints_gone.size() || made.joint_births.size() > made.joints.size())
        refuse("the checkpoint is damaged: its joints do not fit together");
    take_value(in, made.vehicles);
    take_value(in, made.exclusions);
    take_value(in, made.fields);
    check_edits(made, bodies_at_start);
    return made;
}

void World::Impl::check_edits(Edits& made, std::size_t bodies_at_start) {
    const auto require = [](bool holds, const char* reason) {
        if (!holds) refuse(std::string("the checkpoint is damaged: ") + reason);
    };
    const std::size_t bodies = made.bodies;
    require(bodies >= bodies_at_start, "it lacks bodies of the scene");
    require(made.generations.size() <= bodies && made.gone.size() == made.generations.size() &&
                made.origins.size() == made.generations.size(),
            "its lists of bodies do not fit together");
    for (const std::uint8_t origin : made.origins)
        require(origin <= static_cast<std::uint8_t>(Origin::none), "a body has an origin that is not known");
    for (const std::uint64_t index : made.freed) require(index < bodies, "it frees a body behind the last one");
    const auto is_joined = [&](std::size_t body) { return body == the_world || body < bodies; };
    for (const Joint& joint : made.joints) {
        const Coupling* const coupling = std::get_if<Coupling>(&joint.kind);
        require(is_joined(joint.a) && is_joined(joint.b) && (coupling || joint.a != joint.b),
                "a joint is of a body that is none");
        for (std::size_t t = 0; coupling && t < coupling->joints.size(); ++t)
            require(coupling->joints[t].joint < made.joints.size(), "a coupling is of a joint that is none");
    }
    for (const Vehicle& vehicle : made.vehicles) {
        require(vehicle.chassis < bodies, "a vehicle has a chassis that is none");
        for (const Wheel& wheel : vehicle.wheels) require(wheel.joint < made.joints.size(), "a wheel is on a joint that is none");
    }
    for (const Exclusion& one : made.exclusions) require(one.a < bodies && one.b < bodies, "it excludes a body that is none");
    try {
        for (auto& [index, body] : made.changed) {
            require(index < bodies_at_start, "it changes a body that the scene lacks");
            schema::check_fields(Examination{}, body);
        }
        check_world_fields(made.fields);
    } catch (const SceneError& error) {
        refuse(std::string("the checkpoint is damaged: ") + error.what());
    }
}

void World::Impl::check_own(Own& own, std::size_t bodies) {
    const auto require = [&](std::uint64_t body, const char* what) {
        if (body >= bodies) refuse(std::string("the checkpoint is damaged: it ") + what + " body " + std::to_string(body));
    };
    for (const auto& [body, action] : own.actions) require(body, "acts on");
    for (const std::optional<Held>& grip : own.grips)
        if (grip) require(grip->body, "holds");
    for (const auto& [body, step] : own.arrivals) require(body, "moves");
    try {
        own.settings = checked(own.settings);
    } catch (const std::exception& error) {
        refuse(std::string("the checkpoint is damaged: ") + error.what());
    }
}

void World::Impl::take_edits(Edits&& made, std::span<const std::byte> bytes) {
    // Back to the start,
    scene.bodies.resize(bodies_at_start);
    for (auto& [i, body] : originals) {
        const bool replaced = i < origins.size() && origins[i] != Origin::start;
        if (!replaced) body.shape = std::move(scene.bodies[i].shape);
        scene.bodies[i] = std::move(body);
    }
    originals.clear();
    origins.clear();
    gone.clear();
    // and from there.
    for (auto& [i, body] : made.changed) {
        keep_original(i);
        body.shape = std::move(scene.bodies[i].shape);
        body.piece_of = scene.bodies[i].piece_of;
        if (body.fracture) body.fracture = scene.bodies[i].fracture;  // with its cut
        scene.bodies[i] = std::move(body);
    }
    scene.bodies.resize(made.bodies);
    generations = std::move(made.generations);
    gone = std::move(made.gone);
    for (const std::uint8_t origin : made.origins) origins.push_back(static_cast<Origin>(origin));
    free_indices.clear();
    freed.assign(made.freed.begin(), made.freed.end());
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (i < bodies_at_start && origins[i] != Origin::start) originals[i] = std::move(scene.bodies[i]);
        if (origins[i] == Origin::none) scene.bodies[i] = no_longer_there();
    }
    for (auto& [first, family] : made.added)
        std::move(family.begin(), family.end(), scene.bodies.begin() + static_cast<std::ptrdiff_t>(first));
    std::vector<std::size_t> later = std::exchange(freed, {});
    for (std::size_t i = 0; i < origins.size(); ++i)
        if (origins[i] == Origin::none && std::find(later.begin(), later.end(), i) == later.end()) freed.push_back(i);
    release_indices();
    freed = std::move(later);
    scene.joints = std::move(made.joints);
    joint_births = std::move(made.joint_births);
    joints_gone = std::move(made.joints_gone);
    births = made.births;
    scene.vehicles = std::move(made.vehicles);
    scene.exclusions = std::move(made.exclusions);
    scene.fields = std::move(made.fields);
    edits.assign(bytes.begin(), bytes.end());
}

// Where the tables have the shapes of added bodies, so that further ones share them.
void World::Impl::find_shapes_again() {
    ShapePlaces& places = state.shape_places;
    std::erase_if(places.hulls, [&](const auto& one) { return one.second >= shapes_at_start.hulls; });
    std::erase_if(places.tyres, [&](const auto& one) { return one.second > shapes_at_start.tyres; });
    std::erase_if(places.cuts, [&](const auto& one) { return one.second >= shapes_at_start.pieces; });
    for (std::size_t i = shapes_at_start.tyres; i < state.tyres.size(); ++i)
        places.tyres.try_emplace({state.tyres[i].best_slip, state.tyres[i].sliding}, static_cast<physics::uint>(i + 1));
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (origins[i] == Origin::start || origins[i] == Origin::none) continue;
        const physics::BodyProperties& row = state.properties[state.row_of(i)];
        if (const auto* hull = std::get_if<Hull>(&scene.bodies[i].shape)) places.hulls.try_emplace(hull->form, row.shape_data);
        if (scene.bodies[i].fracture && row.fracture < state.fractures.size())
            places.cuts.try_emplace(scene.bodies[i].fracture->cut, state.fractures[row.fracture].first_pose);
    }
}

void World::Impl::put_world(ByteWriter& out) const {
    for_each_setting(settings, [&](const auto& value) { out.put(value); });
    out.put(scene.gravity);
    out.put(steps);
    out.put(reorder_now);
    out.put(std::uint64_t{actions.size()});
    for (const auto& [body, action] : actions) {
        out.put(std::uint64_t{body});
        out.put(action);
    }
    for (const std::optional<Held>& grip : grips) {
        out.put(grip.has_value());
        if (!grip) continue;
        out.put(std::uint64_t{grip->body});
        out.put(grip->anchor);
        out.put(grip->target);
        out.put(grip->spring);
    }
    out.put(std::uint64_t{arrivals.size()});
    for (const auto& [body, step] : arrivals) out.put(std::uint64_t{body}), out.put(step);
    events.put(out);
}

World::Impl::Own World::Impl::take_world(ByteReader& in) {
    Own own;
    for_each_setting(own.settings, [&](auto& value) { value = in.take<std::remove_reference_t<decltype(value)>>(); });
    own.gravity = in.take<vec3>();
    own.steps = in.take<std::uint64_t>();
    own.reorder_now = in.take<bool>();
    for (auto left = in.take<std::uint64_t>(); left > 0; --left) {
        const auto body = in.take<std::uint64_t>();
        own.actions[body] = in.take<physics::Action>();
    }
    for (auto& grip : own.grips) {
        if (!in.take<bool>()) continue;
        grip = std::remove_reference_t<decltype(*grip)>{};
        grip->body = in.take<std::uint64_t>();
        grip->anchor = in.take<vec3>();
        grip->target = in.take<vec3>();
        grip->spring = in.take<GripSpring>();
    }
    for (auto left = in.take<std::uint64_t>(); left > 0; --left) {
        const auto body = in.take<std::uint64_t>();
        own.arrivals[body] = in.take<std::uint64_t>();
    }
    own.events.restore(in);
    return own;
}

void World::Impl::put(ByteWriter& out, SteppedTables which) const {
    out.put_list(std::span(edits_now()));
    put_world(out);
    put_state(out, state, shapes_at_start, which);
}

void World::Impl::take(std::span<const std::byte> bytes, SteppedTables which, std::size_t slot) {
    ByteReader reader(bytes);
    const auto edited = reader.take_records(1);
    std::optional<Edits> made;  // none if the scene is the same
    const std::vector<std::byte>& now = edits_now();
    if (edited.size() != now.size() || std::memcmp(edited.data(), now.data(), now.size()) != 0) made = read_edits(edited);
    Own own = take_world(reader);
    const StateBytes tables(reader, state, shapes_at_start, which);
    if (!reader.at_end()) refuse("the checkpoint is damaged: it has more bytes than it should");
    if (tables.bodies() != (made ? made->bodies : scene.bodies.size()) ||
        tables.joints() != (made ? made->joints : scene.joints).size() ||
        tables.vehicles() != (made ? made->vehicles : scene.vehicles).size())
        refuse("the checkpoint is damaged: its tables are not of its bodies, joints and vehicles");
    check_own(own, tables.bodies());
    if (!tables.follow_from(own.settings, own.gravity)) refuse("the checkpoint is damaged: its tables are not of its settings");
    if (!own.events.fits(tables.rows(), tables.first_part()))
        refuse("the checkpoint is damaged: it has events of rows that are none");
    still = {};
    broken = true;  // until it is done
    if (made) take_edits(std::move(*made), edited);
    settings = own.settings;
    scene.gravity = own.gravity;
    steps = own.steps;
    reorder_now = own.reorder_now;
    actions = std::move(own.actions);
    grips = own.grips;
    arrivals = std::move(own.arrivals);
    events = std::move(own.events);
    state.sums_impulses = events.settings().contacts;
    const TableLengths before = TableLengths::of(state);
    const int substeps_before = state.substeps;
    const TableRanges changed = tables.restore(state);
    scene.periodic = periodic_cell(state.fixed());
    if (made) find_shapes_again();
    find_spare_hulls();
    if (which == SteppedTables::all || state.substeps != substeps_before || TableLengths::of(state) != before) runner->adapt();
    runner->upload(changed);
    if (which == SteppedTables::on_device) runner->bring_back(slot);
    ++arrangements;
    ++changes;
    broken = false;
}

std::vector<std::byte> World::save() const {
    const Impl& in = whole();
    in.runner->download(lasting_ranges(in.state));
    ByteWriter out;
    out.put(head_of(in.fingerprint, in.steps));
    in.put(out, SteppedTables::all);
    seal_checkpoint(out.bytes());
    return std::move(out.bytes());
}

void World::save_in_pieces(const TakePiece& take) const {
    const Impl& in = local();
    if (in.shared) return in.put_shares(take);
    const std::vector<std::byte> all = save();
    if (!in.ranks || in.ranks->exchange().rank() == 0) take(0, all);
}

void World::Impl::put_shares(const TakePiece& take) const {
    const bool first = ranks->exchange().rank() == 0;
    ranks->download_share();
    const StateParts parts(state, ranks->exchange());
    ByteWriter front, back;
    front.put_list(std::span<const std::byte>(edits));  // since the shares were made
    put_world(front);
    put_numbers(front, state, parts.parameters(), parts.counts(), parts.rows_bounce());
    put_shapes(back, state, shapes_at_start);
    Head head = head_of(fingerprint, steps);
    head.bytes = front.bytes().size() + parts.bytes() + back.bytes().size();
    std::uint64_t at = 0;
    XXH64_state_t hash;
    XXH64_reset(&hash, seed_of(head));
    const auto put_piece = [&](std::span<const std::byte> bytes) {
        if (!first || bytes.empty()) return;
        if (at > 0) XXH64_update(&hash, bytes.data(), bytes.size());
        take(at, bytes);
        at += bytes.size();
    };
    put_piece(std::as_bytes(std::span(&head, 1)));
    put_piece(front.bytes());
    parts.put_tables(put_piece);
    put_piece(back.bytes());
    if (!first) return;
    head.hash = XXH64_digest(&hash);
    take(0, std::as_bytes(std::span(&head, 1)));
}

void seal_checkpoint(std::span<std::byte> state) {
    Head head;
    std::memcpy(&head, state.data(), sizeof head);
    head.bytes = state.size() - sizeof head;
    head.hash = hash_of(head, state.subspan(sizeof head));
    std::memcpy(state.data(), &head, sizeof head);
}

CheckpointInfo inspect_checkpoint(std::span<const std::byte> state) {
    const Head head = checked_head(state);
    return {head.steps, head.scene};
}

void World::restore(std::span<const std::byte> saved) {
    Impl& in = whole();
    const Head head = checked_head(saved);
    if (head.scene != in.fingerprint)
        refuse("the checkpoint is of another scene: its fingerprint is " + hash_text(head.scene) + ", this scene's " +
               hash_text(in.fingerprint));
    in.take(saved.subspan(sizeof head), SteppedTables::all);
    in.drop_kept();
}

void restore_tables(State& state, std::span<const std::byte> saved) {
    const Head head = checked_head(saved);
    if (const std::uint64_t here = fingerprint_of(state); head.scene != here)
        refuse("the checkpoint is of another scene: its fingerprint is " + hash_text(head.scene) + ", this scene's " +
               hash_text(here));
    ByteReader reader(saved.subspan(sizeof head));
    (void)reader.take_records(1);  // edits of the scene: their bodies are in the tables
    (void)World::Impl::take_world(reader);
    StateBytes(reader, state, StartLengths::of(state)).restore(state);
}

}  // namespace scree
