// Labels of pictures, which a canvas draws, against rays through the same pixels: every shape, skins and what is only drawn, from
// many cameras. Rays see the shapes that collide; so they are cast in a twin of the scene in which what is drawn collides.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "demos/film/channels.h"
#include "demos/film/drawn_labels.h"
#include "demos/film/silhouettes.h"
#include "host/device_error.h"
#include "host/system/machine.h"
#include "tests/demos/shapes_in_the_air.h"
#include "tests/world/solid_meshes.h"

using namespace scree;
using tests::cameras;
using tests::shapes;

namespace {

constexpr int width = 160, height = 120;

struct Unlike {
    double ids = 0;                // fraction of pixels
    double parts = 0, values = 0;  // fractions of those with one body: other parts; depth or normals apart
    std::size_t edges = 0;         // pixels at outlines
    std::size_t inner = 0;         // pixels with another body though all neighbours show one body
};

bool is_inner(const demos::Channels& of, int x, int y) {
    const auto at = [&](int column, int row) { return of.body[static_cast<std::size_t>(row * of.width + column)]; };
    if (x == 0 || y == 0 || x == of.width - 1 || y == of.height - 1) return false;
    for (int row = y - 1; row <= y + 1; ++row)
        for (int column = x - 1; column <= x + 1; ++column)
            if (at(column, row) != at(x, y)) return false;
    return true;
}

// `exact`: m, to which rays tell depths; they begin far before the eye of a parallel view.
Unlike compared(const demos::Channels& drawn, const demos::Channels& cast, float exact = 0) {
    Unlike found;
    REQUIRE(drawn.body.size() == cast.body.size());
    std::size_t alike = 0;
    for (std::size_t i = 0; i < cast.body.size(); ++i) {
        const int x = static_cast<int>(i) % cast.width, y = static_cast<int>(i) / cast.width;
        found.edges += x > 0 && cast.body[i] != cast.body[i - 1] ? 1 : 0;
        if (drawn.body[i] != cast.body[i]) {
            ++found.ids;
            found.inner += is_inner(cast, x, y) && is_inner(drawn, x, y) ? 1 : 0;
            continue;
        }
        if (cast.body[i] < 0) {
            CHECK((std::isinf(drawn.depth[i]) && drawn.normal[3 * i] == 0));
            continue;
        }
        ++alike;
        if (!cast.part.empty() && drawn.part[i] != cast.part[i]) ++found.parts;
        const vec3 one(drawn.normal[3 * i], drawn.normal[3 * i + 1], drawn.normal[3 * i + 2]);
        const vec3 other(cast.normal[3 * i], cast.normal[3 * i + 1], cast.normal[3 * i + 2]);
        if (!(std::abs(drawn.depth[i] - cast.depth[i]) <= 2e-5f * cast.depth[i] + exact && glm::length(one - other) < 2e-3f))
            ++found.values;
    }
    found.ids /= static_cast<double>(cast.body.size());
    found.values /= static_cast<double>(std::max<std::size_t>(alike, 1));
    found.parts /= static_cast<double>(std::max<std::size_t>(alike, 1));
    return found;
}

host::CanvasOptions small() {
    host::CanvasOptions options;
    options.width = width;
    options.height = height;
    return options;
}

}  // namespace

TEST_CASE("labels: every shape is drawn as rays see it, but for pixels on edges") {
    World world(shapes(false), {}, 1);
    const World twin(shapes(true), {}, 1);
    demos::Drawing drawing("gl", {}, world, small());
    demos::DrawnLabels labels(world, drawing, false);
    const demos::ChannelChoice choice{.depth = true, .body = true, .part = true, .normal = true};
    for (const host::Camera& camera : cameras()) {
        INFO("camera at " << camera.eye.x << " " << camera.eye.y << " " << camera.eye.z);
        const demos::Before before{camera, 0};
        const demos::Channels drawn = labels.channels(camera, width, height, choice, before);
        const Unlike found =
            compared(drawn, demos::channels_of(twin, camera, width, height, choice, before), camera.orthographic ? 1e-3f : 0.0f);
        INFO(found.ids << " " << found.values << " " << found.parts);
        CHECK(found.ids < 0.001);
        CHECK(found.values < 0.001);
        CHECK(found.parts < 0.001);
        CHECK(found.inner == 0);
    }
}

TEST_CASE("labels: outlines of round bodies are exact from so near that a polygon of 32 sides would miss them by a pixel") {
    for (const int kind : {0, 1, 2, 4, 5}) {
        Scene scene;
        scene.bodies.push_back({.name = "round", .shape = tests::shape_of(kind)});
        scene.bodies[0].orientation = glm::normalize(vec4(0.6f, 0.2f, 0.3f, 1));
        World world(scene, {}, 1);
        const vec3 eye(0, 0, 8);
        float met = 0, missed = 0.5f;  // m to the right, at the body's distance
        while (missed - met > 1e-5f) {
            const float middle = 0.5f * (met + missed);
            (world.cast_ray({eye, glm::normalize(vec3(middle, 0, 0) - eye)}) ? met : missed) = middle;
        }
        const host::Camera camera{.eye = eye, .target = {met, 0, 0}, .vertical_fov = 0.6f};  // 1,400 pixels a m
        const demos::ChannelChoice choice{.depth = true, .body = true, .normal = true};
        const demos::Before before{camera, 0};
        demos::Drawing drawing("gl", {}, world, small());
        demos::DrawnLabels labels(world, drawing, false);
        const Unlike found = compared(labels.channels(camera, width, height, choice, before),
                                      demos::channels_of(world, camera, width, height, choice, before));
        INFO(kind << ": " << found.edges << " " << found.ids << " " << found.values);
        CHECK(found.edges > height / 2);
        CHECK(found.ids < 0.001);
        CHECK(found.values < 0.02);  // grazing rays
        CHECK(found.inner == 0);
    }
}

TEST_CASE("labels: of a mesh that moves the mesh is told, and its convex parts where they are shown", "[mesh]") {
    host::set_environment("SCREE_CACHE", "off");
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < 2; ++i) {
        Body cup{.name = "cup", .shape = tests::cup_mesh(0.4f, 1, 0.05f, 0.06f, 16)};
        cup.position = {1.2f * static_cast<float>(i), 1, 0};
        cup.orientation = glm::normalize(vec4(0.3f, 0.1f, 0.5f * static_cast<float>(i), 1));
        scene.bodies.push_back(cup);
    }
    World world(scene, {}, 1);
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].motion = Motion::fixed;
    const World twin(scene, {}, 1);
    const host::Camera camera{.eye = {1, 2.5f, 2}, .target = {0.6f, 1.3f, 0}, .vertical_fov = 55};
    const demos::ChannelChoice choice{.depth = true, .body = true, .part = true, .normal = true};
    const demos::Before before{camera, 0};
    demos::Drawing drawing("gl", {}, world, small());
    demos::DrawnLabels labels(world, drawing, false);
    demos::Channels drawn = labels.channels(camera, width, height, choice, before);
    const demos::Channels parts = demos::channels_of(world, camera, width, height, choice, before);
    CHECK(drawn.part == parts.part);  // triangles of the skin are no parts
    drawn.part.clear();
    demos::Channels cast = demos::channels_of(twin, camera, width, height, choice, before);
    cast.part.clear();
    const Unlike found = compared(drawn, cast);
    INFO(found.ids << " " << found.values);
    CHECK((found.ids < 0.001 && found.values < 0.001 && found.inner == 0));
    CHECK(compared(parts, cast).values > 0.01);  // the judge tells them apart
    host::CanvasOptions shown = small();
    shown.parts = true;
    demos::Drawing of_parts("gl", {}, world, shown);
    demos::DrawnLabels labels_of_parts(world, of_parts, true);
    const Unlike other = compared(labels_of_parts.channels(camera, width, height, choice, before), parts);
    INFO(other.ids << " " << other.values << " " << other.parts);
    CHECK((other.ids < 0.001 && other.values < 0.001 && other.parts < 0.001 && other.inner == 0));
}

TEST_CASE("labels: silhouettes are those of rays that go through all bodies, also beyond the edges") {
    World world(shapes(false), {}, 1);
    const World twin(shapes(true), {}, 1);
    demos::Drawing drawing("gl", {}, world, small());
    demos::DrawnLabels labels(world, drawing, false);
    constexpr int wide = 80, high = 60;
    for (const std::size_t chosen : {0u, 1u, 4u}) {
        const host::Camera camera = cameras()[chosen];
        const demos::Silhouettes drawn = demos::silhouettes_of(labels, camera, wide, high);
        const host::PixelRays rays = host::pixel_rays(camera, wide, high);
        std::vector<RayQuery> queries;
        for (int y = -high; y < 2 * high; ++y)
            for (int x = -wide; x < 2 * wide; ++x)
                queries.push_back(demos::ray_through(rays, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const QueryLists<QueryHit> hits = twin.cast_rays_through(queries);
        struct Count {
            std::size_t all = 0, whole = 0, seen = 0;
        };
        std::vector<Count> counts(world.bodies().size());
        std::vector<demos::PixelBox> boxes(counts.size());
        for (int i = 0; i < 9 * wide * high; ++i) {
            const glm::ivec2 pixel(i % (3 * wide) - wide, i / (3 * wide) - high);
            const bool in = pixel.x >= 0 && pixel.x < wide && pixel.y >= 0 && pixel.y < high;
            std::vector<std::size_t> met;
            for (const QueryHit& hit : hits[static_cast<std::size_t>(i)])
                if (std::find(met.begin(), met.end(), hit.body) == met.end()) met.push_back(hit.body);
            for (const std::size_t body : met) {
                ++counts[body].all;
                boxes[body].add(pixel);
                counts[body].whole += in ? 1 : 0;
                counts[body].seen += in && body == met.front() ? 1 : 0;
            }
        }
        std::size_t apart = 0, all = 0, listed = 0;
        const auto differ = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
        for (const demos::Silhouette& one : drawn.bodies) {
            const Count& count = counts[one.body];
            CHECK(world.scene().bodies[one.body].motion == Motion::dynamic);
            CHECK(demos::count_of(one.seen) <= demos::count_of(one.whole));
            apart += differ(one.pixels, count.all) + differ(demos::count_of(one.whole), count.whole) +
                     differ(demos::count_of(one.seen), count.seen);
            all += count.all;
            listed += count.whole > 0 ? 1 : 0;
            if (count.whole > 0) CHECK(glm::all(glm::lessThan(glm::abs(one.box.least - boxes[one.body].least), glm::ivec2(2))));
        }
        INFO("camera " << chosen << ": " << apart << " of " << all << " pixels");
        CHECK(all > 500);
        CHECK(static_cast<double>(apart) < 0.002 * static_cast<double>(all));
        for (std::size_t body = 3; body < counts.size(); ++body) listed -= counts[body].whole > 0 ? 1 : 0;
        CHECK(listed == 0);
    }
}

TEST_CASE("labels: what covers pixels is listed in bands of rows if it does not fit at once, each row in one band") {
    host::CoverBands bands(100);
    constexpr std::uint32_t of_a_row = 200000;
    int next = 0, tries = 0;
    while (!bands.done()) {
        REQUIRE(++tries < 60);
        CHECK(bands.first() == next);
        CHECK(bands.end() <= 100);
        const std::uint32_t count = static_cast<std::uint32_t>(bands.end() - bands.first()) * of_a_row;
        const int end = bands.end();
        const bool fits = count <= bands.room();
        CHECK(bands.take(count) == fits);
        if (fits) next = end;
    }
    CHECK(next == 100);
    CHECK(std::size_t{bands.room()} * sizeof(host::Cover) < std::size_t{128} << 20);  // what lavapipe binds
    host::CoverBands one(1);
    CHECK_FALSE(one.take(20000000));
    CHECK(one.take(20000000));
    CHECK(one.done());
}
