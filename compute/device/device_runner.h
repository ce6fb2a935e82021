// Device runner: the plan's stages as Vulkan compute dispatches, recorded once and submitted every step.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compute/device/body_lease.h"
#include "compute/device/make_device_runner.h"
#include "compute/device/queue_clock.h"
#include "compute/device/ray_caster.h"
#include "compute/device/row_mover.h"
#include "compute/device/step_inputs.h"
#include "compute/plan/plan.h"
#include "compute/plan/stage_clock.h"
#include "compute/plan/stage_fusion.h"
#include "compute/staged_runner.h"
#include "compute/tables/table_layout.h"
#include "compute/tables/table_ranges.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/device.h"
#include "host/vulkan/pipeline.h"
#include "host/vulkan/transfer.h"

namespace scree {

class DeviceRunner : public StagedRunner {
public:
    explicit DeviceRunner(std::shared_ptr<host::Device> device);
    ~DeviceRunner() override;

    std::string backend() const override { return "vulkan"; }
    std::string device() const override;
    std::uint32_t group_size() const override;
    const Threads& threads() const override { return threads_; }
    bool in_place() const override { return false; }
    void attach(State& state) override;  // throws host::DeviceError if memory is short, with the number of bodies that fit
    void adapt() override;               // throws the same
    bool step() override;
    bool steps(int count, std::uint64_t& done) override;
    void keep(std::size_t slot, const TableRanges& ranges) override;
    void bring_back(std::size_t slot) override;
    void drop_kept() override { kept_.clear(); }
    bool prepare_to_move(std::span<const std::uint32_t> from) override;
    void move_rows() override;
    bool casts(std::size_t rays) const override;
    bool cast(RayTask& task) override;
    void cast_rays_from(std::size_t rays) { fewest_rays_ = rays; }  // batches of fewer rays are cast on the host
    void set_profiling(bool on) override { timed_ = on; }
    void submit_within(double seconds) { longest_submission_ = seconds; }  // about; of each submission
    std::size_t submissions_of_a_step() const { return pieces_; }
    StageTimes stage_times() const override { return clock_.means(); }
    StageTimes last_stage_times() const override { return clock_.last(); }
    // What the driver tells of each dispatch's pipeline (host::DeviceOptions::statistics), in the order of the step.
    std::vector<std::pair<std::string, std::vector<host::PipelineStatistic>>> pipeline_statistics() const;

    // The buffer range of a table, for canvases. Changes after a step that grew buffers.
    struct Range {
        const host::Buffer* buffer;
        std::size_t offset, bytes;
    };
    Range range(Table table) const;
    Range place_of(const TableRange& range) const;
    std::uint32_t joint_records() const;  // length of the table of joints
    BodyLease lease_bodies();             // body_lease.h
    void return_bodies(VkSemaphore timeline, std::uint64_t value) { returned_ = {timeline, value}; }

    // A step stage by stage, unfused, for ranks and lockstep, which also reads and writes tables.
    void begin_step() override;
    void resume_step() override { give_inputs(); }
    void run_stages(std::size_t first, std::size_t last) override;
    void read(Table table, std::span<std::byte> bytes, std::size_t offset = 0) const;
    // The first bytes of several tables, in one transfer.
    using Contents = std::vector<std::pair<Table, std::span<std::byte>>>;
    void read(const Contents& contents) const;
    void write(Table table, std::span<const std::byte> bytes);
    // Whether stages are fused because the world is small.
    bool is_fused() const {
        return std::any_of(recorded_.begin(), recorded_.end(), [](const Stage& stage) { return !stage.reference; });
    }
    // Whether tables are bound, or accessed by address because they are too long or too many for this device.
    host::Reach reach() const { return layout_->reach(); }
    // Fills with 0xCD every table that the step now begun must write before reading.
    void poison();

private:
    const host::Buffer& buffer(Table table) const;
    host::Buffer& buffer(Table table);
    host::Reach reach_needed() const;
    bool reads_texels() const;
    void make_plan(host::Reach reach);
    void fuse();
    bool is_one_subgroup() const;
    std::uint32_t fused_group_size() const;
    std::vector<std::uint32_t> constants_of(const Stage& stage) const;  // specialisation constants
    void make_pipelines(const std::vector<Stage>& stages);
    void make_buffers();
    void make_buffer(std::size_t index);
    void move_lasting(const host::Buffer& before, const TableOffsets& were, std::size_t index);
    struct Piece;
    struct ConstPiece;
    void fetch(std::span<const Piece> pieces) const;
    void store(std::span<const ConstPiece> pieces);
    void upload_all();
    RowMover::Records records_of(Table table, std::size_t count) const;
    RowMover::Tables tables_to_move() const;
    void bind_tables();
    using Recordings = std::vector<std::unique_ptr<host::CommandBuffer>>;
    const Recordings& whole_step();
    const Recordings& single_stages();
    std::vector<VkCommandBuffer> commands_of_step();
    void note_duration(double seconds);
    void take_pieces();
    bool finished(std::size_t parity);  // of a step: false if a list overflowed
    void copy_list_ends(host::CommandBuffer& commands, const Stage& stage);
    void require_short_lists(std::size_t parity) const;  // throws host::DeviceError: long_lists.cpp
    void tell_stages(Timeline& told, std::size_t parity);
    void record_stage(host::CommandBuffer& commands, const Stage& stage) const;
    host::Submission::Moment next_ready();
    void wait_for_returned();  // on the host
    void give_inputs();
    void send_parameters();
    void send(const std::vector<TableRange>& ranges) override;
    void receive(const std::vector<TableRange>& ranges) override;

    std::shared_ptr<host::Device> device_;
    mutable host::Transfer transfer_;
    State* state_ = nullptr;
    std::vector<Stage> plan_;
    Threads threads_{0};
    std::vector<Stage> recorded_;  // the plan, with stages fused in a small world
    JointDispatches joint_dispatches_;
    int planned_substeps_ = 0;
    std::uint32_t planned_group_size_ = 0;
    SceneFeatures planned_features_;
    StageClock clock_;
    std::shared_ptr<host::BindingSetLayout> layout_;
    // By shader and features.
    static std::pair<std::string, std::uint32_t> pipeline_of(const Stage& stage) {
        return {stage.name + stage.way, stage.features};
    }
    std::map<std::pair<std::string, std::uint32_t>, host::Pipeline> pipelines_;
    TableOffsets offsets_;
    std::vector<host::Buffer> buffers_;        // by binding; contacts and contacts_before are swapped with the parity
    std::array<host::Buffer, 2> counts_back_;  // per parity
    std::array<std::array<host::Buffer, 2>, 2> list_ends_;  // likewise, where lists may be too long: long_lists.cpp
    // Per parity: the bindings, and (made on demand) the whole step in pieces without and with timestamps, and each stage alone.
    std::array<std::unique_ptr<host::BindingSet>, 2> tables_;
    std::array<std::array<Recordings, 2>, 2> steps_;
    std::array<Recordings, 2> alone_;
    // A step is submitted in pieces, since watchdogs of drivers end submissions that take seconds. A step that took longer than
    // this time has the next ones submitted in more pieces.
    double longest_submission_ = 0.2;  // s
    std::size_t pieces_ = 1, pieces_wanted_ = 1;
    std::unique_ptr<StepInputs> inputs_;
    bool inputs_given_ = false;  // to the step that is submitted next
    std::size_t parity_ = 0;
    bool timed_ = false;
    QueueClock queue_clock_;
    std::array<Timeline::Time, 2> submitted_{};  // per parity
    physics::Parameters sent_{};
    // Copies of ranges of tables, a buffer for each; buffers may be longer than their ranges.
    struct Kept {
        TableRanges ranges;
        std::vector<host::Buffer> buffers;
    };
    std::map<std::size_t, Kept> kept_;
    std::unique_ptr<RayCaster> rays_;  // once asked for
    std::optional<std::size_t> fewest_rays_;
    std::unique_ptr<RowMover> mover_;  // likewise
    // Leases: signalled by each step, once asked for; what the next step waits for; how often buffers were made.
    host::Submission::Moment ready_, returned_;
    std::uint64_t buffers_made_ = 0;
};

}  // namespace scree
