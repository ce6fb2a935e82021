// Lockstep of two runners, stage by stage.
#include "compute/device/lockstep.h"

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <sstream>

#include "compute/cpu/reference_runner.h"
#include "compute/device/device_runner.h"
#include "compute/statistics.h"

namespace scree {

namespace {

std::string words_of(const std::byte* cpu, const std::byte* device, std::size_t offset) {
    std::uint32_t a = 0, b = 0;
    float fa = 0, fb = 0;
    std::memcpy(&a, cpu, 4);
    std::memcpy(&b, device, 4);
    std::memcpy(&fa, cpu, 4);
    std::memcpy(&fb, device, 4);
    std::ostringstream text;
    text << "byte " << offset << ": cpu 0x" << std::hex << a << " (" << std::dec << std::setprecision(9) << fa << "), device 0x"
         << std::hex << b << " (" << std::dec << fb << ")";
    return text.str();
}

// Compares a table; writes the first difference to the result.
bool table_equal(const State& state, const DeviceRunner& device, const Compared& compared, LockstepResult& result) {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(compared.table)];
    const auto expected = state.raw(compared.table).first(state.live(compared.length) * info.record_bytes);
    if (expected.empty()) return true;
    std::vector<std::byte> found(expected.size());
    device.read(compared.table, found);
    const auto [cpu, gpu] = std::mismatch(expected.begin(), expected.end(), found.begin());
    if (cpu == expected.end()) return true;
    const std::size_t word = static_cast<std::size_t>(cpu - expected.begin()) / 4 * 4;
    result.equal = false;
    result.buffer = info.name;
    result.element = word / info.record_bytes;
    result.detail = words_of(&expected[word], &found[word], word % info.record_bytes);
    return false;
}

}  // namespace

struct Lockstep::Impl {
    DeviceRunner there;
    ReferenceRunner here;
    State image, state;  // of the device; of the CPU. Equal parameters, hence equal group size
    LockstepResult result;

    Impl(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device, int threads)
        : there(std::move(device)),
          here(threads),
          image(scene, settings, there.group_size(), there.in_place()),
          state(scene, settings, there.group_size(), here.in_place()) {
        attach();
    }

    void attach() {
        there.attach(image);
        here.attach(state);
    }

    bool compare(const Stage& stage, std::size_t index) {
        there.run_stage(index);
        result.stage = stage.name;
        // After an overflow only counts are written.
        return std::all_of(stage.compared.begin(), stage.compared.end(), [&](const Compared& compared) {
            return (state.counted().overflow != 0 && compared.table != Table::counts) ||
                   table_equal(state, there, compared, result);
        });
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
        here.adapt();
        return false;
    }
};

Lockstep::Lockstep(const Scene& scene, const Settings& settings, std::shared_ptr<host::Device> device, int threads)
    : interior_(std::make_unique<Impl>(checked(scene), checked(settings), std::move(device), threads)) {}
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
    make(interior_->image);
    make(interior_->state);
    interior_->attach();
}

void Lockstep::edit(const std::function<TableRanges(const StateEditor&)>& needed,
                    const std::function<TableRanges(StateEditor&)>& make) {
    StateEditor of_image(interior_->image), of_state(interior_->state);
    interior_->there.download({{Table::counts, 0, 1}});
    interior_->there.download(needed(of_image));
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
                                   int threads, int steps, const std::function<bool(int)>& progress) {
    Lockstep lockstep(scene, settings, std::move(device), threads);
    while (lockstep.result().step < steps) {
        if (progress && !progress(lockstep.result().step)) break;
        if (!lockstep.step()) break;
    }
    return lockstep.result();
}

}  // namespace scree
