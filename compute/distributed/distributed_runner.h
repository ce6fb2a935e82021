// The distributed runner: a rank's part of a step of a world that several ranks share, with the bits of one world.
//
// Every rank moves the bodies that it owns (ownership.h), and has the tables of the whole scene or its share of them (share.h). A
// contact at a border is solved on both sides from the same inputs: a pair is listed where one end is owned, bodies of other
// ranks near a border are here as ghosts (halo.h), and ids decide the order of every sum. What one rank cannot know, ranks
// exchange between the plan's stages, at the sync points.
#pragma once

#include <memory>
#include <vector>

#include "compute/distributed/border.h"
#include "compute/distributed/device_side.h"
#include "compute/distributed/exchange.h"
#include "compute/distributed/halo.h"
#include "compute/distributed/ownership.h"
#include "compute/distributed/ranks.h"
#include "compute/distributed/share.h"
#include "compute/plan/plan.h"
#include "compute/plan/stage_clock.h"
#include "compute/runner.h"

namespace scree {

class DistributedRunner : public Runner, public Ranks {
public:
    // `make_device`: makes the runner of the stages; null: the CPU runs them, with `threads` threads.
    DistributedRunner(std::shared_ptr<Exchange> exchange, int threads, DeviceSide::Make make_device = nullptr)
        : exchange_(std::move(exchange)), threads_(threads), device_(std::move(make_device)) {}
    std::string backend() const override { return device_ ? "vulkan" : "cpu"; }
    std::string device() const override;
    std::uint32_t group_size() const override { return device_ ? device_.runner().group_size() : 64; }
    const Threads& threads() const override { return threads_; }
    bool in_place() const override { return true; }
    Ranks* ranks() override { return exchange_->ranks() > 1 ? this : nullptr; }
    Exchange& exchange() const override { return *exchange_; }
    void download_own_contacts() override;
    void download_share() override;
    bool can_share_out() const override;
    void share_out() override;
    void make_whole() override;
    std::vector<std::uint64_t> borders_of(std::vector<std::uint64_t> places) override;
    void attach_share(State& state, std::vector<int> owners, std::span<const std::uint32_t> own,
                      const std::function<void()>& fill) override;
    void attach(State& state) override;
    void adapt() override;
    bool step() override;
    void set_profiling(bool on) override { profiles_device_ = on; }
    StageTimes stage_times() const override { return clock_.means(); }
    StageTimes last_stage_times() const override { return clock_.last(); }

private:
    // What ranks exchange before or after a stage.
    enum class SyncPoint {
        none,
        ghosts,      // before the first stage that reads bounds: ghosts, with poses, velocities, forces
        flags,       // after compute_bounds: levels in use, who stirs, sleeps, is fast
        room,        // after the totals of pairs and contacts: overflows
        struck,      // after predict_impacts, if some body is fast
        wake,        // before each round of propagate_wake, and after the last: sleep states, if some body sleeps
        velocities,  // after begin_substep, while contacts and joints without ghosts are solved
        motion,      // after move_bodies, while they are relaxed
        ends,        // after end_step: whether some body is fast, and then poses and sweeps
        stops,       // after each round of find_impacts, with joints of share_stops, if some body is fast
        kept,        // after find_broken, if some body breaks
        broken       // before break_bodies: every rank breaks the bodies of all
    };
    bool sync(SyncPoint at);         // exchange_at(), timed
    bool exchange_at(SyncPoint at);  // false: the step is to be repeated with longer lists
    void run(std::size_t stage);
    // On the device: the stages from this one up to the next sync point. Returns the stage after them.
    std::size_t run_on_device(std::size_t first);
    void move_bodies_between_ranks();
    void place_bodies();
    // Runs the stages of a pass, from this one, while what was sent last travels. Returns the stage after them.
    std::size_t pass_meanwhile(std::size_t first);
    void sync_flags();
    bool sync_room();
    void sync_wake();
    void sync_ends();
    void sync_quarantined();
    void sync_ownerless(bool breaks);
    void sync_broken();
    void fetch_from_device(const std::vector<TableRange>& ranges);
    void forget_contacts();  // of other ranks, which were read
    void send(const std::vector<TableRange>& ranges) override;
    void receive(const std::vector<TableRange>& ranges) override;

    std::shared_ptr<Exchange> exchange_;
    Threads threads_;
    DeviceSide device_;
    bool profiles_device_ = false;
    bool has_share_on_host_ = false;  // what the device has of it, since the last step
    bool edited_contacts_ = false;    // on the host, since the last step
    State* state_ = nullptr;
    std::vector<Stage> plan_;
    std::vector<SyncPoint> before_, after_;  // by stage
    int planned_substeps_ = 0;
    SceneFeatures planned_features_;
    StageClock clock_;
    std::vector<bool> gathered_ = std::vector<bool>(table_count);  // tables that are whole on every rank since the last step
    std::uint32_t own_capacity_ = 0;                               // of contacts, before those of other ranks were read
    Ownership ownership_;
    Share share_;
    Halo halo_;
    Border border_;
    bool knows_border_ = false;                         // in this step
    std::uint32_t placed_bodies_ = 0;                   // rows of bodies, the first ones, when they were placed
    std::uint64_t begun_ = 0;                           // steps, without repetitions
    bool wakes_ = false, knows_waking_ = false;         // some contact shakes bodies behind it in this step
    std::uint32_t spin_limited_ = 0, quarantined_ = 0;  // as the step began
};

}  // namespace scree
