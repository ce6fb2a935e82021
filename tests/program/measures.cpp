// scree run --measures, --measures-out and --vtk: tables and files against the run, after its end and when it is killed.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/program/program.h"

using namespace scree::program;

namespace {

// Balls, a box and a hull that fall on a table; a gate above it.
const char* const scene_text = R"({"bodies": [
    {"name": "table", "motion": "fixed", "shape": {"box": {"half_extents": [1, 0.1, 1]}}, "position": [0, -0.1, 0]},
    {"shape": {"sphere": {"radius": 0.1}}, "position": [-0.5, 0.3, 0]}, {"shape": {"sphere": {"radius": 0.1}}, "position": [0.5, 0.1, 0]},
    {"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}, "position": [0, 0.1, 0.5]},
    {"shape": {"hull": {"points": [[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0], [0, 0, 0.3]]}}, "position": [0, 0.001, -0.5]}],
  "measures": {"interval": 0.25, "grid": {"lower": [-1, 0, -1], "upper": [1, 1, 1], "cell": [0.5, 0.25, 0.5]},
    "regions": [{"name": "left, half", "shape": {"box": {"lower": [-1, 0, -1], "upper": [0, 1, 1]}}}],
    "gates": [{"name": "gate", "centre": [-0.5, 0.2, 0], "u": [0.2, 0, 0], "v": [0, 0, 0.2]}], "bodies": [{"body": "table"}]}})";

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string>& row = rows.emplace_back(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                row.emplace_back();
            else
                row.back() += c;
        }
    }
    return rows;
}
double value(const std::vector<std::vector<std::string>>& rows, std::size_t row, const std::string& column) {
    for (std::size_t k = 0; k < rows[0].size(); ++k)
        if (rows[0][k] == column) return std::stod(rows.at(row).at(k));
    FAIL("no column " << column);
    return 0;
}

// A reader of its own: arrays by name, from the offsets that the XML names.
struct VtkRead {
    std::string xml;
    std::map<std::string, std::string> bytes;
    std::map<std::string, std::string> types;
    std::size_t rest = 0;  // bytes behind the last array, before the end

    template <class Value>
    std::vector<Value> values(const std::string& name) const {
        const std::string& raw = bytes.at(name);
        std::vector<Value> made(raw.size() / sizeof(Value));
        std::memcpy(made.data(), raw.data(), raw.size());
        return made;
    }
};
std::string attribute(const std::string& tag, const std::string& name) {
    const std::size_t at = tag.find(" " + name + "=\"");
    if (at == tag.npos) return "";
    const std::size_t from = at + name.size() + 3;
    return tag.substr(from, tag.find('"', from) - from);
}
VtkRead read_vtk(const std::string& file) {
    VtkRead read;
    const std::string opening = "<AppendedData encoding=\"raw\">\n_", ending = "\n</AppendedData>\n</VTKFile>\n";
    const std::size_t at = file.find(opening);
    REQUIRE(at != file.npos);
    REQUIRE(file.ends_with(ending));
    read.xml = file.substr(0, at);
    const std::string raw = file.substr(at + opening.size(), file.size() - ending.size() - at - opening.size());
    std::size_t end = 0;
    for (std::size_t tag = read.xml.find("<DataArray"); tag != read.xml.npos; tag = read.xml.find("<DataArray", tag + 1)) {
        const std::string text = read.xml.substr(tag, read.xml.find('>', tag) - tag);
        if (attribute(text, "format") != "appended") continue;
        const std::size_t offset = std::stoul(attribute(text, "offset"));
        std::uint64_t size = 0;
        REQUIRE(offset + sizeof size <= raw.size());
        std::memcpy(&size, raw.data() + offset, sizeof size);
        REQUIRE(offset + sizeof size + size <= raw.size());
        CHECK(offset == end);
        end = offset + sizeof size + size;
        read.bytes[attribute(text, "Name")] = raw.substr(offset + sizeof size, size);
        read.types[attribute(text, "Name")] = attribute(text, "type");
    }
    CHECK(end == raw.size());
    return read;
}

std::vector<std::string> files_of_index(const std::string& pvd) {
    std::vector<std::string> files;
    REQUIRE(pvd.ends_with("</Collection>\n</VTKFile>\n"));
    for (std::size_t at = pvd.find(" file=\""); at != pvd.npos; at = pvd.find(" file=\"", at + 1))
        files.push_back(pvd.substr(at + 7, pvd.find('"', at + 7) - at - 7));
    return files;
}

}  // namespace

TEST_CASE("program: a table of measures tells what the run does, moment by moment") {
    const Place place;
    const std::string scene = place.write("scene.json", scene_text);
    const std::string table = (place / "run.csv").string();
    const Outcome run = run_scree("run " + scene + " --backend cpu --seconds 2 --measures-out " + table + " --report " +
                                  (place / "r.json").string());
    INFO(run.errors);
    REQUIRE(run.status == 0);
    const auto rows = rows_of(place.read("run.csv"));
    REQUIRE(rows.size() == 10);  // and the heading
    CHECK(value(rows, 9, "time") == 2);
    for (const auto& row : rows) CHECK(row.size() == rows[0].size());
    CHECK(value(rows, 9, "all.bodies") == 4);
    CHECK(value(rows, 9, "left, half.bodies") == 1);
    // One ball has fallen through the gate, downwards, in the first lines.
    const double ball = 1000 * 4.18879 * 0.001;
    double fallen = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) fallen += value(rows, i, "gate.forward");
    CHECK(fallen == Approx(ball).epsilon(1e-4));
    CHECK(value(rows, 2, "gate.mass_flow") + value(rows, 3, "gate.mass_flow") == Approx(ball / 0.25).epsilon(1e-4));
    const double weight = 9.81 * (2 * ball + 8 + 4.5);
    CHECK(value(rows, 9, "table.force_y") == Approx(-weight).epsilon(2e-3));
    const nlohmann::json report = nlohmann::json::parse(place.read("r.json"));
    CHECK(report["grains"]["bodies"] == 4);
    CHECK(report["grains"]["stress"].size() == 9);
    CHECK(says(run.output, "inertial number"));
    CHECK(says(run.output, "contacts are rigid"));

    // Arrays of the same, with the grid.
    const std::string arrays = (place / "run.npz").string();
    REQUIRE(
        run_scree("run " + scene + " --backend cpu --seconds 1 --quiet --measures-every 30 --measures-out " + arrays).status ==
        0);
    CHECK(says(place.read("run.npz"), "grid_solid_fraction"));
    CHECK(says(place.read("run.npz"), "gate_mass_flow"));

    // A file in place of the scene's measures.
    const std::string asked =
        place.write("asked.json", R"({"regions": [{"name": "mine", "shape": {"sphere": {"centre": [0, 0, 0], "radius": 2}}}]})");
    REQUIRE(
        run_scree("run " + scene + " --backend cpu --steps 15 --quiet --measures " + asked + " --measures-out " + table).status ==
        0);
    CHECK(says(place.read("run.csv"), ",mine.solid_fraction,"));
    CHECK_FALSE(says(place.read("run.csv"), "table.force_y"));
    // And a run without any.
    const Outcome plain = run_scree("run stack --backend cpu --steps 2");
    CHECK_FALSE(says(plain.output, "inertial number"));
}

TEST_CASE("program: VTK files have the grains, surfaces, contacts and measures of a run") {
    const Place place;
    const std::string scene = place.write("scene.json", scene_text), out = (place / "out").string();
    const Outcome run = run_scree("run " + scene + " --backend cpu --seconds 1 --quiet --fps 10 --vtk " + out + " --trajectory " +
                                  (place / "t.csv").string());
    INFO(run.errors);
    REQUIRE(run.status == 0);
    for (const char* kind : {"grains", "shapes", "contacts", "grid"}) {
        const std::vector<std::string> files = files_of_index(place.read("out/" + std::string(kind) + ".pvd"));
        CHECK(files.size() == 11);
        for (const std::string& file : files) CHECK(std::filesystem::exists(place / ("out/" + file)));
    }
    const VtkRead grains = read_vtk(place.read("out/grains_000010.vtp"));
    CHECK(grains.values<std::int64_t>("id") == std::vector<std::int64_t>{1, 2, 3, 4});
    CHECK(grains.types.at("stress") == "Float32");
    const std::vector<float> points = grains.values<float>("Points"), radius = grains.values<float>("radius");
    CHECK(radius[0] == Approx(0.1));
    CHECK(grains.values<std::int32_t>("coordination") == std::vector<std::int32_t>{1, 1, 1, 1});
    const auto poses = rows_of(place.read("t.csv"));
    for (std::size_t i = 0; i < 4; ++i) {
        const std::vector<std::string>& row = poses[poses.size() - 4 + i];
        for (std::size_t k = 0; k < 3; ++k) CHECK(points[3 * i + k] == std::stof(row[4 + k]));
    }
    const VtkRead shapes = read_vtk(place.read("out/shapes_000010.vtp"));  // a box and a tetrahedron
    CHECK(shapes.values<float>("Points").size() == 3 * (8 + 4));
    CHECK(shapes.values<std::int64_t>("offsets").size() == 6 + 4);
    CHECK(shapes.values<std::int64_t>("connectivity").size() == 6 * 4 + 4 * 3);
    const VtkRead contacts = read_vtk(place.read("out/contacts_000010.vtp"));
    CHECK(contacts.values<std::int64_t>("a") == std::vector<std::int64_t>(4, 0));
    double pressing = 0;
    for (const float force : contacts.values<float>("normal_force")) pressing += double(force);
    CHECK(pressing == Approx(9.81 * (2 * 4.18879 + 8 + 4.5)).epsilon(0.01));
    const VtkRead grid = read_vtk(place.read("out/grid_000010.vti"));
    CHECK(says(grid.xml, "WholeExtent=\"0 4 0 4 0 4\" Origin=\"-1 0 -1\" Spacing=\"0.5 0.25 0.5\""));
    double solid = 0;
    for (const double volume : grid.values<double>("solid_volume")) solid += volume;
    CHECK(solid == Approx((2 * 4.18879 + 8 + 4.5) / 1000).epsilon(0.002));
    CHECK(read_vtk(place.read("out/walls.vtp")).values<std::int64_t>("id") == std::vector<std::int64_t>(6, 0));

    // VTK itself reads the same.
    const Place script;
    const std::string check = script.write("check.py", R"(
import sys
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLImageDataReader
def read(reader, name):
    reader.SetFileName(sys.argv[1] + "/" + name)
    reader.Update()
    return reader.GetOutput()
grains = read(vtkXMLPolyDataReader(), "grains_000010.vtp")
stress = grains.GetPointData().GetArray("stress")
shapes = read(vtkXMLPolyDataReader(), "shapes_000010.vtp")
lines = read(vtkXMLPolyDataReader(), "contacts_000010.vtp")
grid = read(vtkXMLImageDataReader(), "grid_000010.vti")
solid = grid.GetCellData().GetArray("solid_volume")
print(grains.GetNumberOfPoints(), grains.GetNumberOfCells(), stress.GetNumberOfComponents(), shapes.GetNumberOfPolys(), lines.GetNumberOfLines(),
      grid.GetDimensions(), round(1e6 * sum(solid.GetValue(i) for i in range(solid.GetNumberOfTuples()))),
      grains.GetFieldData().GetArray("TimeValue").GetValue(0))
)");
    if (std::system("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML' 2>/dev/null") != 0) {
        WARN("python3-vtk9 is not installed: VTK itself does not read the files");
    } else {
        const std::string told = (script / "told").string();
        REQUIRE(std::system(("/usr/bin/python3 '" + check + "' '" + out + "' >'" + told + "' 2>&1").c_str()) == 0);
        CHECK(script.read("told") == "4 4 9 10 4 (5, 5, 5) " + std::to_string(std::lround(1e6 * solid)) + " 1.0\n");
    }
    // The folder of a run is its own.
    const Outcome again = run_scree("run " + scene + " --backend cpu --steps 1 --vtk " + out);
    CHECK(again.status == 2);
    CHECK(says(again.errors, "earlier run"));
}

TEST_CASE("program: a run that is killed leaves VTK files that are whole, and an index of these") {
    const Place place;
    const std::string out = (place / "out").string();
    std::thread killer([&] {
        const auto begin = std::chrono::steady_clock::now();
        const auto waits = [&] { return std::chrono::steady_clock::now() - begin < std::chrono::seconds(60); };
        while (waits() && !std::filesystem::exists(place / "out/grains_000007.vtp"))
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ::kill(std::atoi(place.read("pid").c_str()), SIGKILL);
    });
    const Outcome run =
        run_scree("run pile --bodies 1k --backend cpu --threads 1 --seconds 1000 --quiet --vtk-every 1 --vtk " + out,
                  "echo $$ >'" + (place / "pid").string() + "'; exec");
    killer.join();
    CHECK(run.status != 0);
    for (const char* kind : {"grains", "shapes", "contacts"}) {
        const std::vector<std::string> files = files_of_index(place.read("out/" + std::string(kind) + ".pvd"));
        CHECK(files.size() >= 6);
        for (const std::string& file : files) (void)read_vtk(place.read("out/" + file));
    }
}

TEST_CASE("program: measures that make no sense are refused, with the place and the reason") {
    const Place place;
    const std::string scene = place.write("scene.json", scene_text);
    const auto refused = [&](const std::string& arguments, const std::string& reason) {
        const Outcome run = run_scree("run " + arguments);
        INFO(arguments << ": " << run.errors);
        CHECK(run.status == 2);
        CHECK(says(run.errors, reason));
    };
    refused(scene + " --measures-out run.txt", "a table is a .csv or an .npz");
    refused(scene + " --measures-out ''", "the name is empty");
    refused(scene + " --measures-every 4", "no table is asked for");
    refused(scene + " --vtk-every 4", "no VTK files are asked for");
    refused(scene + " --fps 10", "no pictures are asked for");
    refused(scene + " --vtk " + scene, "is a file");
    refused(scene + " --copies 3 --vtk " + (place / "v").string(), "not together with --copies");
    refused(scene + " --measures " + (place / "none.json").string(), "none.json");
    refused(scene + " --measures " +
                place.write("a.json", R"({"regions": [{"shape": {"box": {"lower": [0, 0, 0], "upper": [1, 0, 1]}}}]})"),
            "/regions/0/shape/box/upper/1");
    refused(scene + " --measures " + place.write("b.json", R"({"bodies": [{"body": "tabel"}]})"), "/bodies/0/body");
    refused(scene + " --measures " + place.write("c.json", "{\"regions\": "), "c.json");
    refused(scene + " --measures " + place.write("d.json", R"({"grids": {}})"), "grids");
    refused(place.write(
                "bad.json",
                R"({"bodies": [], "measures": {"grid": {"lower": [0, 0, 0], "upper": [9, 9, 9], "cell": [0.01, 0.01, 0.01]}}})"),
            "/measures/grid/cell");
    CHECK_FALSE(std::filesystem::exists(place / "v"));
}
