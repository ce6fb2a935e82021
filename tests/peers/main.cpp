// scree_peers: races scree against Bullet and MuJoCo on scene files. tests/peers/run makes the files and calls it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "compute/scene_file/scene_json.h"
#include "demos/program/table.h"
#include "host/files/file.h"
#include "tests/peers/race.h"

int main(int argc, char** argv) {
    using namespace scree;
    CLI::App program("Steps the same scenes with scree, Bullet and MuJoCo by turns, and compares what a step takes");
    std::vector<std::string> files;
    peers::Course course;
    int threads = 2;
    std::string csv;
    program.add_option("scenes", files, "scene files, at best of settled piles (scree run ... --save FILE)")->required();
    program.add_option("--steps", course.steps, "of a turn")->check(CLI::Range(1, 100000))->capture_default_str();
    program.add_option("--rounds", course.rounds, "turns of each program")->check(CLI::Range(1, 1000))->capture_default_str();
    program.add_option("--warmup", course.warmup, "steps of each before the first that counts")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    program
        .add_option("--settle", course.settle,
                    "and so many more of Bullet and MuJoCo: they make what scree settled lie their way")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    program.add_option("--threads", threads, "of scree on the processor, which runs with one as well")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    program.add_option("--csv", csv, "a file for the numbers");
    CLI11_PARSE(program, argc, argv);
    try {
        std::vector<demos::Cells> rows = {
            {"scene", "bodies", "program", "ms_median", "ms_25", "ms_75", "ratio", "points", "moved_median_m", "moved_max_m"}};
        for (const std::string& file : files) {
            const Scene scene = checked(scene_from_json(host::read_text(file)).scene);
            const std::string name = std::filesystem::path(file).stem().string();
            fmt::print(
                "{}: {} bodies, steps of 1/60 s, nothing sleeps; medians of {} turns of {} steps, after {} ({} of others than "
                "scree)\n",
                name, scene.bodies.size(), course.rounds, course.steps, course.warmup, course.warmup + course.settle);
            std::fflush(stdout);
            const std::vector<peers::Lap> laps = peers::race(scene, peers::entrants(scene, threads), course);
            fmt::print("\n{}\n", peers::table_of(laps));
            std::fflush(stdout);
            for (auto& row : peers::csv_rows(name, scene.bodies.size(), laps)) rows.push_back(std::move(row));
        }
        if (!csv.empty()) host::write_atomically(csv, demos::csv(rows));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "scree_peers: {}\n", error.what());
        return 2;
    }
}
