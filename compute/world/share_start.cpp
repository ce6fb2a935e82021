// Compiling a rank's first share of a scene whose bodies come one after the other.
#define XXH_STATIC_LINKING_ONLY
#include "compute/world/share_start.h"

#include <xxhash.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/tables/memory_order.h"
#include "compute/world/states/state_bytes.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/contact/material.h"

namespace scree {

namespace {

struct Unfit {};  // ends a survey

// XXH64 of a table whose records come one after the other.
class TableHash {
public:
    explicit TableHash(std::uint64_t seed) { XXH64_reset(&state_, seed); }
    template <class Record>
    void add(const Record& record) {
        XXH64_update(&state_, &record, sizeof record);
    }
    std::uint64_t digest() const { return XXH64_digest(&state_); }

private:
    XXH64_state_t state_;
};

bool is_convex(const Body& body) {
    return !std::holds_alternative<Compound>(body.shape) && !std::holds_alternative<Mesh>(body.shape) &&
           !std::holds_alternative<HeightField>(body.shape);
}

Scene without_bodies(const Scene& scene) {
    Scene head;
    head.gravity = scene.gravity;
    head.fields = scene.fields;
    return checked(std::move(head));
}

}  // namespace

ShareStart::ShareStart(const StreamedScene& scene, const Settings& settings, std::uint32_t group_size, std::uint32_t ranks)
    : from_(scene),
      settings_(settings),
      ranks_(ranks),
      scene_(without_bodies(scene.scene)),
      state_(scene_, settings, group_size, false, 0, ranks) {}

// What Share::can_be_made (compute/distributed/share.h) asks of the state, of one body.
bool ShareStart::can_keep_still(const Body& body) const {
    return !body.fracture && body.piece_of == no_body && !has_filter(body) &&
           (body.motion == Motion::fixed || (is_convex(body) && !body.tyre));
}

void ShareStart::keep_still(Body body, std::uint32_t id) {
    Body& kept = still_.emplace(id, std::move(body)).first->second;  // where meshes stay
    validation_.check(kept, id);
    still_rows_[id] = static_cast<std::uint32_t>(still_rows_.size());
    state_.properties.push_back(SceneCompiler(state_).properties_of(kept, id));
}

bool ShareStart::survey() {
    const Scene& whole = from_.scene;
    if (!whole.joints.empty() || !whole.vehicles.empty() || !whole.exclusions.empty() || !whole.bonds.empty() ||
        whole.fields.any() || whole.periodic.any())
        return false;
    state_.properties.clear();  // tables of no bodies have a record all the same
    state_.hulls.clear();
    TableHash hash(0);
    const auto note = [&](physics::BodyProperties row) {
        layout_.note_width(row, state_.fixed());
        row.flags &= ~physics::ROW_LARGE;
        hash.add(row);
    };
    std::uint32_t id = 0;
    const auto take = [&](Body body) {
        if (!can_keep_still(body)) throw Unfit{};
        if (body.motion != Motion::dynamic) {
            keep_still(std::move(body), id);
            note(state_.properties.back());
        } else {
            validation_.check(body, id);
            const physics::BodyProperties row = SceneCompiler(state_).properties_of(body, id);
            if (!is_convex(body) || physics::surface_of(row) != 0) throw Unfit{};
            state_.note_content(std::span(&row, 1));
            note(row);
        }
        ++id;
    };
    try {
        from_.for_each_body(take);
    } catch (const Unfit&) {
        return false;
    }
    if (id == 0) return false;
    bodies_ = id;
    for (const auto& [still, body] : still_) SceneCompiler(state_).append_parts(body, still_rows_.at(still));
    lay_out_still();
    for (std::uint32_t row = state_.fixed().first_part; row < state_.fixed().bodies; ++row) {
        physics::BodyProperties part = state_.properties[row];
        part.owner = state_.properties[part.owner].owner;  // an id as yet
        note(part);
    }
    layout_.choose_cell(state_.fixed());
    hash_ = hash.digest();
    return true;
}

void ShareStart::lay_out_still() {
    physics::Parameters& p = state_.fixed();
    const auto rows = static_cast<std::uint32_t>(state_.properties.size()), still = static_cast<std::uint32_t>(still_.size());
    p.bodies = rows;
    p.first_part = still;
    p.buckets = State::buckets_for(rows);
    set_first_capacities(p, settings_, static_cast<std::uint32_t>(bodies_), ranks_);
    state_.allocate();
    for (const auto& [id, body] : still_) {
        const std::uint32_t row = still_rows_.at(id);
        state_.poses[row] = SceneCompiler::start_of(body);
        state_.velocities[row] = SceneCompiler::start_velocity_of(body);
    }
    for (std::uint32_t row = still; row < rows; ++row) SceneCompiler(state_).place(row);
    state_.note_content(0, rows);
    state_.counted() = physics::emptied(state_.counted(), p);
}

void ShareStart::for_each(const std::function<void(Body&, std::uint32_t)>& visit,
                          const std::function<void(std::uint32_t)>& pass) {
    std::uint32_t id = 0;
    const auto take = [&](Body body) {
        if (id >= bodies_) throw std::logic_error("a streamed scene gave more bodies when it was asked again");
        if (still_.contains(id)) {
            pass(id);
        } else {
            validation_.check(body, id);
            visit(body, id);
        }
        ++id;
    };
    for (const Body& body : from_.scene.bodies)
        if (still_.contains(id))
            pass(id++);  // no copy of a mesh
        else
            take(body);
    if (from_.others) from_.others(take);
    if (id != bodies_) throw std::logic_error("a streamed scene gave fewer bodies when it was asked again");
}

std::vector<std::uint64_t> ShareStart::find_places() {
    std::vector<std::uint64_t> places;
    TableHash hash(hash_);
    const physics::Parameters& p = state_.fixed();
    for_each(
        [&](const Body& body, std::uint32_t id) {
            const physics::Pose pose = SceneCompiler::start_of(body);
            places.push_back(place_on_curve(pose.position, p.inverse_cell));
            hash.add(pose);
            layout_.note_level(SceneCompiler(state_).properties_of(body, id));
        },
        [&](std::uint32_t id) {
            hash.add(state_.poses[still_rows_.at(id)]);
            layout_.note_level(state_.properties[still_rows_.at(id)]);
        });
    for (std::uint32_t row = p.first_part; row < p.bodies; ++row) {
        hash.add(state_.poses[row]);
        layout_.note_level(state_.properties[row]);
    }
    layout_.choose_levels();
    hash_ = hash.digest();
    return places;
}

std::vector<int> ShareStart::keep_own(const std::vector<std::uint64_t>& borders, int rank,
                                      const std::function<void(const Body&, std::size_t)>& see) {
    const physics::Parameters& p = state_.fixed();
    const auto owner_at = [&](std::uint64_t place) {
        return static_cast<int>(std::upper_bound(borders.begin(), borders.end(), place) - borders.begin());
    };
    std::vector<int> owners(bodies_);
    TableHash hash(hash_);
    const auto with_level = [&](physics::BodyProperties row) {
        if (layout_.is_large(row)) row.flags |= physics::ROW_LARGE;
        return row;
    };
    for_each(
        [&](const Body& body, std::uint32_t id) {
            const physics::Velocity velocity = SceneCompiler::start_velocity_of(body);
            hash.add(velocity);
            see(body, id);
            const physics::Pose pose = SceneCompiler::start_of(body);
            const std::uint64_t place = place_on_curve(pose.position, p.inverse_cell);
            owners[id] = owner_at(place);
            if (owners[id] != rank) return;
            own_.push_back({place, id, with_level(SceneCompiler(state_).properties_of(body, id)), pose, velocity});
        },
        [&](std::uint32_t id) {
            const std::uint32_t row = still_rows_.at(id);
            hash.add(state_.velocities[row]);
            see(still_.at(id), id);
            owners[id] = owner_at(place_on_curve(state_.poses[row].position, p.inverse_cell));
        });
    for (std::uint32_t row = p.first_part; row < p.bodies; ++row) hash.add(state_.velocities[row]);
    hash_ = fingerprint_of(state_, hash.digest());
    std::sort(own_.begin(), own_.end(),
              [](const OwnBody& a, const OwnBody& b) { return std::tie(a.place, a.id) < std::tie(b.place, b.id); });

    // The state's rows become those of a share, with none of dynamic bodies yet.
    for (physics::BodyProperties& row : state_.properties) row = with_level(row);
    std::vector<std::uint32_t> rows(bodies_, physics::NONE);
    for (const auto& [id, row] : still_rows_) {
        rows[id] = row;
        state_.ids[row] = static_cast<std::uint32_t>(id);
        state_.properties[row].owner = row;
    }
    for (std::uint32_t part = 0; part < part_rows(); ++part)
        state_.ids[p.first_part + part] = static_cast<std::uint32_t>(bodies_) + part;
    state_.first_part_id = state_.body_count = static_cast<std::uint32_t>(bodies_);
    state_.assign_rows(std::move(rows));
    return owners;
}

std::vector<std::uint32_t> ShareStart::own_ids() const {
    std::vector<std::uint32_t> ids;
    for (const OwnBody& body : own_) ids.push_back(body.id);
    return ids;
}

void ShareStart::put_own(State& state) const {
    for (const OwnBody& body : own_) {
        const std::uint32_t row = state.row_of(body.id);
        state.properties[row] = body.properties;
        state.properties[row].owner = row;
        state.poses[row] = body.pose;
        state.velocities[row] = body.velocity;
    }
}

}  // namespace scree
