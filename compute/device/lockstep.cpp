// Lockstep of two runners, stage by stage.
#include "compute/device/lockstep.h"

#include <algorithm>
#include <vector>

#include "compute/compile/scene_compiler.h"
#include "compute/cpu/reference_runner.h"
#include "compute/device/device_runner.h"
#include "compute/scene/copies.h"
#include "compute/statistics.h"
#include "compute/world/states/state_bytes.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

struct Lockstep::Impl {
    DeviceRunner there;
    ReferenceRunner here;
    State image, state;  // of the device; of the CPU. Equal parameters, hence equal group size
    LockstepResult result;

    Impl(const CopiedScene& of, const Settings& settings, std::shared_ptr<host::Device> device, int threads, std::uint32_t copies)
        : there(std::move(device)),
          here(threads),
          image(of.scene, settings, there.group_size(), there.in_place(), copies),
          state(of.scene, settings, there.group_size(), here.in_place(), copies) {
        for (State* each : {&image, &state}) {
            each->gravities = records_of_gravities(of.gravities);
            each->allocate();
        }
        attach();
    }

    void attach() {
        there.attach(image);
        take_group_size();
        here.attach(state);
    }

    void take_group_size() {
        state.fixed().group_size = image.fixed().group_size;
        state.fixed().group_shift = image.fixed().group_shift;
        state.fixed().most_groups = image.fixed().most_groups;
    }

    bool compare(const Stage& stage, std::size_t index) {
        there.run_stages(index, index + 1);
        result.stage = stage.name;
        std::vector<std::vector<std::byte>> found(stage.compared.size());
        DeviceRunner::Contents contents;
        for (std::size_t i = 0; i < stage.compared.size(); ++i) {
            found[i].resize(is_written(stage.compared[i]) ? live_bytes(state, stage.compared[i]).size() : 0);
            contents.emplace_back(stage.compared[i].table, found[i]);
        }
        there.read(contents);
        for (std::size_t i = 0; i < stage.compared.size(); ++i)
            if (is_written(stage.compared[i]) && !table_equal(state, found[i], stage.compared[i], "cpu", "device", result))
                return false;
        return true;
    }

    // After an overflow only counts are, and quiet steps only if bodies may sleep.
    bool is_written(const Compared& compared) const {
        if (compared.table == Table::neighbours_quiet && state.fixed().sleep_steps == physics::NO_SLEEP) return false;
        return state.counted().overflow == 0 || compared.table == Table::counts;
    }

    // False if a buffer had to grow first.
    bool attempt(bool redo) {
        state.fixed().redo = image.fixed().redo = redo;
        there.begin_step();
        there.poison();
        if (here.step([&](const Stage& stage, std::size_t index) { return compare(stage, index); }) || !result.equal) return true;
        there.download({{Table::counts, 0, 1}});
        image.grow();
        state.grow();
        there.adapt();
        there.upload({{Table::counts, 0, 1}});
        take_group_size();
        here.adapt();
        return false;
    }
};

Lockstep::Lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device, int threads,
                   std::size_t copies, const std::function<void(std::size_t, Scene&)>& vary)
    : interior_(std::make_unique<Impl>(copies ? copied(checked(scene), copies, vary) : CopiedScene{checked(scene), {}},
                                       checked(settings), std::move(device), threads, static_cast<std::uint32_t>(copies))) {}
Lockstep::~Lockstep() = default;
const LockstepResult& Lockstep::result() const {
    return interior_->result;
}
DeviceRunner& Lockstep::device() {
    return interior_->there;
}

void Lockstep::change(const std::function<void(State&)>& make) {
    interior_->there.download({{Table::counts, 0, 1}});
    interior_->there.download(lasting_ranges(interior_->image));
    interior_->there.download(joint_structure_ranges(interior_->image));
    make(interior_->image);
    make(interior_->state);
    interior_->attach();
}

void Lockstep::restore(std::span<const std::byte> saved) {
    change([&](State& state) { restore_tables(state, saved); });
    interior_->result.step = static_cast<int>(interior_->state.counted().steps);
    interior_->result.hash = hash_of(interior_->state);
}

void Lockstep::edit(const std::function<TableRanges(const StateEditor&)>& needed,
                    const std::function<TableRanges(StateEditor&)>& make) {
    StateEditor of_image(interior_->image), of_state(interior_->state);
    interior_->there.download({{Table::counts, 0, 1}});
    interior_->there.download(needed(of_image));
    interior_->there.download(joint_structure_ranges(interior_->image));
    const TableRanges changed = make(of_image);
    make(of_state);
    interior_->there.adapt();
    interior_->here.adapt();
    interior_->there.upload(changed);
}

bool Lockstep::step() {
    LockstepResult& result = interior_->result;
    if (!result.equal) return false;
    for (bool redo = false; !interior_->attempt(redo); redo = true) continue;
    if (!result.equal) return false;
    ++result.step;
    result.stage.clear();
    result.hash = hash_of(interior_->state);
    return true;
}

LockstepResult compare_in_lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device,
                                   int threads, int steps, const std::function<bool(int)>& progress, std::size_t copies,
                                   std::span<const std::byte> from) {
    Lockstep lockstep(scene, settings, std::move(device), threads, copies);
    if (!from.empty()) lockstep.restore(from);
    while (lockstep.result().step < steps) {
        if (progress && !progress(lockstep.result().step)) break;
        if (!lockstep.step()) break;
    }
    return lockstep.result();
}

}  // namespace scree
