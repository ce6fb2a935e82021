// World's implementation.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compute/distributed/ranks.h"
#include "compute/scene/copies.h"
#include "compute/scene/validation/joint_validation.h"
#include "compute/statistics.h"
#include "compute/tables/table_ranges.h"
#include "compute/world.h"
#include "compute/world/free_runs.h"
#include "compute/world/queries/events.h"
#include "compute/world/queries/query_scene.h"
#include "compute/world/states/state_bytes.h"

namespace scree {

class ShareStart;  // compute/world/share_start.h

std::string name_of(const Joint& joint, std::size_t index);  // for messages

struct World::Impl {
    struct Held {
        std::size_t body = 0;
        vec3 anchor{0}, target{0};
        GripSpring spring;
    };

    Scene scene;
    Settings settings;
    std::unique_ptr<Runner> runner;
    Ranks* const ranks = runner->ranks();  // null on one rank
    State state;
    std::map<std::size_t, physics::Action> actions;  // for the next step, by index of the body
    std::array<std::optional<Held>, most_grips> grips;
    std::uint64_t steps = 0;
    std::uint64_t growths = 0;
    std::size_t memory_limit = std::numeric_limits<std::size_t>::max();  // bytes of the tables
    bool reorder_now = false;                                            // requested by reorder()
    std::uint64_t reorderings = 0;
    double seconds_to_look = 0;  // duration of the last check of the memory order
    std::optional<std::chrono::steady_clock::time_point> looked;
    std::shared_ptr<Timeline> timeline;  // may be null
    bool broken = false;                 // left true by a step that threw: tables may be half grown
    // What the last steps found if no body stirred in them: their number, and the input of the last one.
    struct Stillness {
        int steps = 0;
        physics::Parameters parameters{};
        std::uint64_t uploaded = 0;
    };
    Stillness still;
    bool steps_ahead = false;  // of the runner's counts: steps were passed over

    // Bodies that came and went. By index, as far as one differs from the start: its generation, whether it is gone, and
    // where it is from.
    enum class Origin : std::uint8_t { start, added, fragment, none };
    std::vector<std::uint32_t> generations;
    std::vector<std::uint8_t> gone;
    std::vector<Origin> origins;
    FreeRuns<std::size_t> free_indices;
    std::vector<std::size_t> freed;  // since the last step; free after the next
    // The bodies of the start that were changed (without their shapes) or replaced.
    std::map<std::size_t, Body> originals;
    std::uint64_t arrangements = 0;
    // Joints that came and went. By index: the number of its birth, and whether it is gone.
    std::vector<std::uint32_t> joint_births;
    std::vector<std::uint8_t> joints_gone;
    std::uint32_t births = 0;
    // Kinematic bodies on the way to a target, and the step after which they stand still.
    std::map<std::size_t, std::uint64_t> arrivals;
    Events events;
    // The bodies as queries see them, made when they are needed; `changes` counts edits of poses, bodies and filters.
    std::uint64_t changes = 0;
    mutable std::shared_ptr<const QueryScene> queried;
    mutable std::pair<std::uint64_t, std::uint64_t> queried_at;
    const QueryScene& query_scene() const;
    QueryLists<Penetration> penetrations(std::span<const ShapeOverlap> queries, bool with_depths) const;

    // For checkpoints: what the world was made with, and the edits of the scene since, as bytes (empty: to be made).
    std::size_t bodies_at_start;
    StartLengths shapes_at_start;
    std::uint64_t fingerprint;
    mutable std::vector<std::byte> edits;

    Impl(CopiedScene s, const Settings& t, std::unique_ptr<Runner> r, std::size_t copies);
    // copies.cpp: what a reset puts back, by row, as bodies begin in the order of their ids; empty for a scene without copies.
    struct Start {
        std::vector<RowRecords> rows;
        std::vector<physics::Vehicle> vehicles;
    };
    Start start;
    std::size_t copies() const { return state.fixed().copies; }
    void keep_start();
    void require_copy(std::size_t copy) const;             // throws std::out_of_range
    void require_one_copy(const std::string& what) const;  // throws std::logic_error
    void require_copies(const std::string& what) const;    // likewise
    std::size_t copy_of(std::size_t body) const { return state.has_copies() ? body / state.fixed().bodies_of_copy : 0; }
    vec3 gravity_of(std::size_t copy) const;
    void set_gravities(const std::vector<vec3>& gravities);  // of all copies
    void wake_copy(std::size_t copy);
    void wake_copy_of(std::size_t body) { wake_copy(copy_of(body)); }
    TableRanges rows_of_copies(std::span<const std::size_t> which, const std::vector<Table>& tables) const;
    void reset_joints(std::size_t copy, TableRanges& changed);
    void reset(std::span<const std::size_t> which);
    Scene snapshot(std::optional<std::size_t> copy) const;
    void step();
    // Steps in which no body can stir change nothing but their number, and are passed over.
    bool is_still() const;
    physics::Parameters lasting_parameters() const;
    void note_stillness();  // after a step
    void pass_over(int count);
    void catch_up();             // before a step that is not
    int steps_alone(int count);  // up to `count` steps without actions; 0 while a grip is held. Returns their number
    bool keeps_order() const;    // whether bodies are reordered in memory
    void begin_in_order();
    void move_to(const std::vector<std::uint32_t>& rows);                  // by id
    void keep_order();                                                     // between steps
    void tell_timeline(Timeline::Time begin, std::uint64_t steps_before);  // of steps that have ended
    void make_room_for_actions();
    void make_room_for_lists();  // and requests repetition of the step
    template <class Attempt>
    void step_with_room(const Attempt& attempt);
    std::string beyond_memory(std::size_t needed) const;  // the message; needed: bytes of tables
    std::string most_paired_body() const;                 // for messages
    void require_body(std::size_t body) const;  // throws std::out_of_range for an index that none has, or a removed body
    physics::Action& action_on(std::size_t body, vec3 value, vec3 second, bool kinematic_too = false);
    physics::Action& change_velocity(std::size_t body, const physics::Velocity& before);  // of a kinematic body
    void jump_to_velocity(std::size_t body);
    BodyState body_state(std::size_t i) const;
    // Downloads these ranges of the tables.
    void bring(TableRanges (*ranges)(const State&)) const { runner->download(ranges(state)); }

    ContactSums all_contact_sums() const;

    // shares.cpp
    struct Shared {
        Shared() {}  // clang knows no initialisers of members before the enclosing class ends
        std::size_t bodies = 0, per_rank = 0, first = 0;  // of the whole scene; at home on each rank; the first at home here
        std::vector<Body> home;
        std::map<std::size_t, Body> still;  // all that are not dynamic
        std::vector<Plane> planes;          // likewise
        std::vector<Hull> hulls;            // of all bodies, each once
        std::map<const HullForm*, std::size_t> hull_places;
        void divide(std::size_t of_whole, const Exchange& exchange);
        void note(const Body& body, std::size_t id);  // for all bodies, in the order of ids
        bool is_home(std::size_t id) const { return id >= first && id < first + per_rank; }
    };
    // Begins shared out.
    Impl(ShareStart& start, const Settings& t, std::unique_ptr<Runner> r, Shared&& own, std::vector<int>&& owners);
    static std::unique_ptr<Impl> of_streamed(const StreamedScene& scene, const Settings& settings,
                                             std::unique_ptr<Runner> runner);
    std::optional<Shared> shared;  // while this rank has its share alone
    int steps_until_shared = 0;
    bool can_be_shared() const;
    void share_out_when_due();  // before a step
    void share_out();
    void make_whole();
    std::size_t bodies() const { return shared ? shared->bodies : scene.bodies.size(); }
    std::vector<BodyRecord> records_at_home() const;
    std::uint64_t hash_of_shares() const;
    Statistics statistics_of_shares() const;

    // joints.cpp
    void require_joint_index(std::size_t joint) const;  // throws std::out_of_range
    void require_joint(std::size_t joint) const;        // likewise for one that was removed
    JointState joint_state(std::size_t i) const;
    // Rebuilds the joint records from the scene; those of `fresh` joints are new, not those of joints that had their indices.
    void rejoin(std::optional<std::size_t> without = std::nullopt, std::span<const std::size_t> fresh = {});
    void check_new_joints(std::span<const std::size_t> joints);
    std::vector<std::size_t> couplings_of(std::span<const std::size_t> joints) const;  // that are there
    void require_uncoupled(std::span<const std::size_t> joints) const;  // but by each other; throws std::invalid_argument
    void take_away_joint(std::size_t joint);
    std::optional<std::size_t> place_of_joint(const JointHandle& joint);
    void count_joints();  // lengthens the lists by index
    bool is_joint_gone(std::size_t joint) const { return joint < joints_gone.size() && joints_gone[joint]; }
    void apply_joint_force(const JointForce& one);
    void wake(const Joint& joint);  // wakes its bodies in the next step
    struct AxisChange {
        std::size_t joint = 0;
        JointAxis axis = JointAxis::twist;
        std::function<void(Axis&)> change;
    };
    void set_axes(std::span<const AxisChange> changes);
    // joint_coordinates.cpp
    void set_joint_coordinates(std::span<const JointCoordinate> coordinates);

    // vehicles.cpp
    void require_vehicle(std::size_t vehicle) const;  // throws std::out_of_range
    void require_no_wheel(std::size_t joint) const;   // throws std::invalid_argument for a wheel's joint
    void tell(std::size_t vehicle, const Controls& controls, bool by_route);
    VehicleState vehicle_state(std::size_t index) const;
    // Adds the present vehicles to a snapshot; indices map bodies and joints into it (no_body: gone).
    void keep_vehicles(Scene& snapshot, const std::vector<std::size_t>& bodies, const std::vector<std::size_t>& joints) const;

    // editing.cpp
    Held& held(std::size_t grip);  // throws std::out_of_range
    void take_up_grips();          // writes the grips to the parameters of the next step
    void retune(const Settings& changed);
    void require_room_in_cell() const;  // throws std::domain_error
    void stretch_cell();                // after a step

    // bodies.cpp
    bool is_gone(std::size_t body) const { return body < gone.size() && gone[body]; }
    void count_bodies();  // lengthens the lists by index
    std::size_t take_indices(std::size_t count);
    void free_index(std::size_t body);
    std::string name_of_body(std::size_t body) const;  // for messages
    static Body no_longer_there();                     // in the place of a removed body
    void release_indices();                            // after a step
    std::vector<std::vector<Body>> checked_families(std::span<const Body> bodies) const;
    void remove(std::vector<std::size_t> bodies);
    void require_removable(const std::vector<std::size_t>& bodies) const;
    TableRanges break_bonds_of(const std::vector<std::size_t>& bodies);  // ascending
    TableRanges break_joints_of(const std::vector<std::size_t>& bodies);
    TableRanges free_families_of(const std::vector<std::size_t>& bodies);
    void keep_original(std::size_t body);
    // hull_room.cpp: records of the table of hulls that no body uses any more
    FreeRuns<std::uint32_t> spare_hulls;
    std::map<std::uint32_t, std::uint32_t> hulls_of_added(const std::vector<std::uint32_t>& bodies) const;
    void free_hulls(std::map<std::uint32_t, std::uint32_t> records);  // after the bodies are removed
    void pack_hulls(std::size_t before, std::uint32_t body, TableRanges& changed);
    void find_spare_hulls();
    void send(const TableRanges& changed, const TableLengths& before);
    void begin_impacts(const SceneFeatures& before);
    // change_bodies.cpp
    void require_there(std::size_t body) const;  // throws std::invalid_argument for a body that has broken, or a fragment
    void set(std::span<const BodyChange> bodies);
    void change(std::size_t body, const std::function<void(Body&)>& edit, bool wakes_all);
    void refilter(std::size_t body);
    int steps_until_arrival() const;
    void stop_arrived();  // before a step: the bodies that have reached their targets
    void require_reachable(const BodyTarget& target) const;

    // checkpoint.cpp
    struct Edits;
    struct Own;
    const std::vector<std::byte>& edits_now() const;
    Edits read_edits(std::span<const std::byte> bytes) const;
    static void check_edits(Edits& made, std::size_t bodies_at_start);  // throws CheckpointError for indices that lead nowhere
    static void check_own(Own& own, std::size_t bodies);                // likewise
    void take_edits(Edits&& made, std::span<const std::byte> bytes);
    void find_shapes_again();
    void put_world(ByteWriter& out) const;
    static Own take_world(ByteReader& in);
    void put(ByteWriter& out, SteppedTables which) const;
    void put_shares(const TakePiece& take) const;  // on all ranks
    // Throws CheckpointError, changing nothing. `slot`: where the runner keeps what is `on_device`.
    void take(std::span<const std::byte> bytes, SteppedTables which, std::size_t slot = 0);

    // rollback.cpp
    struct Kept {
        std::uint64_t steps = 0;
        std::size_t slot = 0;  // of the runner
        std::vector<std::byte> bytes;
    };
    std::vector<Kept> kept;                           // ascending by steps
    std::vector<std::vector<std::byte>> kept_memory;  // of states that rollbacks left behind, for the next ones
    SteppedTables kept_by_host() const { return runner->in_place() ? SteppedTables::all : SteppedTables::on_device; }
    void drop_kept();
};

}  // namespace scree
