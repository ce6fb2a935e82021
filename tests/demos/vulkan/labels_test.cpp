// Labels of pictures of the two canvases against each other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "demos/film/drawing.h"
#include "host/canvas/labels.h"
#include "host/vulkan/device.h"
#include "tests/demos/shapes_in_the_air.h"

using namespace scree;

TEST_CASE("labels: both canvases tell the same", "[vulkan]") {
    constexpr int width = 160, height = 120;
    World world(tests::shapes(false), {}, 1);
    host::CanvasOptions options;
    options.width = 2 * width;  // as with several samples a pixel
    options.height = 2 * height;
    demos::Backend machine;
    machine.device = host::Device::open({.which = "", .validation = true, .on_message = {}});
    demos::Drawing gl("gl", {}, world, options), vulkan("vulkan", machine, world, options, {}, true);
    REQUIRE(vulkan.canvas().name().starts_with("Vulkan"));
    const auto sorted = [](std::vector<host::Cover> covers) {
        std::vector<std::uint64_t> keys;
        for (const host::Cover& one : covers) keys.push_back(std::uint64_t{one.row} << 32 | one.pixel);
        std::sort(keys.begin(), keys.end());
        return keys;
    };
    const auto cameras = tests::cameras();
    for (const std::size_t chosen : {0u, 1u, 4u, 7u}) {
        INFO(chosen);
        const host::Camera& camera = cameras[chosen];
        for (const glm::ivec2 shift : {glm::ivec2(0, 0), glm::ivec2(1, -1)}) {
            const host::LabelRequest request{.width = width, .height = height, .covers = true, .shift = shift};
            // Between the beginning and the end of a picture.
            vulkan.canvas().begin(camera, {}, "", vec3(-5), vec3(5));
            const auto one = vulkan.canvas().label(camera, request);
            const host::Image picture = vulkan.canvas().finish();
            const auto other = gl.canvas().label(camera, request);
            CHECK(picture.rgba == vulkan.canvas().draw(camera, {}, "", vec3(-5), vec3(5)).rgba);
            REQUIRE((one && other));
            REQUIRE((one->pixels.size() == std::size_t{width} * height && other->pixels.size() == one->pixels.size()));
            std::size_t rows = 0, surfaces = 0;
            for (std::size_t i = 0; i < one->pixels.size(); ++i) {
                const host::LabelledPixel &a = one->pixels[i], &b = other->pixels[i];
                const bool same_depth = a.depth == b.depth || std::abs(a.depth - b.depth) < 1e-4f * b.depth;
                const bool same = same_depth && glm::distance(host::normal_of(a), host::normal_of(b)) < 2e-3f;
                rows += a.row != b.row ? 1 : 0;
                surfaces += a.row == b.row && !same ? 1 : 0;
            }
            CHECK(rows < 20);
            CHECK(surfaces < 20);
            const std::vector<std::uint64_t> these = sorted(one->covers), those = sorted(other->covers);
            std::vector<std::uint64_t> apart;
            std::set_symmetric_difference(these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(apart));
            CHECK((these.size() > 1000 || shift != glm::ivec2(0)));
            CHECK(static_cast<double>(apart.size()) <= 0.002 * static_cast<double>(these.size()));
        }
    }
    for (const std::string& message : machine.device->validation_messages()) FAIL_CHECK(message);
}
