// Pictures: positions and colours of bodies, shadows, legend.
#include "host/canvas/canvas.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "host/canvas/overlay.h"
#include "tests/host/vulkan/canvas_stage.h"

using namespace scree::host;
using glm::vec3;

TEST_CASE("a body is drawn where it is and as large as it is", "[canvas]") {
    const int samples = GENERATE(1, 4);
    const auto shape = GENERATE(scree::physics::SHAPE_SPHERE, scree::physics::SHAPE_CAPSULE, scree::physics::SHAPE_BOX);
    CAPTURE(samples, shape);
    Stage empty, stage;
    const vec3 size = shape == scree::physics::SHAPE_BOX ? vec3(1, 1, 0.001f) : vec3(1, 1, 0);
    stage.add(shape, size, {0, 2, 0});
    const Image without = empty.picture(small(samples), AHEAD);
    const Image with = stage.picture(small(samples), AHEAD);
    // At 10 m the silhouette of a sphere of radius 1 is at slope 1/sqrt(99) off the axis; 1 m of a flat box is 1/10.
    const double scale = 100 / std::tan(glm::radians(20.0));
    const int reach = static_cast<int>(std::round(scale * (shape == scree::physics::SHAPE_BOX ? 0.1 : 1 / std::sqrt(99.0))));
    const auto drawn = [&](int x, int y) { return differ(at(with, x, y), at(without, x, y)); };
    CHECK(drawn(160, 100));
    CHECK(drawn(160 + reach - 3, 100));
    CHECK(drawn(160 - reach + 3, 100));
    CHECK_FALSE(drawn(160 + reach + 3, 100));
    CHECK_FALSE(drawn(160 - reach - 3, 100));
    const int above = shape == scree::physics::SHAPE_CAPSULE ? 2 * reach : reach;  // a capsule's half height adds
    if (above < 96) {
        CHECK(drawn(160, 100 - above + 4));
        CHECK_FALSE(drawn(160, 100 - above - 4));
    }
    require_no_messages();
}

TEST_CASE("a body of a millimetre is seen from nearby", "[canvas]") {
    Stage empty, stage;
    stage.add(scree::physics::SHAPE_SPHERE, {0.001f, 0, 0}, {0, 2, 0});
    Camera camera;
    camera.target = {0, 2, 0};
    camera.eye = {0, 2, 0.01f};
    CHECK(differ(at(stage.picture(small(1), camera), 160, 100), at(empty.picture(small(1), camera), 160, 100)));
}

TEST_CASE("a turned capsule lies as it is turned", "[canvas]") {
    const float h = std::sqrt(0.5f);
    Stage empty, stage;
    stage.add(scree::physics::SHAPE_CAPSULE, {0.3f, 1.5f, 0}, {0, 2, 0}, vec3(0), 1, {0, 0, h, h});  // axis along x
    const Image without = empty.picture(small(4), AHEAD);
    const Image with = stage.picture(small(4), AHEAD);
    CHECK(differ(at(with, 160 + 41, 100), at(without, 160 + 41, 100)));
    CHECK_FALSE(differ(at(with, 160, 100 - 41), at(without, 160, 100 - 41)));
}

TEST_CASE("a body has the colour of its momentum", "[canvas]") {
    ColorScale scale;
    scale.low = 0;
    scale.high = 100;
    scale.map = ColorMap::viridis;
    const float momentum = GENERATE(20.0f, 55.0f, 95.0f);
    CAPTURE(momentum);
    Stage stage;
    const float mass = 8;
    // The sun lights the face without a highlight.
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {0, 2, 0}, {momentum / mass, 0, 0}, mass);
    CanvasOptions options = small(4, false);
    options.toward_sun = {0.9f, 0.5f, 0.8f};
    const Pixel seen = at(stage.picture(options, AHEAD, scale), 160, 100);
    const vec3 expected = map_color(ColorMap::viridis, momentum / 100);
    const auto linear = [](int byte) { return linear_from_srgb(static_cast<float>(byte) / 255.0f); };
    const vec3 shown(linear(seen.r), linear(seen.g), linear(seen.b));
    const float strength = glm::length(shown) / glm::length(expected);
    CAPTURE(shown.r, shown.g, shown.b, expected.r, expected.g, expected.b);
    CHECK(strength > 0.7f);
    CHECK(strength < 1.6f);
    CHECK(glm::length(shown - expected * strength) < 0.15f * glm::length(shown) + 0.02f);
}

TEST_CASE("a fixed body is grey whatever the scale says", "[canvas]") {
    Stage stage;
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {0, 2, 0}, vec3(0), 0);
    const Pixel seen = at(stage.picture(small(4, false), AHEAD), 160, 100);
    CHECK(std::abs(seen.r - seen.b) < 30);
}

TEST_CASE("bodies have their own colours, and without one a light grey", "[canvas]") {
    Stage stage;
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {-2.5f, 2, 0});
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {0, 2, 0});
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {2.5f, 2, 0});
    stage.color({{0.6f, 0.02f, 0.02f, 1}, {0.02f, 0.02f, 0.6f, 1}, {0.6f, 0, 0, 0}});
    ColorScale scale;
    scale.by = ColorBy::own;
    const Image image = stage.canvas(small(1))->draw(AHEAD, scale, "", vec3(-4, 0, -4), vec3(4));
    const auto most = [&](int from, int to, auto holds) {
        int count = 0;
        for (int x = from; x < to; ++x)
            for (int y = 0; y < 200; ++y) count += holds(at(image, x, y));
        return count;
    };
    const auto red = [](const Pixel& p) { return p.r > 2 * p.b; };
    const auto blue = [](const Pixel& p) { return p.b > 2 * p.r; };
    CHECK(most(0, 130, red) > 200);
    CHECK(most(130, 190, blue) > 200);
    CHECK(most(210, 320, red) == 0);
    CHECK(most(210, 320, blue) == 0);
}

TEST_CASE("every quantity can be drawn", "[canvas]") {
    Stage stage;
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {0, 2, 0}, {3, 0, 0}, 2);
    stage.add(scree::physics::SHAPE_BOX, vec3(1), {3, 2, 0}, {3, 0, 0}, 2);
    stage.add_touch({1.5f, 2, 0}, {1, 0, 0}, 1);
    stage.set_slots({1, 2, 2}, {0, 1});
    stage.add_ground();
    const std::unique_ptr<Canvas> canvas = stage.canvas(small(1, true, true));
    for (const std::string& name : color_by_names()) {
        ColorScale scale;
        scale.by = *color_by_named(name);
        const Image image = canvas->draw(AHEAD, scale, name, vec3(-4, 0, -4), vec3(4));
        CHECK(image.rgba.size() == std::size_t{320} * 200 * 4);
        CHECK(at(image, 0, 0).a == 255);
    }
    require_no_messages();
}

TEST_CASE("a body's shadow darkens the ground on the side away from the sun", "[canvas]") {
    CanvasOptions options = small(1);
    options.toward_sun = {-1, 1, 0};
    const Camera above{.eye = {0, 12, 0.01f}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov = 40};
    const auto shape = GENERATE(scree::physics::SHAPE_SPHERE, scree::physics::SHAPE_CAPSULE, scree::physics::SHAPE_BOX);
    CAPTURE(shape);
    Stage empty, stage;
    empty.add_ground();
    stage.add_ground();
    stage.add(shape, {0.4f, 0.4f, 0.4f}, {0.2f, 2, 0.2f});
    const Image without = empty.picture(options, above);
    const Image with = stage.picture(options, above);
    // The sun at 45 degrees casts the shadow of (0.2, 2) at (2.2, 0); a metre is 100 / (12 tan 20) = 22.9 pixels.
    const int x = 160 + 50, y = 100 + 5;
    CHECK(at(with, x, y).sum() < 0.75 * at(without, x, y).sum());
    CHECK_FALSE(differ(at(with, 160 - 50, y), at(without, 160 - 50, y)));
    options.shadows = false;
    CHECK_FALSE(differ(at(stage.picture(options, above), x, y), at(without, x, y)));
    require_no_messages();
}

TEST_CASE("a body thrown out of the scene's box has a shadow where it is seen, and so have those that stay", "[canvas]") {
    CanvasOptions options = small(1);
    options.toward_sun = {-1, 1, 0};
    // The box of pictures reaches from -4 to 4 m. The ball is 40 m away, seen from 12 m above.
    const float away = 40;
    const Camera above{.eye = {away, 12, 0.01f}, .target = {away, 0, 0}, .up = {0, 0, -1}, .vertical_fov = 40};
    Stage empty, stage;
    for (Stage* each : {&empty, &stage}) {
        each->add_ground();
        each->add(scree::physics::SHAPE_BOX, vec3(0.5f), {0, 0.5f, 0});
    }
    stage.add(scree::physics::SHAPE_SPHERE, vec3(0.4f), {away + 0.2f, 2, 0.2f});
    const Image without = empty.picture(options, above), with = stage.picture(options, above);
    CHECK(at(with, 160 + 50, 105).sum() < 0.75 * at(without, 160 + 50, 105).sum());
    CHECK_FALSE(differ(at(with, 160 - 50, 105), at(without, 160 - 50, 105)));
    // Its shadow falls into the picture though it is above it, out of sight.
    Stage high;
    high.add_ground();
    high.add(scree::physics::SHAPE_SPHERE, vec3(0.4f), {away - 10, 12, 0});
    const Image shaded = high.picture(options, above);
    CHECK(at(shaded, 160 + 46, 100).sum() < 0.85 * at(without, 160 + 46, 100).sum());
    require_no_messages();
}

TEST_CASE("the ends of the legend's bar are the ends of the map", "[canvas]") {
    CanvasOptions options;
    options.width = GENERATE(1280, 640);
    options.height = options.width * 9 / 16;
    options.samples = GENERATE(1, 4);
    ColorScale scale;
    scale.map = GENERATE(ColorMap::plasma, ColorMap::viridis, ColorMap::turbo);
    Stage stage;
    const Image image = stage.picture(options, AHEAD, scale, "a caption");
    const BarPlace bar = legend_bar(options.width, options.height);
    const int y = (bar.top + bar.bottom) / 2;
    const auto near_to = [](const Pixel& seen, vec3 color) {
        return std::abs(seen.r - srgb_byte(color.r)) <= 2 && std::abs(seen.g - srgb_byte(color.g)) <= 2 &&
               std::abs(seen.b - srgb_byte(color.b)) <= 2;
    };
    CHECK(near_to(at(image, bar.left, y), map_color(scale.map, 0)));
    CHECK(near_to(at(image, bar.right - 1, y), map_color(scale.map, 1)));
    CHECK_FALSE(near_to(at(image, bar.left - 2, y), map_color(scale.map, 0)));
    require_no_messages();
}

TEST_CASE("a mark lies on the point where two bodies touch, and its line along the normal", "[canvas]") {
    CanvasOptions options = small(GENERATE(1, 4));
    options.marks = true;
    const bool behind = GENERATE(false, true);
    CAPTURE(options.samples, behind);
    Stage plain, stage;
    for (Stage* each : {&plain, &stage}) {
        if (behind) each->add(scree::physics::SHAPE_BOX, {2, 1.5f, 0.1f}, {0, 2, 4}, vec3(0), 0);
        each->add(scree::physics::SHAPE_BOX, vec3(1), {-1, 2, 0});
        each->add(scree::physics::SHAPE_BOX, vec3(1), {1, 2, 0});
    }
    stage.add_touch({0, 2.5f, 1}, {1, 0, 0}, 4 * options.mark_push);
    const Image without = plain.picture(options, AHEAD);
    const Image with = stage.picture(options, AHEAD);
    const auto change = [&](int x, int y) {
        const Pixel a = at(with, x, y), b = at(without, x, y);
        return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
    };
    // A metre at 9 m is 100 / (9 tan 20) = 30.5 pixels; the line is half a metre long to either side.
    const int x = 160, y = 100 - 15;
    const Pixel mark = at(with, x, y);
    for (const int dx : {-13, 0, 13}) CHECK((change(x + dx, y) > 6) == !behind);  // hidden by what is before it
    if (!behind) CHECK(change(x, y) > 100);
    if (!behind) CHECK(mark.g > std::max(mark.r, mark.b));
    CHECK(change(x + 20, y) == 0);
    CHECK(change(x, y + 8) == 0);
    CHECK(change(x, y - 8) == 0);
    require_no_messages();
}

TEST_CASE("the same state gives the same pixels", "[canvas]") {
    const int samples = GENERATE(1, 4);
    const auto draw = [&] {
        Stage stage;
        stage.add_ground();
        for (int i = 0; i < 60; ++i) {
            const auto x = static_cast<float>(i % 8) - 4, z = static_cast<float>(i / 8) - 4;
            const auto shape = static_cast<scree::physics::uint>(i % 3);
            stage.add(shape, vec3(0.4f), {x, 0.5f + 0.1f * static_cast<float>(i % 5), z}, {static_cast<float>(i % 7), 0, 0}, 2);
        }
        return stage.picture(small(samples, true, true), {.eye = {6, 5, 9}, .target = {0, 0, 0}}, {}, "twice").rgba;
    };
    CHECK(draw() == draw());
    require_no_messages();
}

TEST_CASE("a canvas follows buffers that were made anew", "[canvas]") {
    Stage first, second;
    first.add(scree::physics::SHAPE_SPHERE, vec3(1), {0, 2, 0});
    second.add(scree::physics::SHAPE_SPHERE, vec3(1), {3, 2, 0});
    const std::unique_ptr<Canvas> canvas = first.canvas(small(1));
    const Image before = canvas->draw(AHEAD, {}, "", vec3(-4, 0, -4), vec3(4));
    const std::shared_ptr<Device> device = validated_device();
    Buffer properties(device, "properties", sizeof(BodyProperties)), poses(device, "poses", sizeof(Pose)),
        velocities(device, "velocities", sizeof(Velocity));
    BodyProperties body{};
    body.size = vec3(1);
    body.inverse_mass = 1;
    const Pose moved{{3, 2, 0}, 0, {0, 0, 0, 1}};
    properties.write(&body, sizeof body);
    poses.write(&moved, sizeof moved);
    canvas->set_tables({&properties, &poses, &velocities});
    CHECK(canvas->draw(AHEAD, {}, "", vec3(-4, 0, -4), vec3(4)).rgba == second.picture(small(1), AHEAD).rgba);
    CHECK(before.rgba != second.picture(small(1), AHEAD).rgba);
}

TEST_CASE("a picture that was begun is that of its moment", "[canvas]") {
    Stage stage, moved;
    stage.add(scree::physics::SHAPE_SPHERE, vec3(1), {0, 2, 0});
    moved.add(scree::physics::SHAPE_SPHERE, vec3(1), {2, 2, 0});
    const auto canvas = stage.canvas(small(1));
    const vec3 low(-4, 0, -4), high(4);
    const Image before = canvas->draw(AHEAD, {}, "", low, high);
    canvas->begin(AHEAD, {}, "", low, high);
    CHECK(canvas->finish().rgba == before.rgba);
    canvas->begin(AHEAD, {}, "", low, high);  // and never finish()
    CHECK(moved.picture(small(1), AHEAD).rgba != before.rgba);
    require_no_messages();
}

TEST_CASE("a canvas refuses what it cannot draw", "[canvas]") {
    Stage stage;
    CanvasOptions options = small(1);
    options.width = 1000000;
    CHECK_THROWS_WITH(stage.canvas(options), Catch::Contains("1000000 x 200"));
    CHECK_THROWS_WITH(stage.canvas(small(3)), Catch::Contains("samples must be 1 or 4"));
    Camera blind = AHEAD;
    blind.target = blind.eye;
    CHECK_THROWS_AS(stage.picture(small(1), blind), std::invalid_argument);
    ColorScale flat;
    flat.low = flat.high = 1;
    CHECK_THROWS_AS(stage.picture(small(1), AHEAD, flat), std::invalid_argument);
    CHECK_THROWS_AS(make_vulkan_canvas(validated_device(), {}, small(1))->set_tables({}), std::invalid_argument);
    Buffer table(validated_device(), "a table", 1024);
    CanvasOptions marks = small(1);
    marks.marks = true;
    CHECK_THROWS_WITH(make_vulkan_canvas(validated_device(), {}, marks)->set_tables({&table, &table, &table}),
                      Catch::Contains("touches"));
}
