// The program without installed Vulkan or OpenGL ES drivers.
#include <catch2/catch.hpp>

#include "host/pictures/image.h"
#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

// Hides libraries: invalid files of the same names come first in the dynamic loader's search path.
class Without {
public:
    explicit Without(const std::vector<std::string>& libraries) {
        for (const std::string& library : libraries) place_.write(library, "no library");
    }
    Outcome run(const std::string& arguments) const {
        return run_scree(arguments, "LD_LIBRARY_PATH='" + place_.path().string() + "'");
    }

private:
    Place place_;
};

scree::host::Image upside_down(const scree::host::Image& image) {
    scree::host::Image turned = image;
    const std::size_t row = std::size_t{4} * static_cast<std::size_t>(image.width);
    for (std::size_t at = 0; at < image.rgba.size(); ++at)
        turned.rgba[image.rgba.size() - row * (1 + at / row) + at % row] = image.rgba[at];
    return turned;
}

// Mean channel difference, 1/255.
double mean_difference(const scree::host::Image& a, const scree::host::Image& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(a.rgba[i] - b.rgba[i]);
    return sum / static_cast<double>(a.rgba.size());
}

// Fraction of channels that differ by more than 24/255.
double strayed(const scree::host::Image& a, const scree::host::Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) count += std::abs(a.rgba[i] - b.rgba[i]) > 24 ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(a.rgba.size());
}

const std::vector<std::string> vulkan = {"libvulkan.so.1", "libvulkan.so"};
const std::vector<std::string> vulkan_and_gl = {"libvulkan.so.1", "libvulkan.so", "libEGL.so.1"};

}  // namespace

TEST_CASE("program: without the Vulkan loader a run has its pictures all the same", "[program][gl]") {
    const Without hidden(vulkan);
    const Outcome devices = hidden.run("devices");
    REQUIRE(devices.status == 2);  // Vulkan is hidden
    REQUIRE((says(devices.errors, "no Vulkan loader") || says(devices.errors, "built without Vulkan")));
    const std::string backend = GENERATE("--backend cpu", "");
    const Place place;
    const std::string frames = (place / "frames").string();
    const Outcome run = hidden.run("run pyramid --show contacts --steps 6 --fps 20 --size 320x180 --report - " + backend +
                                   " --frames '" + frames + "'");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    REQUIRE(says(run.output, "\"canvas\": \"OpenGL ES"));
    for (const char* const name : {"frame_000000.png", "frame_000001.png", "frame_000002.png"}) {
        const scree::host::Image image = scree::host::read_png(place / "frames" / name);
        REQUIRE(image.width == 320);
        REQUIRE(mean_difference(image, upside_down(image)) > 20);  // the picture is not blank
    }
}

TEST_CASE("program: without Vulkan and OpenGL ES pictures are refused before the run, with what to install", "[program][gl]") {
    const Without hidden(vulkan_and_gl);
    const Place place;
    const std::string frames = " --steps 2 --backend cpu --frames '" + (place / "frames").string() + "'";
    const Outcome run = hidden.run("run rest" + frames);
    INFO(run.errors);
    REQUIRE(run.status == 2);
    REQUIRE(says(run.errors, "libegl1"));
    REQUIRE(says(run.errors, "libgl1-mesa-dri"));
    REQUIRE_FALSE(std::filesystem::exists(place / "frames/frame_000000.png"));
    const Outcome gl = hidden.run("run rest --canvas gl" + frames);
    REQUIRE(gl.status == 2);
    REQUIRE(says(gl.errors, "libegl1"));
    REQUIRE(hidden.run("run rest --steps 2 --backend cpu").status == 0);  // no canvas needed without pictures
}

TEST_CASE("program: the canvas draws alike whether or not depth in clip space can be as in Vulkan", "[program][gl]") {
    const Place place;
    const auto run = [&](const std::string& folder, const std::string& before) {
        const Outcome outcome =
            run_scree("run mix --bodies 100 --steps 1 --backend cpu --canvas gl --size 320x180 --quiet --frames '" +
                          (place / folder).string() + "'",
                      before);
        INFO(outcome.errors);
        REQUIRE(outcome.status == 0);
        return scree::host::read_png(place / folder / "frame_000000.png");
    };
    const scree::host::Image with = run("with", ""), without = run("without", "MESA_EXTENSION_OVERRIDE=-GL_EXT_clip_control");
    REQUIRE(mean_difference(with, without) < 1);
    REQUIRE(strayed(with, without) < 0.003);
}
