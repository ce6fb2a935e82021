// Lockstep of two reference runners, one of which flushes denormals.
#include "compute/cpu/denormal_lockstep.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "compute/statistics.h"
#include "compute/step/threads.h"

namespace scree {

namespace {

// Flushes denormals on this thread until the end of the scope.
class Flushing {
public:
#if defined(__x86_64__)
    static constexpr bool possible = true;
    Flushing() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | flush_results | operands_are_zero);
    }
    ~Flushing() {
        _mm_setcsr(before_);
    }

private:
    static constexpr unsigned flush_results = 0x8000, operands_are_zero = 0x0040;
    unsigned before_;
#elif defined(__aarch64__)
    static constexpr bool possible = true;
    Flushing() {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        asm volatile("msr fpcr, %0" ::"r"(before_ | flush_to_zero));
    }
    ~Flushing() {
        asm volatile("msr fpcr, %0" ::"r"(before_));
    }

private:
    static constexpr unsigned long flush_to_zero = 1ul << 24;
    unsigned long before_ = 0;
#else
    static constexpr bool possible = false;
    Flushing() = default;

private:
#endif
    Flushing(const Flushing&) = delete;
    Flushing& operator=(const Flushing&) = delete;
};

constexpr std::uint32_t group_size = 64;

}  // namespace

bool can_flush_denormals() {
    return Flushing::possible;
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
            const Flushing flush;
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
