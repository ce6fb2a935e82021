// Device runner: executes the plan on a Vulkan device.
#include "compute/device/device_runner.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "compute/distributed/distributed_runner.h"
#include "compute/parallel/threads.h"
#include "compute/plan/stage_fusion.h"
#include "compute/plan/stage_slices.h"
#include "shaders/embedded.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

namespace {

// Software devices run whole workgroups even if threads have no items: smaller groups waste less in small worlds, and
// distribute them over cores.
std::uint32_t threads_of_a_group(const host::Device& device) {
    return device.report().is_processor ? 64 : 128;
}

std::size_t binding_of(Table table) {
    return table_infos()[static_cast<std::size_t>(table)].buffer;
}

constexpr std::array read_while_changing{
    Table::poses,    Table::velocities, Table::masses, Table::forces,
    Table::impulses, Table::impacts,    Table::slots};  // shaders/stages/lib/read_coherent.glsl

static_assert(host::tables_of_a_step.storage == buffer_count - 1);  // without the parameters
static_assert(host::tables_of_a_step.texels == buffer_count);
static_assert(host::tables_of_a_step.changing_texels == read_while_changing.size());

// The parameters are a uniform block; with `texels` every buffer can be read as texels too
// (shaders/stages/lib/read.glsl).
std::vector<host::Access> accesses(bool texels) {
    std::vector<host::Access> all(buffer_count);
    all[binding_of(Table::parameters)].uniform = true;
    for (const Table table : read_while_changing) all[binding_of(table)].changing = texels;
    for (std::size_t i = 0; texels && i < buffer_count; ++i)
        all[i].texel_bytes = static_cast<std::uint32_t>(std::min<std::size_t>(16, buffer_infos()[i].record_bytes));
    return all;
}

// The buffer of a table in steps of a parity.
std::size_t buffer_at(Table table, std::size_t parity) {
    const Table owner = memory_of(table);
    return buffer_of(parity ? other_parity(owner) : owner);
}

double seconds_since(Timeline::Time then) {
    return std::chrono::duration<double>(Timeline::Clock::now() - then).count();
}

std::size_t argument_offset(physics::uint row) {
    return offsetof(physics::Counts, arguments) + row * sizeof(physics::uvec4);
}

}  // namespace

DeviceRunner::DeviceRunner(std::shared_ptr<host::Device> device) : device_(std::move(device)), transfer_(device_) {}
DeviceRunner::~DeviceRunner() {
    if (!device_) return;
    try {
        wait_for_returned();
    } catch (const host::DeviceError&) {
        // Nothing to wait for on a lost device.
    }
    device_->settle();
    device_->vk().vkDestroySemaphore(device_->handle(), ready_.timeline, nullptr);
}

std::string DeviceRunner::device() const {
    return device_->report().name;
}
std::uint32_t DeviceRunner::group_size() const {
    return threads_of_a_group(*device_);
}

const host::Buffer& DeviceRunner::buffer(Table table) const {
    return buffers_[buffer_at(table, parity_)];
}
host::Buffer& DeviceRunner::buffer(Table table) {
    return buffers_[buffer_at(table, parity_)];
}

void DeviceRunner::attach(State& state) {
    state_ = &state;
    adapt();
    upload_all();
}

void DeviceRunner::adapt() {
    wait_for_returned();
    device_->wait_idle();
    make_buffers();
    if (std::exchange(planned_group_size_, state_->fixed().group_size) != state_->fixed().group_size) pipelines_.clear();
    const host::Reach reach = reach_needed();
    if (!layout_ || layout_->reach() != reach || layout_->has_texels() != reads_texels() ||
        planned_substeps_ != state_->substeps || planned_features_ != state_->features())
        make_plan(reach);
    fuse();
    bind_tables();
}

host::Reach DeviceRunner::reach_needed() const {
    const bool bindable = std::all_of(buffers_.begin(), buffers_.end(), [&](const host::Buffer& buffer) {
        return buffer.bytes() <= device_->report().largest_binding;
    });
    // Without the parameters, which are no storage buffer.
    return bindable && buffer_count - 1 <= device_->limits().maxPerStageDescriptorStorageBuffers ? host::Reach::bound
                                                                                                 : host::Reach::far;
}

bool DeviceRunner::reads_texels() const {
    const std::uint32_t most = device_->limits().maxTexelBufferElements;
    const auto all = accesses(true);
    for (std::size_t i = 0; i < table_count; ++i) {
        const auto table = static_cast<Table>(i);
        if (buffers_[buffer_of(table)].bytes() / all[binding_of(table)].texel_bytes > most) return false;
    }
    return device_->report().prefers_texels;
}

void DeviceRunner::make_plan(host::Reach reach) {
    planned_substeps_ = state_->substeps;
    planned_features_ = state_->features();
    plan_ = plan(planned_substeps_, planned_features_);
    if (!layout_ || layout_->reach() != reach || layout_->has_texels() != reads_texels()) {
        pipelines_.clear();
        layout_ = std::make_shared<host::BindingSetLayout>(device_, static_cast<std::uint32_t>(buffer_count),
                                                           sizeof(std::uint32_t), reach, accesses(reads_texels()));
    }
    for (host::Buffer& back : counts_back_)
        if (!back) back = host::Buffer(device_, "counts_back", sizeof(physics::Counts), host::BufferUse::readback);
}

// See shaders/stages/lib/fused.glsl.
bool DeviceRunner::is_one_subgroup() const {
    return device_->report().is_processor && device_->report().subgroup > 0;
}
std::uint32_t DeviceRunner::fused_group_size() const {
    return is_one_subgroup() ? device_->report().subgroup : group_size();
}

std::vector<std::uint32_t> DeviceRunner::constants_of(const Stage& stage) const {
    const std::uint32_t threads = stage.reference ? state_->fixed().group_size : fused_group_size();
    return {stage.threads_an_item > 0 ? stage.threads_an_item : threads, stage.features, is_one_subgroup() ? 1u : 0u,
            shaders::variant_of(stage.name + stage.way)};
}

void DeviceRunner::make_pipelines(const std::vector<Stage>& stages) {
    const std::string variant =
        std::string(layout_->reach() == host::Reach::far ? ".bda" : "") + (layout_->has_texels() ? ".texels" : "");
    // In parallel: drivers take up to a tenth of a second per pipeline on one core.
    std::vector<std::pair<const Stage*, std::optional<host::Pipeline>>> missing;
    for (const Stage& stage : stages)
        if (!pipelines_.contains(pipeline_of(stage)) && std::none_of(missing.begin(), missing.end(), [&](const auto& other) {
                return pipeline_of(*other.first) == pipeline_of(stage);
            }))
            missing.emplace_back(&stage, std::nullopt);
    const auto make = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Stage& stage = *missing[i].first;
            const std::string shader = stage.name + stage.way;
            missing[i].second.emplace(layout_, shader.c_str(), shaders::find(shader + variant), constants_of(stage));
        }
    };
    Threads(0).for_ranges(missing.size(), make, 1);
    for (auto& [stage, pipeline] : missing) pipelines_.emplace(pipeline_of(*stage), std::move(*pipeline));
}

std::vector<std::pair<std::string, std::vector<host::PipelineStatistic>>> DeviceRunner::pipeline_statistics() const {
    std::vector<std::pair<std::string, std::vector<host::PipelineStatistic>>> all;
    for (const Stage& stage : recorded_) {
        const std::string name = stage.name + stage.way;
        if (std::none_of(all.begin(), all.end(), [&](const auto& other) { return other.first == name; }))
            all.emplace_back(name, pipelines_.at(pipeline_of(stage)).statistics());
    }
    return all;
}

// A grown world may no longer be small.
void DeviceRunner::fuse() {
    std::vector<Stage> recorded;
    joint_dispatches_ = joint_dispatches(state_->joints, std::span(state_->joint_blocks).first(state_->fixed().joint_blocks),
                                         is_one_subgroup() ? device_->report().subgroup : 0);
    for (const Stage& stage : fused(plan_, state_->fixed(), fused_group_size()))
        for (Stage& dispatch : dispatches_of(stage, joint_dispatches_)) recorded.push_back(std::move(dispatch));
    const bool as_before =
        std::equal(recorded.begin(), recorded.end(), recorded_.begin(), recorded_.end(),
                   [](const Stage& a, const Stage& b) { return a.name == b.name && a.way == b.way && a.pass == b.pass; });
    recorded_ = std::move(recorded);
    if (!as_before) clock_ = StageClock(recorded_);
    make_pipelines(recorded_);
}

void DeviceRunner::record_stage(host::CommandBuffer& commands, const Stage& stage) const {
    const physics::Parameters& p = state_->fixed();
    commands.bind(pipelines_.at(pipeline_of(stage)), *tables_[parity_]);
    commands.push(&stage.pass, sizeof(stage.pass));
    const auto direct = [&](physics::uvec4 work) { commands.dispatch(std::max(1u, work.x), work.y); };
    const auto indirect = [&](physics::uint row) {
        commands.dispatch_indirect(buffers_[buffer_of(Table::counts)], argument_offset(row));
    };
    switch (stage.domain) {
        case DispatchDomain::one_group:
            commands.dispatch(1);
            break;
        case DispatchDomain::actions:
            direct(physics::work_for(state_->action_room, p));
            break;
        case DispatchDomain::bodies:
            direct(physics::work_for(p.bodies, p));
            break;
        case DispatchDomain::buckets:
            direct(physics::work_for(physics::buckets_in_all(p) + 1, p));
            break;
        case DispatchDomain::body_scan_blocks:
            direct(physics::scan_work_for(p.bodies, p));
            break;
        case DispatchDomain::bucket_scan_blocks:
            direct(physics::scan_work_for(physics::buckets_in_all(p), p));
            break;
        case DispatchDomain::pairs:
            indirect(physics::WORK_PAIRS);
            break;
        case DispatchDomain::pair_blocks:
            indirect(physics::WORK_PAIR_BLOCKS);
            break;
        case DispatchDomain::pair_type_scan_blocks:
            indirect(physics::WORK_PAIR_TYPE_SCAN_BLOCKS);
            break;
        case DispatchDomain::pair_scan_blocks:
            indirect(physics::WORK_PAIR_SCAN_BLOCKS);
            break;
        case DispatchDomain::contacts:
            indirect(physics::WORK_CONTACTS);
            break;
        case DispatchDomain::wake_contacts:
            indirect(physics::WORK_WAKE);
            break;
        case DispatchDomain::solver_contacts:
            indirect(physics::WORK_SOLVER_CONTACTS);
            break;
        case DispatchDomain::pair_type:
            indirect(physics::WORK_PAIR_TYPE + stage.pass);
            break;
        case DispatchDomain::ccd_pairs:
            indirect(physics::WORK_CCD_PAIRS);
            break;
        case DispatchDomain::joint_blocks:
            // Workgroups take further blocks in turn where there are more than a dispatch may have groups.
            stage.threads_an_item > 0 ? commands.dispatch(std::clamp(p.joint_blocks, 1u, p.most_groups))
                                      : direct(physics::work_for(p.joint_blocks, p));
            break;
        case DispatchDomain::vehicles:
            direct(physics::work_for(p.vehicles, p));
            break;
        case DispatchDomain::bonds:
            direct(physics::work_for(p.bonds, p));
            break;
    }
}

void DeviceRunner::bind_tables() {
    for (std::size_t parity = 0; parity < 2; ++parity) {
        std::vector<const host::Buffer*> bound(buffer_count);
        for (std::size_t i = 0; i < table_count; ++i) {
            const auto table = static_cast<Table>(i);
            bound[binding_of(table)] = &buffers_[buffer_at(table, parity)];
        }
        alone_[parity].clear();
        steps_[parity] = {};
        tables_[parity] = std::make_unique<host::BindingSet>(layout_, bound);
    }
    const auto place = [&](Table table) {
        const Range one = range(table);
        return StepInputs::Place{one.buffer, one.offset, one.bytes};
    };
    inputs_ = std::make_unique<StepInputs>(device_, place(Table::parameters), place(Table::actions));
    inputs_given_ = false;
    sent_ = {};
}

const DeviceRunner::Recordings& DeviceRunner::whole_step() {
    using Waiting = host::CommandBuffer::Waiting;
    Recordings& pieces = steps_[parity_][timed_ ? 1 : 0];
    if (!pieces.empty()) return pieces;
    const std::size_t stages = recorded_.size(), count = std::min(pieces_, stages);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t first = k * stages / count, last = (k + 1) * stages / count;
        auto commands = std::make_unique<host::CommandBuffer>(device_, timed_ ? static_cast<std::uint32_t>(last - first) + 1 : 0);
        if (timed_) commands->timestamp();
        for (std::size_t i = first; i < last; ++i) {
            record_stage(*commands, recorded_[i]);
            if (recorded_[i].barrier_after) commands->barrier(i + 1 == last ? Waiting::everything : Waiting::dispatches);
            copy_list_ends(*commands, recorded_[i]);
            if (timed_) commands->timestamp();
        }
        if (last == stages) {
            commands->copy(buffers_[buffer_of(Table::counts)], counts_back_[parity_], sizeof(physics::Counts));
            commands->barrier();
        }
        commands->end();
        pieces.push_back(std::move(commands));
    }
    return pieces;
}

std::vector<VkCommandBuffer> DeviceRunner::commands_of_step() {
    std::vector<VkCommandBuffer> commands;
    if (std::exchange(inputs_given_, false)) commands.push_back(inputs_->copies(parity_));
    for (const auto& piece : whole_step()) commands.push_back(piece->handle());
    return commands;
}

void DeviceRunner::note_duration(double seconds) {
    pieces_wanted_ = std::max(pieces_wanted_, static_cast<std::size_t>(seconds / longest_submission_) + 1);
}

// While no step is under way.
void DeviceRunner::take_pieces() {
    if (std::exchange(pieces_, pieces_wanted_) != pieces_wanted_) steps_ = {};
}

void DeviceRunner::begin_step() {
    if (!state_->fixed().redo) parity_ ^= 1;
    give_inputs();
}

bool DeviceRunner::step() {
    take_pieces();
    begin_step();
    const TimedSlice wait(timeline(), "wait for the device");
    submitted_[parity_] = Timeline::Clock::now();
    host::Submission(*device_, commands_of_step(), std::exchange(returned_, {}), next_ready()).wait();
    note_duration(seconds_since(submitted_[parity_]));
    return finished(parity_);
}

bool DeviceRunner::finished(std::size_t parity) {
    std::memcpy(&state_->counted(), counts_back_[parity].mapped(), sizeof(physics::Counts));
    if (timed_) {
        clock_.begin_step();
        std::size_t stage = 0;
        for (const auto& piece : steps_[parity][1])
            for (const double seconds : piece->timestamp_seconds()) clock_.add(stage++, seconds);
        clock_.end_step();
        if (Timeline* told = timeline()) tell_stages(*told, parity);
    }
    if (state_->counted().overflow != 0) return false;
    require_short_lists(parity);
    return true;
}

void DeviceRunner::tell_stages(Timeline& told, std::size_t parity) {
    std::vector<double> ticks;
    for (const auto& piece : steps_[parity][1]) {
        const std::vector<double> of_piece = piece->timestamps();
        if (!ticks.empty() && !of_piece.empty()) ticks.pop_back();  // a stage ends where the next piece begins
        ticks.insert(ticks.end(), of_piece.begin(), of_piece.end());
    }
    const std::vector<Timeline::Time> times = queue_clock_.place(ticks, submitted_[parity], Timeline::Clock::now());
    if (times.empty()) return;
    told.slice(Timeline::queue, "step", times.front(), times.back());
    for (std::size_t i = 0; i + 1 < times.size(); ++i) tell(told, Timeline::queue, recorded_[i], *state_, times[i], times[i + 1]);
}

bool DeviceRunner::steps(int count, std::uint64_t& done) {
    std::array<std::optional<host::Submission>, 2> under_way;  // by parity
    int submitted = 0;
    Timeline::Time completed = Timeline::Clock::now();
    for (int waited = 0; waited < count; ++waited, ++done) {
        while (submitted < count && submitted < waited + 2) {
            if (pieces_ != pieces_wanted_ && submitted > waited) break;
            take_pieces();
            begin_step();
            submitted_[parity_] = Timeline::Clock::now();
            under_way[parity_].emplace(*device_, commands_of_step(), std::exchange(returned_, {}), next_ready());
            ++submitted;
        }
        const std::size_t parity = submitted == waited + 2 ? parity_ ^ 1 : parity_;
        {
            const TimedSlice wait(timeline(), "wait for the device");
            under_way[parity]->wait();
        }
        note_duration(std::min(seconds_since(submitted_[parity]), seconds_since(completed)));
        completed = Timeline::Clock::now();
        if (finished(parity)) continue;
        // The next step has seen the overflow and changed nothing.
        for (std::optional<host::Submission>& step : under_way) step.reset();
        parity_ = parity;
        return false;
    }
    return true;
}

const DeviceRunner::Recordings& DeviceRunner::single_stages() {
    Recordings& alone = alone_[parity_];
    if (!alone.empty()) return alone;
    std::vector<Stage> unfused;
    for (const Stage& stage : plan_)
        for (Stage& dispatch : dispatches_of(stage, joint_dispatches_)) unfused.push_back(std::move(dispatch));
    make_pipelines(unfused);
    for (const Stage& stage : plan_) {
        auto commands = std::make_unique<host::CommandBuffer>(device_, 0);
        for (const Stage& dispatch : dispatches_of(stage, joint_dispatches_)) {
            record_stage(*commands, dispatch);
            commands->barrier();
        }
        copy_list_ends(*commands, stage);
        commands->end();
        alone.push_back(std::move(commands));
    }
    return alone;
}

void DeviceRunner::run_stages(std::size_t first, std::size_t last) {
    const Recordings& alone = single_stages();
    std::vector<VkCommandBuffer> commands;
    if (std::exchange(inputs_given_, false)) commands.push_back(inputs_->copies(parity_));
    for (std::size_t i = first; i < last; ++i) commands.push_back(alone[i]->handle());
    device_->submit_and_wait(commands);
    if (last == plan_.size()) require_short_lists(parity_);
}

std::unique_ptr<Runner> make_device_runner(std::shared_ptr<host::Device> device) {
    return std::make_unique<DeviceRunner>(std::move(device));
}

std::unique_ptr<Runner> make_distributed_runner(std::shared_ptr<Exchange> exchange, std::shared_ptr<host::Device> device) {
    return std::make_unique<DistributedRunner>(std::move(exchange), 0,
                                               [device = std::move(device)] { return std::make_unique<DeviceRunner>(device); });
}

}  // namespace scree
