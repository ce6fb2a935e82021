// Measures of scree run.
#include "demos/program/outputs/measures_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include "compute/scene_file/measures_json.h"
#include "demos/film/export/vtk_folder.h"
#include "demos/film/measure_columns.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/output_check.h"
#include "demos/program/outputs/table.h"
#include "host/files/file.h"
#include "host/files/growing_file.h"
#include "host/files/npy_file.h"

namespace scree::demos {

namespace {

class MeasuresTable {
public:
    virtual ~MeasuresTable() = default;
    virtual void add(const Measures& measures) = 0;
    virtual void finish() = 0;
};

// A line of each moment: all of the grains, regions, gates and bodies one beside the other.
class CsvTable final : public MeasuresTable {
public:
    explicit CsvTable(const std::string& path) : file_(path) {}
    void add(const Measures& measures) override {
        if (!std::exchange(has_heading_, true)) write_heading(measures);
        fmt::memory_buffer line;
        fmt::format_to(std::back_inserter(line), "{:.9g}", measures.time);
        const auto each = [&](const auto& of, const auto& columns) {
            for (const auto& one : of)
                for (const auto& column : columns) {
                    if (!is_listed(column.width)) continue;
                    double values[9] = {};
                    column.take(one, values);
                    for (std::size_t k = 0; k < column.width; ++k)
                        fmt::format_to(std::back_inserter(line), ",{:.12g}", values[k]);
                }
        };
        visit(measures, each);
        fmt::format_to(std::back_inserter(line), "\n");
        file_.append(std::string_view(line.data(), line.size()));
    }
    void finish() override { file_.commit(); }

private:
    static bool is_listed(std::size_t width) { return width <= 9; }  // histograms are for arrays
    template <class Each>
    static void visit(const Measures& measures, const Each& each) {
        each(regions_with_all(measures), region_columns());
        each(measures.gates, gate_columns());
        each(measures.bodies, load_columns());
    }
    void write_heading(const Measures& measures) {
        std::string line = "time";
        visit(measures, [&](const auto& of, const auto& columns) {
            for (const auto& one : of)
                for (const auto& column : columns)
                    for (std::size_t k = 0; is_listed(column.width) && k < column.width; ++k)
                        line += "," + csv_text(one.name + "." + part_name(column.name, column.width, k));
        });
        file_.append(line + "\n");
    }
    host::GrowingFile file_;
    bool has_heading_ = false;
};

// Arrays by time; of regions, gates, bodies and cells by their number.
class NpzTable final : public MeasuresTable {
public:
    explicit NpzTable(const std::string& path) : file_(path), time_(file_.add_array("time", "f8", {})) {}
    void add(const Measures& measures) override {
        file_.append(time_, std::vector<double>{measures.time});
        std::size_t next = 0;
        const auto each = [&](const char* prefix, const auto& of, const auto& columns, const std::vector<std::size_t>& shape) {
            if (of.empty()) return;
            for (const auto& column : columns) {
                std::vector<std::size_t> row = shape;
                if (column.width == 9)
                    row.insert(row.end(), {3, 3});
                else if (column.width > 1)
                    row.push_back(column.width);
                if (next == arrays_.size()) arrays_.push_back(file_.add_array(std::string(prefix) + column.name, "f8", row));
                file_.append(arrays_[next++], values_of(column, of));
            }
        };
        const std::vector<RegionMeasures> regions = regions_with_all(measures);
        each("", regions, region_columns(), {regions.size()});
        each("gate_", measures.gates, gate_columns(), {measures.gates.size()});
        each("body_", measures.bodies, load_columns(), {measures.bodies.size()});
        each("grid_", measures.grid, cell_columns(), {measures.cells.z, measures.cells.y, measures.cells.x});
    }
    void finish() override { file_.finish(); }

private:
    host::NpzFile file_;
    std::size_t time_;
    std::vector<std::size_t> arrays_;
};

std::unique_ptr<MeasuresTable> table_of(const std::string& path) {
    if (path.ends_with(".npz")) return std::make_unique<NpzTable>(path);
    return std::make_unique<CsvTable>(path);
}

std::uint64_t steps_of(double seconds, float rate) {
    return static_cast<std::uint64_t>(std::max(1.0, std::round(seconds * static_cast<double>(rate))));
}

}  // namespace

struct MeasuresFile::Impl {
    MeasureOptions options;
    MeasureRequest request;
    std::size_t copy = 0;
    double fps = 30;

    std::unique_ptr<MeasuresTable> table;
    std::optional<Measuring> measuring;  // for the table
    std::unique_ptr<VtkFolder> folder;
    std::optional<Measuring> on_grid;  // for VTK files

    std::uint64_t table_every(const World& world) const {
        if (options.every > 0) return static_cast<std::uint64_t>(options.every);
        return steps_of(static_cast<double>(request.interval), world.settings().rate);
    }
    std::uint64_t vtk_every(const World& world) const {
        return options.vtk_every > 0 ? static_cast<std::uint64_t>(options.vtk_every) : steps_of(1 / fps, world.settings().rate);
    }
    void begin(const World& world) {
        if (table) measuring.emplace(request, world, copy);
        if (options.vtk.empty()) return;
        folder = std::make_unique<VtkFolder>(options.vtk, world);
        MeasureRequest grid;
        grid.grid = request.grid;
        on_grid.emplace(grid, world, copy);
    }
};

MeasuresFile::MeasuresFile(const MeasureOptions& options, const std::optional<MeasureRequest>& asked, std::size_t copy,
                           double fps)
    : interior_(std::make_unique<Impl>()) {
    Impl& in = *interior_;
    in.options = options;
    in.request = asked.value_or(MeasureRequest{});
    in.copy = copy;
    in.fps = fps;
    if (!options.table.empty()) in.table = table_of(options.table);
}
MeasuresFile::~MeasuresFile() = default;

int MeasuresFile::steps_until_due(const World& world) const {
    const Impl& in = *interior_;
    std::uint64_t steps = 1000000;
    const auto every = [&](std::uint64_t each) { steps = std::min(steps, each - world.steps() % each); };
    if (in.table) every(in.request.gates.empty() ? in.table_every(world) : 1);
    if (!in.options.vtk.empty()) every(in.vtk_every(world));
    return static_cast<int>(steps);
}

void MeasuresFile::after_step(const World& world) {
    Impl& in = *interior_;
    if (!in.measuring && !in.folder)
        in.begin(world);
    else if (in.measuring)
        in.measuring->after_step(world);
    if (in.table && world.steps() % in.table_every(world) == 0) in.table->add(in.measuring->take(world));
    if (in.folder && world.steps() % in.vtk_every(world) == 0)
        in.folder->add(world, in.on_grid->take(world), in.on_grid->request());
}

void MeasuresFile::finish() {
    if (interior_->table) interior_->table->finish();
}

int MeasuresFile::vtk_moments() const {
    return interior_->folder ? interior_->folder->moments() : 0;
}

void add_options(CLI::App& command, MeasureOptions& options) {
    const char* group = "Measures";
    command
        .add_option("--measures", options.file,
                    "What to measure of the grains (all solid dynamic bodies): FILE.json with a grid, regions, gates and bodies, "
                    "as in a scene file's \"measures\", in place of these.")
        ->group(group);
    command
        .add_option("--measures-out", options.table,
                    "Table over time, of the grains as a whole and of each region, gate and body: coordination, solid fraction, "
                    "stress, fabric, velocity, temperature, forces, mass flow, loads. FILE.csv, a line of each moment, or "
                    "FILE.npz, numpy's arrays, with the grid as well.")
        ->group(group);
    command
        .add_option("--measures-every", options.every,
                    "Steps from one line of the table to the next. Default: the \"interval\" of what is measured, 0.1 s.")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
    command
        .add_option(
            "--vtk", options.vtk,
            "Folder of VTK files for ParaView, with indices .pvd: grains with attributes, surfaces of what is no ball, the "
            "contact network, measures on the grid. Moments follow --fps, as near as whole steps allow.")
        ->group(group);
    command
        .add_option("--vtk-every", options.vtk_every, "Steps from one moment of the VTK files to the next. Default: as --fps.")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
}

void require_sense(const CLI::App& command, const MeasureOptions& options) {
    for (const auto& [option, name] :
         {std::pair("--measures", &options.file), {"--measures-out", &options.table}, {"--vtk", &options.vtk}})
        if (name->empty() && command.count(option) != 0)
            throw UsageError(
                fmt::format("{}: the name is empty; name a {}", option, option == std::string("--vtk") ? "folder" : "file"));
    if (options.table.empty() && command.count("--measures-every") != 0)
        throw UsageError("--measures-every: no table is asked for; add --measures-out FILE.csv");
    if (options.vtk.empty() && command.count("--vtk-every") != 0)
        throw UsageError("--vtk-every: no VTK files are asked for; add --vtk FOLDER");
    if (!options.table.empty()) {
        if (!options.table.ends_with(".npz") && !options.table.ends_with(".csv"))
            throw UsageError(
                fmt::format("--measures-out {}: a table is a .csv or an .npz; name a file such as run.csv", options.table));
        require_writable_file("--measures-out", options.table);
    }
    if (options.vtk.empty()) return;
    std::error_code ignored;
    const std::filesystem::path folder = options.vtk;
    if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
        throw UsageError(fmt::format("--vtk {}: is a file; name a folder", options.vtk));
    for (const char* index : {"grains.pvd", "shapes.pvd", "contacts.pvd", "grid.pvd"})
        if (std::filesystem::exists(folder / index, ignored))
            throw UsageError(fmt::format("--vtk {}: has {} of an earlier run; name another folder", options.vtk, index));
    require_writable_file("--vtk", (folder / "grains.pvd").string());
}

std::optional<MeasureRequest> measures_asked(const MeasureOptions& options, const std::optional<MeasureRequest>& of_scene,
                                             const Scene& scene) {
    if (options.file.empty()) return of_scene;
    try {
        return measures_from_json(host::read_regular(options.file, std::uintmax_t{1} << 24), scene);
    } catch (const SceneError& error) {
        throw UsageError(fmt::format("--measures {}: {}", options.file, error.what()));
    } catch (const host::FileError& error) {
        throw UsageError(fmt::format("--measures: {}", error.what()));
    }
}

}  // namespace scree::demos
