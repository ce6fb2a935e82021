// Records of what every stage wrote.
#include "compute/replay/stage_record.h"

#include <xxhash.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "compute/cpu/reference_runner.h"
#include "compute/statistics.h"
#include "compute/tables/table_layout.h"
#include "compute/world/states/byte_stream.h"
#include "compute/world/states/state_bytes.h"

namespace scree {

namespace {

constexpr std::string_view record_kind = "scree stages 1\n";

// What is known before the first step, and what a record begins with.
struct RecordHead {
    std::uint64_t tables = 0, begin = 0;  // layout_of_tables(); hash of the state and its parameters
    std::int32_t first = 0, last = 0;     // steps done before and after
};

struct Stepping {
    ReferenceRunner runner;
    State state;
    LockstepResult result;

    Stepping(const Scene& scene, const Settings& settings, int threads, std::span<const std::byte> from)
        : runner(threads), state(checked(scene), checked(settings), runner.group_size(), true) {
        if (!from.empty()) restore_tables(state, from);
        runner.attach(state);
        result.step = static_cast<int>(state.counted().steps);
        begin = from.empty() ? fingerprint_of(state) : XXH64(from.data(), from.size(), 0);
        begin = XXH64(&state.fixed(), sizeof(physics::Parameters), begin);
    }

    // Of the scene or the checkpoint, and the settings.
    std::uint64_t begin = 0;

    RecordHead head(int steps) const { return {layout_of_tables(), begin, result.step, steps}; }

    // Until `steps` are done; `look` is given each table that a stage has written, and returns whether to go on.
    template <class Look>
    void run(int steps, const std::function<bool(int)>& progress, Look&& look) {
        const auto watch = [&](const Stage& stage, std::size_t) {
            result.stage = stage.name;
            return std::all_of(stage.compared.begin(), stage.compared.end(), [&](const Compared& compared) {
                return state.counted().overflow != 0 || look(compared);  // a step that lacks room is repeated
            });
        };
        while (result.step < steps && (!progress || progress(result.step))) {
            state.fixed().redo = 0;
            while (!runner.step(watch)) {
                if (!result.equal) return;
                state.grow();
                state.fixed().redo = 1;
                runner.adapt();
            }
            ++result.step;
        }
        result.stage.clear();
        result.hash = hash_of(state);
    }
};

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument("the record of stages " + why);
}

}  // namespace

std::vector<std::byte> record_stages(const Scene& scene, const Settings& settings, int threads, int steps,
                                     std::span<const std::byte> from, const std::function<bool(int)>& progress) {
    Stepping stepping(scene, settings, threads, from);
    std::vector<std::byte> memory;
    memory.reserve(1u << 20u);
    ByteWriter out(std::move(memory));
    out.put_bytes(std::as_bytes(std::span(record_kind)));
    out.put(stepping.head(steps));
    stepping.run(steps, progress, [&](const Compared& compared) {
        out.put_text(stepping.result.stage);
        out.put(static_cast<std::uint32_t>(compared.table));
        out.put_list(live_bytes(stepping.state, compared));
        if (out.bytes().size() > longest_stage_record)
            throw std::length_error("what the stages wrote is more than 1 GiB by step " +
                                    std::to_string(stepping.result.step + 1) +
                                    ": begin with a checkpoint shortly before the difference, and take one step");
        return true;
    });
    return std::move(out.bytes());
}

LockstepResult compare_with_record(std::span<const std::byte> record, const Scene& scene, const Settings& settings, int threads,
                                   int steps, std::span<const std::byte> from, const std::function<bool(int)>& progress) {
    Stepping stepping(scene, settings, threads, from);
    ByteReader in(record);
    try {
        const auto found = in.take_bytes(record_kind.size());
        if (!std::equal(found.begin(), found.end(), std::as_bytes(std::span(record_kind)).begin()))
            refuse("is none: its head says otherwise");
        const auto head = in.take<RecordHead>(), own = stepping.head(steps);
        if (head.tables != own.tables) refuse("was written by a version of scree with other tables");
        if (head.first != own.first || head.begin != own.begin)
            refuse("begins with another state, " + std::to_string(head.first) + " steps after the start, than here, " +
                   std::to_string(own.first));
        if (head.last < own.last) refuse("ends with step " + std::to_string(head.last) + ", before " + std::to_string(own.last));
        stepping.run(steps, progress, [&](const Compared& compared) {
            LockstepResult& result = stepping.result;
            const std::string stage = in.take_text();
            const auto table = in.take<std::uint32_t>();
            const auto written = in.take_records(1), here = live_bytes(stepping.state, compared);
            if (stage == result.stage && table == static_cast<std::uint32_t>(compared.table) && written.size() == here.size())
                return table_equal(stepping.state, written, compared, "here", "recorded", result);
            result.equal = false;
            result.buffer = table_infos()[static_cast<std::size_t>(compared.table)].name;
            result.element = std::min(written.size(), here.size()) / record_bytes(compared.table);
            result.detail =
                std::to_string(here.size()) + " bytes here, " + std::to_string(written.size()) + " recorded by " + stage;
            return false;
        });
    } catch (const CheckpointError&) {
        refuse("is damaged: it ends in the midst of a list");
    }
    return stepping.result;
}

}  // namespace scree
