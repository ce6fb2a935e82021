// The two canvases against each other: equal pictures of the same state.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <span>

#include "compute/device/record_groups.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/film/drawing.h"
#include "host/canvas/canvas.h"
#include "host/vulkan/buffer.h"
#include "host/vulkan/device.h"
#include "shaders/physics/base/record_groups.h"

using namespace scree;
using namespace scree::host;

namespace {

std::shared_ptr<Device> validated_device() {
    static const std::shared_ptr<Device> device = Device::open({.which = "", .validation = true, .on_message = {}});
    return device;
}

Hull wedge() {
    return {.points = {
                {-0.3f, -0.2f, -0.25f}, {0.3f, -0.2f, -0.2f}, {0.25f, -0.2f, 0.3f}, {-0.25f, -0.15f, 0.25f}, {0, 0.3f, 0.05f}}};
}

Compound hammer() {
    Compound compound;
    compound.parts.push_back({.shape = Capsule{0.08f, 0.2f}});
    compound.parts.push_back({.shape = Box{{0.2f, 0.1f, 0.12f}}, .position = {0, 0.2f, 0}});
    compound.parts.push_back({.shape = Cone{0.12f, 0.2f}, .position = {0, -0.3f, 0}});
    return compound;
}

HeightField hills() {
    HeightField field{.columns = 15, .rows = 12, .spacing = 0.3f};
    for (int k = 0; k < 15 * 12; ++k)
        field.heights.push_back(0.2f + 0.15f * std::sin(0.9f * static_cast<float>(k % 15)) *
                                           std::cos(0.7f * static_cast<float>(k / 15)));
    return field;
}

// Every shape, moving and fixed, in a pile that has just collapsed.
Scene heap() {
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    Body wall;
    wall.motion = Motion::fixed;
    wall.shape = Box{{2.5f, 0.6f, 0.2f}};
    wall.position = {0, 0.6f, -1.8f};
    scene.bodies.push_back(wall);
    Body ridge;
    ridge.motion = Motion::fixed;
    ridge.shape = hills();
    ridge.position = {1.5f, 0, 1.5f};
    scene.bodies.push_back(ridge);
    for (int i = 0; i < 60; ++i) {  // enough of each size to be in the grid, whose cells are drawn
        Body body;
        const Shape shapes[] = {
            Sphere{0.28f}, Capsule{0.2f, 0.25f}, Box{{0.3f, 0.2f, 0.25f}}, Cylinder{0.25f, 0.2f}, Cone{0.28f, 0.6f}, wedge(),
            hammer()};
        body.shape = shapes[i % 7];
        body.position = {0.7f * static_cast<float>(i % 4) - 1.0f, 0.5f + 0.62f * static_cast<float>(i / 16),
                         0.7f * static_cast<float>(i / 4 % 4) - 1.0f};
        body.orientation = {0.1f * static_cast<float>(i % 5), 0.3f, 0.05f * static_cast<float>(i % 7), 1};
        body.velocity = {0.4f * static_cast<float>(i % 3), -1, 0};
        scene.bodies.push_back(body);
    }
    return scene;
}

struct View {
    Camera camera{.eye = {3.5f, 3, 5}, .target = {0, 0.7f, 0}, .vertical_fov = 40};
    ColorScale scale;
    std::string caption = "both canvases\n60 bodies";
    vec3 low{-3, 0, -3}, high{3, 3, 3};  // shadow casting volume, m
};

Image picture(Canvas& canvas, const World& world, const View& view) {
    BodyTables tables = demos::tables_of(world.state());
    const std::vector<glm::vec4> colors = demos::colors_of(world.scene());
    tables.colors = colors;
    canvas.set_tables(tables);
    return canvas.draw(view.camera, view.scale, view.caption, view.low, view.high);
}

// The largest channel difference between pixel i of `a` and pixel j of `b`.
int difference(const Image& a, const Image& b, std::size_t i, std::size_t j) {
    int most = 0;
    for (std::size_t k = 0; k < 4; ++k) most = std::max(most, std::abs(a.rgba[4 * i + k] - b.rgba[4 * j + k]));
    return most;
}

// Whether a pixel of `a` occurs in `b` at its position or, for shifted edges, at a neighbouring one.
bool found(const Image& a, const Image& b, int x, int y) {
    const auto at = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(column);
    };
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, a.height - 1); ++row) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, a.width - 1); ++column) {
            if (difference(a, b, at(x, y), at(column, row)) <= 24) return true;
        }
    }
    return false;
}

struct Likeness {
    double mean = 0;            // mean channel difference, 1/255
    double strayed = 0;         // fraction of pixels that differ by more than 24/255
    std::size_t misshapen = 0;  // such pixels without a match in the neighbourhood, which no shifted edge explains
};

Likeness likeness(const Image& a, const Image& b) {
    REQUIRE(a.width == b.width);
    REQUIRE(a.rgba.size() == b.rgba.size());
    Likeness sums;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sums.mean += std::abs(a.rgba[i] - b.rgba[i]);
    sums.mean /= static_cast<double>(a.rgba.size());
    const std::size_t pixels = a.rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (difference(a, b, i, i) <= 24) continue;
        sums.strayed += 1.0 / static_cast<double>(pixels);
        const int x = static_cast<int>(i) % a.width, y = static_cast<int>(i) / a.width;
        if (!found(a, b, x, y) || !found(b, a, x, y)) ++sums.misshapen;
    }
    return sums;
}

bool alike(const Likeness& found) {
    return found.mean < 1 && found.strayed < 0.003 && found.misshapen == 0;
}

CanvasOptions options_of(int samples, bool shadows, bool marks) {
    CanvasOptions options;
    options.width = 400;
    options.height = 250;
    options.samples = samples;
    options.shadows = shadows;
    options.marks = marks;
    options.mark_push = 9.81f / 480;
    return options;
}

}  // namespace

TEST_CASE("canvases: both draw the same picture of the same state", "[canvas][gl]") {
    const int samples = GENERATE(1, 4);
    const bool shadows = GENERATE(true, false), marks = GENERATE(true, false);
    CAPTURE(samples, shadows, marks);
    World world(heap(), {}, 1);
    const CanvasOptions options = options_of(samples, shadows, marks);
    const ShapeInstances instances = demos::instances_of(world);
    const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
    for (const int steps : {0, 25}) {
        world.step(steps);
        View view;
        if (steps > 0) view.scale = {ColorBy::speed, ColorMap::viridis, 0.1f, 5, true};
        const Likeness both = likeness(picture(*vulkan, world, view), picture(*gl, world, view));
        CAPTURE(steps, both.mean, both.strayed, both.misshapen);
        CHECK(alike(both));
    }
    if (marks) CHECK(world.state().counted().contacts > 20);
    CHECK(validated_device()->validation_messages().empty());
}

TEST_CASE("canvases: both draw the same images on surfaces", "[canvas][gl]") {
    World world(heap(), {}, 1);
    world.step(12);
    ShapeInstances instances = demos::instances_of(world);
    REQUIRE(!instances.meshes.empty());
    Image checks{16, 16, {}};
    for (int i = 0; i < 256; ++i) {
        const bool bright = (i % 16 / 4 + i / 64) % 2 == 0;
        for (const int level : {230, bright ? 230 : 30, bright ? 200 : 30, 255})
            checks.rgba.push_back(static_cast<std::uint8_t>(level));
    }
    const std::vector<std::uint8_t> png = png_bytes(checks);
    instances.textures = {{surface_image("checks", {png.begin(), png.end()}), Wrap::repeat, Wrap::mirror}};
    const auto white = static_cast<float>(packed_levels(glm::vec3(1)));
    for (SolidMesh& mesh : instances.meshes)
        for (std::size_t k = 0; k < mesh.corners.size(); k += 2)
            mesh.surface.emplace_back(3 * mesh.corners[k].x, 3 * mesh.corners[k].z, 0, white);
    const CanvasOptions options = options_of(1, true, false);
    const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
    const auto plain = make_vulkan_canvas(validated_device(), demos::instances_of(world), options);
    View view;
    view.scale.by = ColorBy::own;
    const Image drawn = picture(*vulkan, world, view);
    const Likeness both = likeness(drawn, picture(*gl, world, view));
    CAPTURE(both.mean, both.strayed, both.misshapen);
    CHECK(alike(both));
    CHECK_FALSE(alike(likeness(drawn, picture(*plain, world, view))));
    view.scale.by = ColorBy::momentum;
    CHECK(picture(*vulkan, world, view).rgba == picture(*plain, world, view).rgba);
    CHECK(validated_device()->validation_messages().empty());
}

TEST_CASE("canvases: both draw alike from far above, close by, and in every colour", "[canvas][gl]") {
    World world(heap(), {}, 1);
    world.step(12);
    const CanvasOptions options = options_of(1, true, false);
    const ShapeInstances instances = demos::instances_of(world);
    const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
    const auto require_alike = [&](const View& view) {
        const Likeness both = likeness(picture(*vulkan, world, view), picture(*gl, world, view));
        CAPTURE(view.caption, both.mean, both.strayed, both.misshapen);
        CHECK(alike(both));
    };
    View view;
    for (const std::string& name : color_by_names()) {
        view.scale.by = *color_by_named(name);
        view.caption = name;
        view.scale.high = view.scale.by == ColorBy::contact_impulse ? 5.0f : 10.0f;
        view.scale.materials = {{{0.6f, 0, 1000}, "stone"}, {{0.1f, 0.5f, 2000}, "rubber"}};
        require_alike(view);
    }
    view.caption = "parallel rays";
    view.camera.orthographic = true;
    require_alike(view);
    view.caption = "";
    view.camera = {.eye = {0.1f, 200, 0}, .target = {0, 0, 0}, .vertical_fov = 5};
    require_alike(view);
    view.camera = {.eye = {0.4f, 0.9f, 1.6f}, .target = {0, 0.6f, 0}, .vertical_fov = 70};
    require_alike(view);
    view = {};
    view.caption = "bodies beyond the shadow maps";
    view.low = vec3(-0.4f, 0, -0.4f);
    view.high = vec3(0.4f, 1, 0.4f);
    require_alike(view);
}

TEST_CASE("canvases: both draw alike under every sky, each of which looks different, and with another sun", "[canvas][gl]") {
    World world(heap(), {}, 1);
    world.step(12);
    const ShapeInstances instances = demos::instances_of(world);
    View view;
    view.camera = {.eye = {4, 1.2f, 6}, .target = {0, 1.2f, 0}, .vertical_fov = 50};  // with the horizon
    std::vector<Image> seen;
    for (const Sky sky : {Sky::day, Sky::evening, Sky::overcast, Sky::studio, Sky::night, Sky::day}) {
        CanvasOptions options = options_of(1, true, false);
        options.sky = sky;
        options.toward_sun = seen.size() == 5 ? vec3(0.9f, 0.5f, 0.8f) : usual_sun(sky);
        const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
        seen.push_back(picture(*vulkan, world, view));
        const Likeness both = likeness(seen.back(), picture(*gl, world, view));
        CAPTURE(seen.size(), both.mean, both.strayed, both.misshapen);
        CHECK(alike(both));
        for (std::size_t i = 0; i + 1 < seen.size(); ++i) CHECK(likeness(seen[i], seen.back()).mean > 1);
    }
    CHECK(validated_device()->validation_messages().empty());
}

TEST_CASE("canvases: bodies that were removed are not drawn, of any shape", "[canvas][gl]") {
    World world(heap(), {}, 1);
    const CanvasOptions options = options_of(1, true, false);
    const View view;
    const Image before = picture(*make_gl_canvas(demos::instances_of(world), options), world, view);
    for (std::size_t body = 3; body < 24; ++body) world.remove_body(body);
    const ShapeInstances instances = demos::instances_of(world);
    const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
    const Image after = picture(*gl, world, view);
    CHECK(likeness(before, after).strayed > 0.02);
    CHECK(alike(likeness(picture(*vulkan, world, view), after)));
    // A scene without them looks the same.
    Scene fewer = heap();
    fewer.bodies.erase(fewer.bodies.begin() + 3, fewer.bodies.begin() + 24);
    const World other(fewer, {}, 1);
    View plain = view;
    plain.scale.by = ColorBy::plain;
    const auto alone = make_gl_canvas(demos::instances_of(other), options);
    CHECK(alike(likeness(picture(*alone, other, plain), picture(*gl, world, plain))));
}

TEST_CASE("canvases: both show velocities, bounds, cells and sleepers alike", "[canvas][gl]") {
    World world(heap(), {}, 1);
    CanvasOptions options = options_of(1, true, false);
    options.sleep_steps = 12;  // so that some count as asleep soon
    options.cell = world.state().fixed().cell;
    const ShapeInstances instances = demos::instances_of(world);
    const View view;
    const auto plain = make_vulkan_canvas(validated_device(), instances, options);
    for (bool CanvasOptions::*what :
         {&CanvasOptions::velocities, &CanvasOptions::boxes, &CanvasOptions::cells, &CanvasOptions::sleep}) {
        CanvasOptions shown = options;
        shown.*what = true;
        world.step(what == &CanvasOptions::sleep ? 200 : 10);  // arrows need motion, sleep needs rest
        const Image without = picture(*plain, world, view);
        const auto vulkan = make_vulkan_canvas(validated_device(), instances, shown), gl = make_gl_canvas(instances, shown);
        const Image with = picture(*vulkan, world, view);
        CHECK(likeness(with, without).strayed > 0.001);
        const Likeness both = likeness(with, picture(*gl, world, view));
        CAPTURE(both.mean, both.strayed, both.misshapen);
        CHECK(alike(both));
    }
    CHECK(validated_device()->validation_messages().empty());
}

TEST_CASE("canvases: both show joints alike, from host memory and from the device", "[canvas][gl]") {
    Scene scene = heap();
    const JointKind kinds[] = {Ball{}, Hinge{}, Slider{}, Fixed{}, Distance{.least = 0, .greatest = 2}, ConeTwist{}, SixDof{}};
    for (std::size_t i = 3; i + 1 < scene.bodies.size(); i += 2) {
        const std::size_t other = i % 5 == 0 ? the_world : i + 1;
        scene.joints.push_back(joint_at(scene, kinds[i / 2 % 7], i, other, scene.bodies[i].position + vec3(0.3f), {0, 0, 1}));
        scene.joints.back().broken = i > 50;
    }
    World world(scene, {}, 1);
    world.step(10);
    CanvasOptions options = options_of(GENERATE(1, 4), true, false);
    const ShapeInstances instances = demos::instances_of(world);
    const View view;
    const Image without = picture(*make_vulkan_canvas(validated_device(), instances, options), world, view);
    options.joints = true;
    const auto vulkan = make_vulkan_canvas(validated_device(), instances, options), gl = make_gl_canvas(instances, options);
    const Image with = picture(*vulkan, world, view);
    CHECK(likeness(with, without).strayed > 0.01);
    const Likeness both = likeness(with, picture(*gl, world, view));
    CAPTURE(both.mean, both.strayed, both.misshapen);
    CHECK(alike(both));
    BodyTables tables = demos::tables_of(world.state());
    Buffer joints(validated_device(), "joints", tables.joints.bytes.size());
    joints.write(tables.joints.bytes.data(), joints.bytes());
    tables.joints = &joints;
    vulkan->set_tables(tables);
    CHECK(vulkan->draw(view.camera, view.scale, view.caption, view.low, view.high).rgba == with.rgba);
    CHECK(validated_device()->validation_messages().empty());
}

TEST_CASE("canvases: bodies in another order in memory look as they did, told apart by their colours too", "[canvas][gl]") {
    World plain(heap(), {}, 1), moved(heap(), {}, 1);
    moved.reorder();
    plain.step(10);
    moved.step(10);
    REQUIRE(moved.reorderings() == 1);
    const ShapeInstances before = demos::instances_of(plain), after = demos::instances_of(moved);
    const CanvasOptions options = options_of(1, true, false);
    for (const ColorBy by : {ColorBy::body, ColorBy::momentum}) {
        View view;
        view.scale.by = by;
        CHECK(picture(*make_gl_canvas(after, options), moved, view).rgba ==
              picture(*make_gl_canvas(before, options), plain, view).rgba);
        CHECK(picture(*make_vulkan_canvas(validated_device(), after, options), moved, view).rgba ==
              picture(*make_vulkan_canvas(validated_device(), before, options), plain, view).rgba);
    }
}

TEST_CASE("canvases: the comparison sees a body moved by a few pixels, and a shadow that is not there", "[canvas][gl]") {
    World world(heap(), {}, 1);
    const ShapeInstances instances = demos::instances_of(world);
    const View view;
    const auto canvas = make_gl_canvas(instances, options_of(1, true, false));
    const Image image = picture(*canvas, world, view);
    Scene moved = heap();
    moved.bodies.back().position.x += 0.1f;  // about 5 pixels
    CHECK_FALSE(alike(likeness(image, picture(*canvas, World(moved, {}, 1), view))));
    const auto without = make_gl_canvas(instances, options_of(1, false, false));
    CHECK_FALSE(alike(likeness(image, picture(*without, world, view))));
    CHECK(alike(likeness(image, picture(*canvas, world, view))));
}

TEST_CASE("canvases: tables in host memory and on the device give the same pixels", "[canvas]") {
    World world(heap(), {}, 1);
    world.step(20);
    const ShapeInstances instances = demos::instances_of(world);
    const auto canvas = make_vulkan_canvas(validated_device(), instances, options_of(1, true, true));
    BodyTables tables = demos::tables_of(world.state());
    std::vector<std::unique_ptr<Buffer>> buffers;
    for (TableView* const table : {&tables.properties, &tables.poses, &tables.velocities, &tables.touches, &tables.pushes}) {
        buffers.push_back(std::make_unique<Buffer>(validated_device(), "a table", table->bytes.size()));
        buffers.back()->write(table->bytes.data(), table->bytes.size());
        *table = buffers.back().get();
    }
    // As a device has them.
    const std::size_t record = sizeof(physics::ContactImpulse), count = tables.pushes.buffer->bytes() / record;
    std::vector<std::byte> records(count * record), groups(bytes_in_groups(count, record));
    tables.pushes.buffer->read(records.data(), records.size());
    to_groups(records, record, groups);
    buffers.push_back(std::make_unique<Buffer>(validated_device(), "pushes in groups", groups.size()));
    buffers.back()->write(groups.data(), groups.size());
    BodyTables in_groups = tables;
    in_groups.pushes = buffers.back().get();
    in_groups.push_shift = physics::GROUP_SHIFT;
    REQUIRE(tables.touch_count > 2 * physics::RECORDS_OF_GROUP);
    const View view;
    for (const BodyTables& shown : {tables, in_groups})
        for (const ColorBy by : {ColorBy::momentum, ColorBy::contact_impulse}) {
            const ColorScale scale{.by = by, .low = 0, .high = by == ColorBy::momentum ? view.scale.high : 20.0f};
            canvas->set_tables(demos::tables_of(world.state()));
            const Image expected = canvas->draw(view.camera, scale, view.caption, view.low, view.high);
            canvas->set_tables(shown);
            CHECK(canvas->draw(view.camera, scale, view.caption, view.low, view.high).rgba == expected.rgba);
        }
    CHECK(validated_device()->validation_messages().empty());
}
