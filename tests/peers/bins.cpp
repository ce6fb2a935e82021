// Many small scenes at once.
#include "tests/peers/bins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "compute/world.h"
#include "demos/program/outputs/table.h"
#include "demos/scenes/demos.h"
#include "tests/peers/race.h"

namespace scree::peers {

namespace {

constexpr int steps = static_cast<int>(bin_seconds / static_cast<double>(step_seconds) + 0.5), watched = 15;
constexpr std::size_t measured_bins = 64;
constexpr float rest = 0.001f;  // m

Scene bin_of(std::size_t number) {
    demos::DemoOptions options;
    options.seed = number + 1;
    return demos::build(*demos::find_demo("bins"), options).scene;
}

bool lies_still(const Scene& scene, const std::vector<Pose>& before, const std::vector<Pose>& after) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (!(glm::length(after[i].position - before[i].position) < rest)) return false;
    return true;
}

// Adds those of one bin to the sums of all; `mean` is their sum until mean_of_sums().
void add(Overlaps& sums, const Overlaps& bin) {
    sums.pairs += bin.pairs;
    sums.mean += bin.mean * static_cast<double>(bin.pairs);
    sums.greatest = std::max(sums.greatest, bin.greatest);
}
void mean_of_sums(Overlaps& sums) {
    if (sums.pairs > 0) sums.mean /= static_cast<double>(sums.pairs);
}

using MakeEngine = std::function<std::unique_ptr<Engine>(const Scene&)>;

// A world for each bin, one after the other.
Filling fill_worlds(std::size_t bins, double most_seconds, const MakeEngine& make) {
    Filling filling;
    for (; filling.bins < bins && (filling.bins == 0 || filling.seconds < most_seconds); ++filling.bins) {
        const Scene scene = checked(bin_of(filling.bins));
        const double start = processor_ms();
        const std::unique_ptr<Engine> engine = make(scene);
        for (int i = 0; i < steps - watched; ++i) engine->step();
        double taken = processor_ms() - start;
        const std::vector<Pose> before = engine->poses();
        const double again = processor_ms();
        for (int i = 0; i < watched; ++i) engine->step();
        taken += processor_ms() - again;
        const std::vector<Pose> after = engine->poses();
        filling.name = engine->name();
        filling.seconds += 1e-3 * taken;
        filling.settled += lies_still(scene, before, after);
        if (filling.bins < measured_bins) add(filling.overlaps, overlaps_of(scene, after));
    }
    mean_of_sums(filling.overlaps);
    return filling;
}

std::vector<Pose> poses_of(const std::vector<BodyState>& all, const World& world, std::size_t copy) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < world.bodies_of_copy(); ++i) {
        const BodyState& body = all[world.body_of(copy, i)];
        poses.push_back({body.position, body.orientation});
    }
    return poses;
}

// One world of as many copies.
Filling fill_copies(std::size_t bins, int substeps) {
    Settings settings;
    settings.rate = 1 / step_seconds;
    settings.substeps = substeps;
    std::vector<Scene> scenes;
    for (std::size_t k = 0; k < bins; ++k) scenes.push_back(bin_of(k));
    const double start = processor_ms();
    World world(scenes.front(), settings, make_reference_runner(1), bins,
                [&](std::size_t copy, Scene& scene) { scene = scenes[copy]; });
    world.step(steps - watched);
    double taken = processor_ms() - start;
    const std::vector<BodyState> before = world.bodies();
    const double again = processor_ms();
    world.step(watched);
    taken += processor_ms() - again;
    const std::vector<BodyState> after = world.bodies();
    Filling filling;
    filling.name = fmt::format("scree, 1 thread, {} substeps", substeps);
    filling.bins = bins;
    filling.seconds = 1e-3 * taken;
    for (std::size_t k = 0; k < bins; ++k) {
        const Scene scene = checked(scenes[k]);
        const std::vector<Pose> end = poses_of(after, world, k);
        filling.settled += lies_still(scene, poses_of(before, world, k), end);
        if (k < measured_bins) add(filling.overlaps, overlaps_of(scene, end));
    }
    mean_of_sums(filling.overlaps);
    return filling;
}

double rate_of(const Filling& filling) {
    return static_cast<double>(filling.bins) / filling.seconds;
}

}  // namespace

std::vector<Filling> fill(std::size_t bins, double most_seconds) {
    std::vector<Filling> all;
    for (const int substeps : {1, 2, 4})
        all.push_back(
            fill_worlds(bins, most_seconds, [substeps](const Scene& scene) { return make_bullet(scene, substeps, true); }));
#ifdef SCREE_PEER_BOX3D
    for (const int substeps : {4, 8})
        all.push_back(fill_worlds(bins, most_seconds, [substeps](const Scene& scene) {
            return make_box3d(scene, substeps, substeps == 8 ? 60.0f : 0.0f, true);
        }));
#endif
    for (const int substeps : {4, 8}) all.push_back(fill_copies(bins, substeps));
    return all;
}

std::vector<std::string> filling_heading() {
    return {"program", "bins", "settled", "s", "bins per s", "ratio", "mean penetration, mm", "greatest, mm"};
}

std::vector<std::vector<std::string>> csv_rows(const std::vector<Filling>& all) {
    std::vector<std::vector<std::string>> rows;
    for (const Filling& one : all)
        rows.push_back({one.name, std::to_string(one.bins), std::to_string(one.settled), fmt::format("{:.2f}", one.seconds),
                        fmt::format("{:.1f}", rate_of(one)), fmt::format("{:.2f}", rate_of(one) / rate_of(all.front())),
                        fmt::format("{:.3f}", 1e3 * one.overlaps.mean), fmt::format("{:.2f}", 1e3 * one.overlaps.greatest)});
    return rows;
}

std::string table_of(const std::vector<Filling>& all) {
    std::vector<demos::Cells> rows = {filling_heading()};
    for (demos::Cells& row : csv_rows(all)) rows.push_back(std::move(row));
    return demos::table(rows);
}

}  // namespace scree::peers
