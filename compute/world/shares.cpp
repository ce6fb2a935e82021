// World on several ranks: while it only steps, each rank holds its share of the scene and of the tables (Ranks::share_out).
//
// Of the scene a rank keeps the bodies that do not move, and those of a range of ids: it is their home. What is asked of all
// bodies in the order of ids, hashes and sums, is found there. All else brings the whole world back to every rank.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <algorithm>
#include <utility>

#include "compute/distributed/packing.h"
#include "compute/world/share_start.h"
#include "compute/world/states/scene_bytes.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

// Steps without a look at the whole world after which it is shared out again.
constexpr int steps_to_share = 8;

struct TravellingBody {
    std::uint32_t id = 0;
    BodyRecord now;
};

const HullForm* form_of(const Body& body) {
    const Hull* hull = std::get_if<Hull>(&body.shape);
    return hull ? hull->form.get() : nullptr;
}

}  // namespace

void World::share_out() {
    Impl& in = local();
    if (in.ranks && !in.shared && in.can_be_shared()) in.share_out();
}

std::optional<World::Share> World::share() const {
    const Impl& in = local();
    if (!in.shared) return std::nullopt;
    in.ranks->download_share();
    return Share{in.state, in.shared->still, in.shared->hulls};
}

bool World::Impl::can_be_shared() const {
    const auto is_dropped = [](const auto& grip) { return !grip.has_value(); };
    const auto is_plain = [](const Body& body) { return body.piece_of == no_body; };
    return actions.empty() && arrivals.empty() && freed.empty() && free_indices.empty() && !reorder_now &&
           !events.settings().any() && std::all_of(grips.begin(), grips.end(), is_dropped) && scene.joints.empty() &&
           scene.vehicles.empty() && scene.exclusions.empty() && state.body_count == state.fixed().first_part &&
           std::find(gone.begin(), gone.end(), std::uint8_t{1}) == gone.end() &&
           std::all_of(scene.bodies.begin(), scene.bodies.end(), is_plain) && ranks->can_share_out();
}

void World::Impl::share_out_when_due() {
    if (!ranks || shared) return;
    const bool waits = steps_until_shared > 0;
    if (waits || !can_be_shared()) {
        steps_until_shared = waits ? steps_until_shared - 1 : steps_to_share;
        return state.allocate_all();
    }
    share_out();
}

void World::Impl::share_out() {
    (void)edits_now();  // for checkpoints: from the whole scene
    ranks->share_out();
    Shared& own = shared.emplace();
    own.divide(scene.bodies.size(), ranks->exchange());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        own.note(scene.bodies[i], i);
        if (own.is_home(i)) own.home.push_back(std::move(scene.bodies[i]));
    }
    std::vector<Body>().swap(scene.bodies);  // its memory, too
}

void World::Impl::Shared::divide(std::size_t of_whole, const Exchange& exchange) {
    const auto ranks = static_cast<std::size_t>(exchange.ranks());
    bodies = of_whole;
    per_rank = (bodies + ranks - 1) / ranks;
    first = std::min(bodies, static_cast<std::size_t>(exchange.rank()) * per_rank);
}

void World::Impl::Shared::note(const Body& body, std::size_t id) {
    if (const HullForm* form = form_of(body); form && hull_places.try_emplace(form, hulls.size()).second)
        hulls.push_back(std::get<Hull>(body.shape));
    if (body.motion != Motion::dynamic) still[id] = body;
    if (const auto* plane = std::get_if<Plane>(&body.shape); plane && body.role == Role::solid) planes.push_back(*plane);
}

// Survey first: only with all bodies seen is it known that the world can be shared out.
std::unique_ptr<World::Impl> World::Impl::of_streamed(const StreamedScene& scene, const Settings& settings,
                                                      std::unique_ptr<Runner> runner) {
    const Settings with = scree::checked(settings);
    if (Ranks* const ranks = runner->ranks()) {
        const Exchange& exchange = ranks->exchange();
        ShareStart start(scene, with, runner->group_size(), static_cast<std::uint32_t>(exchange.ranks()));
        if (start.survey()) {
            Shared own;
            own.divide(start.bodies(), exchange);
            const std::vector<std::uint64_t> borders = ranks->borders_of(start.find_places());
            std::vector<int> owners = start.keep_own(borders, exchange.rank(), [&](const Body& body, std::size_t id) {
                own.note(body, id);
                if (own.is_home(id)) own.home.push_back(body);
            });
            return std::make_unique<Impl>(start, with, std::move(runner), std::move(own), std::move(owners));
        }
    }
    return std::make_unique<Impl>(CopiedScene{scree::checked(scene.whole()), {}}, with, std::move(runner), 0);
}

World::Impl::Impl(ShareStart& start, const Settings& t, std::unique_ptr<Runner> r, Shared&& own, std::vector<int>&& owners)
    : scene(start.scene()),
      settings(t),
      runner(std::move(r)),
      state(std::move(start.state())),
      bodies_at_start(start.bodies()),
      shapes_at_start(StartLengths::of(state)),
      fingerprint(start.fingerprint()) {
    shared.emplace(std::move(own));
    (void)edits_now();
    ranks->attach_share(state, std::move(owners), start.own_ids(), [&] { start.put_own(state); });
}

void World::Impl::make_whole() {
    if (ranks && steps > 0) steps_until_shared = steps_to_share;
    if (runner->in_place()) state.allocate_all();
    if (!shared) return;
    ranks->make_whole();
    ByteWriter out;
    for (Body& body : shared->home) {
        if (body.motion != Motion::dynamic) continue;
        const HullForm* form = form_of(body);
        out.put(form ? static_cast<std::uint32_t>(shared->hull_places.at(form)) : physics::NONE);
        if (form) body.shape = Box{};
        put_value(out, body);
    }
    const std::vector<Bytes> received = ranks->exchange().all_gather(out.bytes());
    std::vector<Body> bodies(shared->bodies);
    for (auto& [id, body] : shared->still) bodies[id] = std::move(body);
    for (std::size_t r = 0; r < received.size(); ++r) {
        ByteReader in(received[r]);
        for (std::size_t id = r * shared->per_rank; !in.at_end(); ++id) {
            if (shared->still.contains(id)) continue;
            const auto hull = in.take<std::uint32_t>();
            take_value(in, bodies[id]);
            if (hull != physics::NONE) bodies[id].shape = shared->hulls[hull];
        }
    }
    scene.bodies = std::move(bodies);
    shared.reset();
}

// Of the bodies at home here, in the order of ids.
std::vector<BodyRecord> World::Impl::records_at_home() const {
    ranks->download_share();
    std::vector<Bytes> to(static_cast<std::size_t>(ranks->exchange().ranks()));
    std::vector<BodyRecord> records(shared->home.size());
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row)
        if (state.is_owned(row)) {
            const std::uint32_t id = state.id_of(row);
            scree::put(to[id / shared->per_rank], TravellingBody{id, BodyRecord::of(state, row)});
        }
    for (const auto& [id, body] : shared->still)
        if (id - shared->first < records.size()) records[id - shared->first] = BodyRecord::of(state, state.row_of(id));
    for (const Bytes& received : ranks->exchange().all_to_all(to))
        for (Unpacker from(received); from.has_more();) {
            const auto body = from.take<TravellingBody>();
            records.at(body.id - shared->first) = body.now;
        }
    return records;
}

// The hash passes from rank to rank, each of which adds the bodies at home there.
std::uint64_t World::Impl::hash_of_shares() const {
    std::vector<float> values;
    for (const BodyRecord& now : records_at_home()) append_hashed(values, now.pose, now.velocity);
    XXH64_state_t hash;
    XXH64_reset(&hash, 0);
    Exchange& exchange = ranks->exchange();
    for (int rank = 0; rank < exchange.ranks(); ++rank) {
        Bytes sent;
        if (rank == exchange.rank()) {
            XXH64_update(&hash, values.data(), values.size() * sizeof(float));
            scree::put(sent, hash);
        }
        Unpacker(exchange.all_gather(sent)[static_cast<std::size_t>(rank)]).take(hash);
    }
    return XXH64_digest(&hash);
}

Statistics World::Impl::statistics_of_shares() const {
    BodySums own;
    const std::vector<BodyRecord> records = records_at_home();
    for (std::size_t i = 0; i < records.size(); ++i)
        own.add(shared->home[i], records[i], scene.gravity, shared->planes, state.fixed().sleep_steps);
    Bytes sent;
    scree::put(sent, own);
    BodySums all;
    for (const Bytes& received : ranks->exchange().all_gather(sent)) all.add(Unpacker(received).take<BodySums>());
    Statistics found = all.statistics();
    found.spin_limited = state.counted().spin_limited;
    add_contacts(all_contact_sums(), found);
    return found;
}

}  // namespace scree
