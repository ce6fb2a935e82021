// Lockstep of two reference runners, one of which flushes denormals.
#include "compute/cpu/denormal_lockstep.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "compute/cpu/flushed_denormals.h"
#include "compute/parallel/threads.h"
#include "compute/statistics.h"

namespace scree {

namespace {

constexpr std::uint32_t group_size = 64;

}  // namespace

bool can_flush_denormals() {
    return FlushedDenormals::possible;
}

LockstepResult compare_flushing(const Scene& scene, const Settings& settings, int steps,
                                const std::function<bool(int)>& progress) {
    if (!can_flush_denormals()) throw std::logic_error("this processor cannot flush denormals");
    const Threads threads(1);
    const Scene ready = checked(scene);
    State keeping(ready, checked(settings), group_size, true), flushing(ready, checked(settings), group_size, true);
    keeping.is_watched = flushing.is_watched = true;
    const std::vector<Stage> stages = plan(keeping.substeps, keeping.features());
    LockstepResult result;
    const auto run_equal = [&](const Stage& stage) {
        stage.reference(keeping, threads, stage.pass);
        {
            const FlushedDenormals flush;
            stage.reference(flushing, threads, stage.pass);
        }
        result.stage = stage.name;
        return std::all_of(stage.compared.begin(), stage.compared.end(), [&](const Compared& compared) {
            if (keeping.counted().overflow != 0 && compared.table != Table::counts) return true;
            return table_equal(keeping, live_bytes(flushing, compared), compared, "kept", "flushed", result);
        });
    };
    while (result.step < steps) {
        if (progress && !progress(result.step)) break;
        for (bool redo = false;; redo = true) {
            keeping.fixed().redo = flushing.fixed().redo = redo;
            if (!redo) {
                keeping.turn_over();
                flushing.turn_over();
            }
            if (!std::all_of(stages.begin(), stages.end(), run_equal)) return result;
            if (keeping.counted().overflow == 0) break;
            keeping.grow();
            flushing.grow();
        }
        ++result.step;
    }
    result.stage.clear();
    result.hash = hash_of(keeping);
    return result;
}

}  // namespace scree
