// The OpenGL ES canvas: offscreen, from host memory, on any thread. Canvas and test need no Vulkan.
#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>

#include "host/canvas/canvas.h"
#include "host/device_error.h"
#include "shaders/physics/base/records.h"

using namespace scree::host;
using glm::vec3;
using scree::physics::BodyProperties;
using scree::physics::Pose;
using scree::physics::Velocity;

namespace {

// A ground and a box above it.
struct Bodies {
    std::vector<BodyProperties> properties;
    std::vector<Pose> poses;
    std::vector<Velocity> velocities;
    ShapeInstances shapes;

    Bodies() : properties(2), poses(2), velocities(2) {
        properties[0].shape = scree::physics::SHAPE_PLANE;
        properties[0].motion = scree::physics::MOTION_FIXED;
        properties[0].size = {0, 1, 0};
        properties[1].shape = scree::physics::SHAPE_BOX;
        properties[1].size = vec3(1);
        properties[1].inverse_mass = 1;
        poses[0].orientation = poses[1].orientation = {0, 0, 0, 1};
        poses[1].position = {0, 2, 0};
        shapes.planes = {0};
        shapes.boxes = {1};
    }
    BodyTables tables() const { return {properties, poses, velocities}; }
};

CanvasOptions small(int samples = 0) {
    CanvasOptions options;
    options.width = 160;
    options.height = 100;
    options.samples = samples;
    return options;
}

Image picture(Canvas& canvas) {
    return canvas.draw({.eye = {0, 2, 10}, .target = {0, 2, 0}}, {}, "gl", vec3(-4, 0, -4), vec3(4));
}

int brightness(const Image& image, int x, int y) {
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    return image.rgba[i] + image.rgba[i + 1] + image.rgba[i + 2];
}

}  // namespace

TEST_CASE("gl: a box is drawn where it is, its upper side up", "[canvas][gl]") {
    const int samples = GENERATE(1, 4);
    Bodies bodies;
    bodies.poses[1].position = {1, 3.4f, 0};
    const auto canvas = make_gl_canvas(bodies.shapes, small(samples));
    canvas->set_tables(bodies.tables());
    const Image with = picture(*canvas);
    REQUIRE(with.rgba.size() == std::size_t{160} * 100 * 4);
    bodies.poses[1].position.x = 100;
    const Image without = picture(*canvas);
    // A metre is 50 / (10 tan 20) = 13.7 pixels: the box's centre is 14 to the right of and 19 above the picture's.
    const auto change = [&](int x, int y) { return std::abs(brightness(with, x, y) - brightness(without, x, y)); };
    CHECK(change(94, 31) > 60);
    CHECK(change(94, 69) < 10);
    CHECK(change(66, 31) < 10);
    CHECK(with.rgba[4 * (50 * 160 + 80) + 3] == 255);
}

TEST_CASE("gl: without background a picture is clear but for bodies, and for shadows as opaque as they are dark",
          "[canvas][gl]") {
    Bodies bodies;
    CanvasOptions options = small();
    options.background = false;
    options.legend = false;
    options.toward_sun = {-1, 1, 0};
    const std::unique_ptr<Canvas> canvas = make_gl_canvas(bodies.shapes, options);
    canvas->set_tables(bodies.tables());
    const auto drawn = [&] { return canvas->draw({.eye = {0, 4, 10}, .target = {0, 2, 0}}, {}, "", vec3(-4, 0, -4), vec3(4)); };
    Image image = drawn();
    const auto alpha = [&](int x, int y) { return int{image.rgba[4 * static_cast<std::size_t>(y * image.width + x) + 3]}; };
    CHECK(alpha(80, 5) == 0);
    CHECK(alpha(80, 50) == 255);
    // The box's shadow lies on the ground from below it 4 m to the right; the ground to its left is sunlit.
    CHECK(alpha(45, 72) == 0);
    int darkest = 0;
    for (int x = 85; x < 140; ++x) {
        darkest = std::max(darkest, alpha(x, 72));
        if (alpha(x, 72) < 255 && alpha(x, 72) > 0) CHECK(brightness(image, x, 72) < 3 * 160);
    }
    CHECK(darkest > 100);
    CHECK(darkest < 255);
    bodies.poses[1].position.x = 100;  // the next picture has nothing of this one
    image = drawn();
    CHECK(alpha(80, 50) == 0);
}

TEST_CASE("gl: before a backdrop a picture is opaque, and what is transparent without background lies over it", "[canvas][gl]") {
    const Bodies bodies;
    CanvasOptions options = small();
    options.background = false;
    options.legend = false;
    const auto drawn = [&] {
        const std::unique_ptr<Canvas> canvas = make_gl_canvas(bodies.shapes, options);
        canvas->set_tables(bodies.tables());
        return canvas->draw({.eye = {0, 4, 10}, .target = {0, 2, 0}}, {}, "", vec3(-4, 0, -4), vec3(4));
    };
    const Image clear = drawn();
    options.backdrop = linear_from_srgb(vec3(255, 128, 51) / 255.0f);
    const Image before = drawn();
    const std::array<int, 3> levels{255, 128, 51};
    std::array<int, 3> seen{};  // clear, covered, between
    for (std::size_t i = 0; i < clear.rgba.size(); i += 4) {
        const int alpha = clear.rgba[i + 3];
        ++seen[alpha == 0 ? 0 : alpha == 255 ? 1 : 2];
        if (before.rgba[i + 3] != 255) FAIL("a pixel is transparent");
        for (std::size_t k = 0; k < 3; ++k) {
            const float light =
                light_at(clear, i + k) + (1 - static_cast<float>(alpha) / 255) * (*options.backdrop)[static_cast<int>(k)];
            const int level = before.rgba[i + k];
            if (alpha == 0 ? level != levels[k] : std::abs(level - srgb_byte(light)) > 3)
                FAIL(level << " of " << srgb_byte(light));
        }
    }
    for (const int pixels : seen) CHECK(pixels > 100);
}

TEST_CASE("gl: the same state gives the same pixels, on this canvas and on another, from this thread and from another",
          "[canvas][gl]") {
    const int samples = GENERATE(1, 4);
    const Bodies bodies;
    const auto first = make_gl_canvas(bodies.shapes, small(samples)), second = make_gl_canvas(bodies.shapes, small(samples));
    first->set_tables(bodies.tables());
    second->set_tables(bodies.tables());
    const Image expected = picture(*first);
    CHECK(picture(*first).rgba == expected.rgba);
    CHECK(picture(*second).rgba == expected.rgba);
    Image elsewhere;
    std::thread([&] { elsewhere = picture(*first); }).join();
    CHECK(elsewhere.rgba == expected.rgba);
}

TEST_CASE("gl: an empty scene is a picture, too", "[canvas][gl]") {
    const std::vector<BodyProperties> properties;
    const std::vector<Pose> poses;
    const std::vector<Velocity> velocities;
    const auto canvas = make_gl_canvas({}, small());
    canvas->set_tables({properties, poses, velocities});
    CHECK(brightness(picture(*canvas), 80, 5) > 300);
}

TEST_CASE("gl: a canvas refuses what it cannot draw", "[canvas][gl]") {
    CanvasOptions large = small();
    large.width = 1000000;
    CHECK_THROWS_WITH(make_gl_canvas({}, large), Catch::Contains("1000000 x 100"));
    CHECK_THROWS_WITH(make_gl_canvas({}, small(3)), Catch::Contains("samples must be 1 or 4"));
    const Bodies bodies;
    CHECK_THROWS_WITH(make_gl_canvas(bodies.shapes, small())->set_tables({}), Catch::Contains("missing"));
    CHECK_THROWS_WITH(picture(*make_gl_canvas(bodies.shapes, small())), Catch::Contains("missing"));
    CanvasOptions marks = small();
    marks.marks = true;
    CHECK_THROWS_WITH(make_gl_canvas(bodies.shapes, marks)->set_tables(bodies.tables()), Catch::Contains("touches"));
    BodyTables on_device = bodies.tables();
    on_device.poses = TableView(reinterpret_cast<const Buffer*>(&bodies));  // never dereferenced
    CHECK_THROWS_WITH(make_gl_canvas(bodies.shapes, small())->set_tables(on_device), Catch::Contains("host memory"));
}
