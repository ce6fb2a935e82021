// Pictures: colours of quantities that match the legend, overlays, cameras.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "host/canvas/draw_geometry.h"
#include "host/canvas/overlay.h"
#include "tests/host/vulkan/canvas_stage.h"

using namespace scree::host;
using glm::vec3;

namespace {

vec3 light_of(const Pixel& pixel) {
    const auto linear = [](int byte) { return linear_from_srgb(static_cast<float>(byte) / 255.0f); };
    return {linear(pixel.r), linear(pixel.g), linear(pixel.b)};
}

// Sun direction that lights the face towards the camera without a highlight.
CanvasOptions lit_from_aside(bool shadows = false) {
    CanvasOptions options = small(4, shadows);
    options.toward_sun = {0.9f, 0.5f, 0.8f};
    return options;
}

// Whether a lit pixel has the expected hue, at any brightness.
bool has_hue(const Pixel& seen, vec3 expected) {
    const vec3 shown = light_of(seen);
    const float strength = glm::length(shown) / glm::length(expected);
    return strength > 0.5f && strength < 2 && glm::length(shown - expected * strength) < 0.15f * glm::length(shown) + 0.02f;
}

ColorScale scale_of(ColorBy by, float low, float high) {
    ColorScale scale;
    scale.by = by;
    scale.map = ColorMap::viridis;
    scale.low = low;
    scale.high = high;
    return scale;
}

// Two boxes side by side, the first on the left.
void add_two_boxes(Stage& stage) {
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {-1.5f, 2, 0}, vec3(0), 8);
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {1.5f, 2, 0}, vec3(0), 8);
}
Pixel left_of(const Image& image) {
    return at(image, 160 - 42, 100);
}
Pixel right_of(const Image& image) {
    return at(image, 160 + 42, 100);
}

std::size_t changed(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) count += differ(at(a, x, y), at(b, x, y)) ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("a tick of the legend stands at the pixel that has the colour of its value", "[canvas]") {
    CanvasOptions options;
    options.height = GENERATE(360, 720, 1440);
    options.width = options.height * 16 / 9;
    options.samples = 1;
    options.shadows = false;
    ColorScale scale = scale_of(ColorBy::speed, 0, 7);
    scale.logarithmic = GENERATE(false, true);
    if (scale.logarithmic) scale.low = 0.002f;
    CAPTURE(options.height, scale.logarithmic);
    Stage stage;
    const Image image = stage.picture(options, AHEAD, scale, "");
    const BarPlace bar = legend_bar(options.width, options.height);
    // Ticks: runs of brighter pixels in the row below the bar.
    std::vector<int> row;
    for (int x = bar.left; x < bar.right; ++x) row.push_back(at(image, x, bar.bottom + 1).sum());
    std::nth_element(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2), row.end());
    const int usual = row[row.size() / 2];
    const auto lit = [&](int x, int y) { return at(image, x, y).sum() > usual + 90; };
    std::vector<double> ticks;
    for (int x = bar.left - 3; x < bar.right + 3; ++x) {
        if (!lit(x, bar.bottom + 1)) continue;
        const int first = x;
        while (lit(x, bar.bottom + 1)) ++x;
        ticks.push_back(0.5 * (first + x - 1));
    }
    const std::vector<float> values = scale_ticks(scale.low, scale.high, scale.logarithmic, 6);
    REQUIRE(values.size() >= 3);
    REQUIRE(ticks.size() == values.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        CAPTURE(i, values[i], ticks[i]);
        const vec3 expected = map_color(scale.map, scale_place(scale, values[i]));
        const auto apart = [&](int x) {
            const Pixel pixel = at(image, x, (bar.top + bar.bottom) / 2);
            return std::abs(pixel.r - srgb_byte(expected.r)) + std::abs(pixel.g - srgb_byte(expected.g)) +
                   std::abs(pixel.b - srgb_byte(expected.b));
        };
        int nearest = bar.left;
        for (int x = bar.left; x < bar.right; ++x) nearest = apart(x) < apart(nearest) ? x : nearest;
        CHECK(apart(nearest) <= 6);
        // Adjacent pixels may have equal 8-bit colours; the tick's centre is at one of them.
        double off = 1e9;
        for (int x = bar.left; x < bar.right; ++x) off = apart(x) == apart(nearest) ? std::min(off, std::abs(ticks[i] - x)) : off;
        CHECK(off <= 1);
    }
}

TEST_CASE("a body has the colour of what its contacts push, and of how many they are", "[canvas]") {
    Stage stage;
    add_two_boxes(stage);
    for (const float push : {3.0f, 5.0f, 100.0f}) stage.add_touch({0, 2, 0}, {1, 0, 0}, push);
    // The first body has contacts 0 and 1, the second none; contact 2 is between others.
    stage.set_slots({2, 2}, {0, 2, 4});
    const Image pushed = stage.picture(lit_from_aside(), AHEAD, scale_of(ColorBy::contact_impulse, 0, 10));
    CHECK(has_hue(left_of(pushed), map_color(ColorMap::viridis, 0.8f)));
    CHECK(has_hue(right_of(pushed), map_color(ColorMap::viridis, 0)));
    const Image counted = stage.picture(lit_from_aside(), AHEAD, scale_of(ColorBy::contacts, 0, 4));
    CHECK(has_hue(left_of(counted), map_color(ColorMap::viridis, 0.5f)));
    CHECK(has_hue(right_of(counted), map_color(ColorMap::viridis, 0)));
    require_no_messages();
}

TEST_CASE("a body has the colour of its spin's angular momentum, of its rest and of its material", "[canvas]") {
    Stage stage;
    add_two_boxes(stage);
    stage.properties(0).inverse_inertia = vec3(0.5f, 0.25f, 1);
    stage.velocity(0).angular = {0, 1.5f, 0};
    const Image spinning = stage.picture(lit_from_aside(), AHEAD, scale_of(ColorBy::angular_momentum, 0, 10));
    CHECK(has_hue(left_of(spinning), map_color(ColorMap::viridis, 0.6f)));
    CanvasOptions options = lit_from_aside();
    options.sleep_steps = 30;
    options.step_seconds = 0.02f;
    stage.set_rest(0, 20);
    stage.set_rest(1, 30);
    const Image resting = stage.picture(options, AHEAD, scale_of(ColorBy::rest, 0, 1));
    CHECK(has_hue(left_of(resting), map_color(ColorMap::viridis, 0.4f)));
    CHECK(has_hue(right_of(resting), map_color(ColorMap::viridis, 1)));  // asleep
    ColorScale scale = scale_of(ColorBy::material, 0, 1);
    scale.materials = {{{0.2f, 0, 1}, "smooth"}, {{0.9f, 0, 1}, "rough"}};  // 8 kg in 8 m^3
    stage.properties(0).friction = 0.85f;
    stage.properties(1).friction = 0.3f;
    const Image materials = stage.picture(lit_from_aside(), AHEAD, scale);
    CHECK(has_hue(left_of(materials), name_color(1)));
    CHECK(has_hue(right_of(materials), name_color(0)));
    require_no_messages();
}

TEST_CASE("on a logarithmic scale equal factors are equally far apart", "[canvas]") {
    ColorScale scale = scale_of(ColorBy::momentum, 1, 10000);
    scale.logarithmic = true;
    Stage stage;
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {-1.5f, 2, 0}, {10, 0, 0}, 1);
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {1.5f, 2, 0}, {1000, 0, 0}, 1);
    const Image image = stage.picture(lit_from_aside(), AHEAD, scale);
    CHECK(has_hue(left_of(image), map_color(ColorMap::viridis, 0.25f)));
    CHECK(has_hue(right_of(image), map_color(ColorMap::viridis, 0.75f)));
}

TEST_CASE("an arrow points where its body goes and is as long as the way", "[canvas]") {
    CanvasOptions options = small(GENERATE(1, 4), false);
    Stage stage;
    stage.add(scree::physics::SHAPE_SPHERE, vec3(0.2f), {0, 2, 0}, {10, 0, 0});
    const Image without = stage.picture(options, AHEAD);
    options.velocities = true;
    const Image with = stage.picture(options, AHEAD);
    // 2 m in 0.2 s, at 10 m: 55 pixels.
    const auto drawn = [&](int x, int y) { return differ(at(with, x, y), at(without, x, y)); };
    CHECK(drawn(160 + 40, 100));
    CHECK(drawn(160 + 51, 100));
    CHECK_FALSE(drawn(160 + 58, 100));
    CHECK_FALSE(drawn(160 - 10, 100));
    CHECK_FALSE(drawn(160 + 40, 106));
    require_no_messages();
}

TEST_CASE("bounds and cells are drawn around their bodies", "[canvas]") {
    CanvasOptions options = small(1, false);
    Stage stage;
    stage.add(scree::physics::SHAPE_SPHERE, vec3(0.3f), {0.5f, 2.5f, 0.5f});
    stage.set_bounds(0, {0, 2, 0}, {1, 3, 1}, 0);
    const Image without = stage.picture(options, AHEAD);
    options.boxes = true;
    const Image boxes = stage.picture(options, AHEAD);
    // The front face at z = 1: a metre at 9 m is 30.5 pixels.
    CHECK(differ(at(boxes, 160, 85), at(without, 160, 85)));
    CHECK((differ(at(boxes, 160 + 30, 85), at(without, 160 + 30, 85)) ||
           differ(at(boxes, 160 + 31, 85), at(without, 160 + 31, 85))));
    CHECK_FALSE(differ(at(boxes, 160 + 36, 85), at(without, 160 + 36, 85)));
    options.boxes = false;
    options.cells = true;
    options.cell = 4;  // the cell from (0, 0, 0) to (4, 4, 4)
    const Image cells = stage.picture(options, AHEAD);
    CHECK(differ(at(cells, 160, 110), at(without, 160, 110)));
    CHECK_FALSE(differ(at(cells, 160 + 31, 85), at(without, 160 + 31, 85)));
    require_no_messages();
}

TEST_CASE("sleepers are tinted, and only sleepers", "[canvas]") {
    CanvasOptions options = lit_from_aside();
    options.sleep_steps = 30;
    Stage stage;
    add_two_boxes(stage);
    stage.set_rest(0, 30);
    stage.set_rest(1, 29);
    const Image without = stage.picture(options, AHEAD);
    options.sleep = true;
    const Image with = stage.picture(options, AHEAD);
    CHECK(differ(left_of(with), left_of(without)));
    CHECK_FALSE(differ(right_of(with), right_of(without)));
}

TEST_CASE("with parallel rays a body is as large near and far", "[canvas]") {
    const auto shape = GENERATE(scree::physics::SHAPE_SPHERE, scree::physics::SHAPE_CAPSULE, scree::physics::SHAPE_BOX);
    CAPTURE(shape);
    Camera camera = AHEAD;
    camera.orthographic = true;
    for (const float z : {4.0f, 0.0f, -30.0f}) {
        CAPTURE(z);
        Stage empty, stage;
        stage.add(shape, {1, 0.2f, 1}, {0, 2, z});
        const Image without = empty.picture(small(4, false), camera);
        const Image with = stage.picture(small(4, false), camera);
        // The target is 10 m away, where a metre is 100 / (10 tan 20) = 27.5 pixels.
        CHECK(differ(at(with, 160 + 25, 100), at(without, 160 + 25, 100)));
        CHECK_FALSE(differ(at(with, 160 + 30, 100), at(without, 160 + 30, 100)));
    }
    Stage ground;
    ground.add_ground();
    const Camera above{.eye = {0, 10, 6}, .target = {0, 0, 0}, .vertical_fov = 40, .orthographic = true};
    const Image image = ground.picture(small(1, false), above);
    CHECK(at(image, 160, 10).b - at(image, 160, 10).r < 10);  // the ground's grey, not the sky's blue
    require_no_messages();
}

TEST_CASE("16 bits tell more than 8, and the same", "[canvas]") {
    CanvasOptions options = small(GENERATE(1, 4), true, true);
    Stage stage;
    stage.add_ground();
    stage.add(scree::physics::SHAPE_SPHERE, vec3(1), {0, 2, 0}, {5, 0, 0}, 2);
    const Image coarse = stage.picture(options, AHEAD, {}, "bits");
    options.bits = 16;
    const Image fine = stage.picture(options, AHEAD, {}, "bits");
    REQUIRE(fine.bits == 16);
    REQUIRE(fine.rgba.size() == 2 * coarse.rgba.size());
    std::vector<bool> levels(65536);
    double sum = 0;
    for (std::size_t i = 0; i < coarse.rgba.size(); ++i) {
        std::uint16_t level = 0;
        std::memcpy(&level, &fine.rgba[2 * i], 2);
        levels[level] = true;
        sum += std::abs(level / 257.0 - coarse.rgba[i]);
    }
    CHECK(std::count(levels.begin(), levels.end(), true) > 1500);
    CHECK(sum / static_cast<double>(coarse.rgba.size()) < 0.4);  // rounding alone: 0.25 in three channels of four
    require_no_messages();
}

TEST_CASE("what is not seen is not drawn, and what is far is drawn with fewer triangles and looks alike", "[canvas]") {
    const ShapeInstances none;
    const Scenery scenery(none);
    for (std::uint32_t k = 1; k < SPHERE_DETAILS; ++k)
        CHECK(scenery.runs[RUN_SPHERES + k].corners < scenery.runs[RUN_SPHERES + k - 1].corners);
    // Every level of detail draws a sphere with the correct area in pixels.
    for (const float distance : {6.0f, 20.0f, 60.0f, 180.0f}) {
        CAPTURE(distance);
        const Camera camera{.eye = {0, 2, distance}, .target = {0, 2, 0}, .vertical_fov = 40};
        Stage empty, stage;
        stage.add(scree::physics::SHAPE_SPHERE, vec3(1), {0, 2, 0});
        const double pixels = 100 / (std::tan(glm::radians(20.0)) * std::sqrt(distance * distance - 1.0));
        const double area = 3.14159265 * pixels * pixels;
        const std::size_t seen = changed(stage.picture(small(1, false), camera), empty.picture(small(1, false), camera));
        CHECK(static_cast<double>(seen) > 0.8 * area - 3);
        CHECK(static_cast<double>(seen) < 1.25 * area + 12);
    }
    // Frustum culling: bodies in every direction around the camera; those behind are culled, none in front.
    Stage around, ahead;
    for (int i = 0; i < 600; ++i) {
        const float angle = 0.0104719755f * static_cast<float>(i), height = static_cast<float>(i * 7 % 11) - 5;
        const vec3 place(12 * std::sin(angle), 2 + height, 12 * std::cos(angle));
        const auto shape = static_cast<scree::physics::uint>(i % 3);
        around.add(shape, vec3(0.3f), place);
        if (place.z < 1) ahead.add(shape, vec3(0.3f), place);
    }
    const Camera inside{.eye = {0, 2, 0}, .target = {0, 2, -1}, .vertical_fov = 60};
    CHECK(around.picture(small(1, false), inside).rgba == ahead.picture(small(1, false), inside).rgba);
    require_no_messages();
}
