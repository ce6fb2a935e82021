// scree_peers: races scree against Bullet, MuJoCo and, where its sources were given, Box3D on scene files. tests/peers/run makes
// the files and calls it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "compute/scene_file/scene_json.h"
#include "demos/program/outputs/table.h"
#include "host/files/file.h"
#include "host/processor.h"
#include "tests/peers/bins.h"
#include "tests/peers/quality.h"
#include "tests/peers/race.h"

namespace {

using namespace scree;

using Rows = std::vector<demos::Cells>;

void append(Rows& rows, const Rows& more) {
    rows.insert(rows.end(), more.begin(), more.end());
}

Rows raced(const std::string& name, const Scene& scene, const peers::Field& field, const peers::Course& course) {
    fmt::print("{}: {} bodies, steps of 1/60 s, nothing sleeps, on {}; medians and means of {} turns of {} steps", name,
               scene.bodies.size(), host::processor(), course.rounds, course.steps);
    if (course.warmup + course.settle == 0) {
        fmt::print(" from the scene's first\n");
    } else {
        fmt::print(", after {} ({} of others than scree)\n", course.warmup, course.warmup + course.settle);
    }
    std::fflush(stdout);
    const std::vector<peers::Lap> laps = peers::race(scene, peers::entrants(scene, field), course);
    fmt::print("\n{}\n", peers::table_of(laps));
    return peers::csv_rows(name, scene.bodies.size(), laps);
}

Rows kept(const std::string& name, const Scene& scene, double seconds) {
    fmt::print("{}: {} bodies, {} s in steps of 1/60 s by turns, one thread, nothing sleeps\n", name, scene.bodies.size(),
               seconds);
    std::fflush(stdout);
    const int steps = static_cast<int>(std::lround(seconds / static_cast<double>(peers::step_seconds)));
    const std::vector<peers::Keeping> all = peers::keep(scene, peers::keepers(scene), steps);
    fmt::print("\n{}\n", peers::table_of(all));
    return peers::csv_rows(name, scene.bodies.size(), all);
}

Rows filled(const std::vector<std::size_t>& counts, double most_seconds) {
    Rows rows = {peers::filling_heading()};
    for (const std::size_t bins : counts) {
        fmt::print("{} bins of 20 stones, {} s in steps of 1/60 s, processor time of one thread\n", bins, peers::bin_seconds);
        std::fflush(stdout);
        const std::vector<peers::Filling> all = peers::fill(bins, most_seconds);
        fmt::print("\n{}\n", peers::table_of(all));
        append(rows, peers::csv_rows(all));
    }
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program("Steps the same scenes with scree and other engines by turns, and compares what a step takes");
    std::vector<std::string> files;
    peers::Course course;
    peers::Field field;
    bool from_start = false;
    double quality = 0;
    std::string csv;
    std::vector<std::size_t> bins;
    double most_seconds = 20;
    program.add_option("scenes", files, "scene files, at best of settled piles (scree run ... --save FILE)");
    program.add_option("--bins", bins, "instead of scenes: so many bins of stones at once, numbers separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1, 65536));
    program.add_option("--most-seconds", most_seconds, "with --bins: processor time after which an engine begins no other world")
        ->check(CLI::Range(0.1, 100000.0))
        ->capture_default_str();
    program.add_option("--steps", course.steps, "of a turn")->check(CLI::Range(1, 100000))->capture_default_str();
    program.add_option("--rounds", course.rounds, "turns of each program")->check(CLI::Range(1, 100000))->capture_default_str();
    program.add_option("--warmup", course.warmup, "steps of each before the first that counts")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    program
        .add_option("--settle", course.settle, "and so many more of other engines: they make what scree settled lie their way")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    program.add_flag("--from-start", from_start, "no step before those that count: scenes that are yet to fall and settle");
    program.add_option("--quality", quality, "instead of the race: how well scree and Box3D keep the scenes for so many seconds")
        ->check(CLI::Range(1.0, 10000.0));
    program.add_option("--threads", field.threads, "of scree on the processor, which runs with one as well")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    program.add_option("--substeps", field.substeps, "of scree (default: the setting's)")->check(CLI::Range(1, 64));
    program.add_option("--box3d-substeps", field.box3d_substeps, "of Box3D")->check(CLI::Range(1, 64))->capture_default_str();
    program.add_option("--programs", field.programs, "which take part, separated by commas (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(peers::program_keys()));
    program.add_option("--csv", csv, "a file for the numbers");
    CLI11_PARSE(program, argc, argv);
    if (from_start) course = peers::Course::from_start(course.rounds, course.steps);
    if (files.empty() == bins.empty()) {
        fmt::print(stderr, "scree_peers: give scene files, or --bins with numbers; see --help\n");
        return 2;
    }
    try {
        if (!bins.empty()) {
            const Rows rows = filled(bins, most_seconds);
            if (!csv.empty()) host::write_atomically(csv, demos::csv(rows));
            return 0;
        }
        Rows rows = {quality > 0 ? peers::keeping_heading() : peers::lap_heading()};
        for (const std::string& file : files) {
            const Scene scene = checked(scene_from_json(host::read_text(file)).scene);
            const std::string name = std::filesystem::path(file).stem().string();
            append(rows, quality > 0 ? kept(name, scene, quality) : raced(name, scene, field, course));
            std::fflush(stdout);
        }
        if (!csv.empty()) host::write_atomically(csv, demos::csv(rows));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "scree_peers: {}\n", error.what());
        return 2;
    }
}
