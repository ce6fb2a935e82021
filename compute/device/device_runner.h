// The device runner: the plan's stages as compute dispatches on a Vulkan device, recorded once and submitted every step.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compute/runner.h"
#include "compute/step/plan.h"
#include "compute/step/stage_clock.h"
#include "compute/step/table_layout.h"
#include "compute/step/table_ranges.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"
#include "host/vulkan/device.h"
#include "host/vulkan/pipeline.h"

namespace scree {

class DeviceRunner : public Runner {
public:
    explicit DeviceRunner(std::shared_ptr<host::Device> device);
    ~DeviceRunner() override;

    std::string backend() const override { return "vulkan"; }
    std::string device() const override;
    std::uint32_t group_size() const override;
    const Threads& threads() const override { return threads_; }
    bool in_place() const override { return false; }
    void attach(State& state) override;  // throws host::DeviceError when the device has no room, saying for how many there is
    void adapt() override;               // throws the same
    bool step() override;
    bool steps(int count, std::uint64_t& done) override;
    void set_profiling(bool on) override { timed_ = on; }
    StageTimes stage_times() const override { return clock_.means(); }
    StageTimes last_stage_times() const override { return clock_.last(); }

    // What a canvas draws from: where a table lies. It is elsewhere after a step that had to grow.
    struct Range {
        const host::Buffer* buffer;
        std::size_t offset, bytes;
    };
    Range range(Table table) const;
    std::uint32_t joint_records() const;  // of the table of joints

    // For the comparison with another runner: a step stage by stage, and what a stage wrote.
    void begin_step();
    void run_stage(std::size_t index);
    void read(Table table, std::span<std::byte> bytes, std::size_t offset = 0) const;
    void write(Table table, std::span<const std::byte> bytes);
    // Whether stages run as one because the world is small.
    bool is_fused() const {
        return std::any_of(recorded_.begin(), recorded_.end(), [](const Stage& stage) { return !stage.reference; });
    }
    // Whether the tables are bound or, too long or too many for this device, found by address.
    host::Reach reach() const { return layout_->reach(); }
    // Fills with 0xCD every table that the step now begun must not read before it has written it.
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
    std::vector<std::uint32_t> constants_of(const Stage& stage) const;  // for its specialisation
    void make_pipelines(const std::vector<Stage>& stages);
    void make_buffers();
    void make_buffer(std::size_t index);
    void move_lasting(const host::Buffer& before, const TableOffsets& were, std::size_t index);
    void upload_all();
    void bind_tables();
    const host::CommandBuffer& whole_step();
    bool finished(std::size_t parity);  // a step: whether every list had room
    void record_stage(host::CommandBuffer& commands, const Stage& stage) const;
    void send_inputs();
    void send(const std::vector<TableRange>& ranges) override;
    void receive(const std::vector<TableRange>& ranges) override;

    std::shared_ptr<host::Device> device_;
    State* state_ = nullptr;
    std::vector<Stage> plan_;
    Threads threads_{0};
    std::vector<Stage> recorded_;     // the plan, in a small world with stages fused
    std::uint32_t joint_rounds_ = 1;  // that a dispatch may do
    int planned_substeps_ = 0;
    SceneFeatures planned_features_;
    StageClock clock_;
    std::shared_ptr<host::BindingSetLayout> layout_;
    std::map<std::pair<std::string, std::uint32_t>, host::Pipeline> pipelines_;  // by the stage's name and its content
    TableOffsets offsets_;                                                       // of the tables in the buffers
    std::vector<host::Buffer> buffers_;        // by binding; contacts and those before change places with the parity
    std::array<host::Buffer, 2> counts_back_;  // per parity
    // Per parity: the table, and (made when asked for) the whole step, without and with times, and each stage alone.
    std::array<std::unique_ptr<host::BindingSet>, 2> tables_;
    std::array<std::array<std::unique_ptr<host::CommandBuffer>, 2>, 2> steps_;
    std::array<std::vector<std::unique_ptr<host::CommandBuffer>>, 2> alone_;
    std::size_t parity_ = 0;
    bool timed_ = false;
    physics::Parameters sent_{};
};

std::unique_ptr<Runner> make_device_runner(std::shared_ptr<host::Device> device);

}  // namespace scree
