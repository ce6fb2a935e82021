// Picture styles: the user's over the scene's, words, and ranges of colours by percentiles.
#include "demos/film/style.h"

#include <catch2/catch.hpp>
#include <vector>

#include "demos/film/color_range.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"

using namespace scree;
using namespace scree::demos;

namespace {

// A wall of boxes at rest, and what else is given.
LoadedScene wall_with(const std::vector<Body>& more) {
    LoadedScene subject;
    subject.scene.bodies.push_back(ground());
    for (int i = 0; i < 200; ++i)
        subject.scene.bodies.push_back(
            box_at({static_cast<float>(i % 20), 0.5f + static_cast<float>(i / 20), 0}, vec3(0.499f, 0.5f, 0.5f)));
    subject.scene.bodies.insert(subject.scene.bodies.end(), more.begin(), more.end());
    subject.low = vec3(-1, 0, -1);
    subject.high = vec3(21, 10, 1);
    return subject;
}

Body shot(float speed, float density) {
    Body ball;
    ball.shape = Sphere{0.5f};
    ball.density = density;
    ball.position = {10, 5, 200};  // it does not arrive while the range is measured
    ball.velocity = {0, 0, speed};
    return ball;
}

}  // namespace

TEST_CASE("range: a projectile does not darken the rest", "[demos]") {
    for (const char* quantity : {"momentum", "speed", "kinetic-energy"}) {
        INFO(quantity);
        const float rest = color_range(wall_with({}), {}, quantity).second;
        const float shot_at = color_range(wall_with({shot(100, 20000)}), {}, quantity).second;
        CHECK(shot_at <= 1.6f * rest);
        CHECK(shot_at >= rest);
    }
}

TEST_CASE("range: what all bodies do is inside", "[demos]") {
    LoadedScene subject = wall_with({});
    for (Body& body : subject.scene.bodies)
        if (body.motion == Motion::dynamic) body.velocity = {0, 0, 7};
    const auto [low, high] = color_range(subject, {}, "speed");
    CHECK(low == 0);
    CHECK(high >= 7);
    CHECK(high <= 20);  // the uppermost fall 9.5 m meanwhile: 15.3 m/s
    CHECK(color_range(subject, {}, "contacts").second == 12);
    CHECK(color_range(subject, {}, "height") == std::pair(0.0f, 10.0f));
}

TEST_CASE("range: nearly the greatest leaves out a twentieth, and one of six", "[demos]") {
    CHECK(nearly_greatest({}) == 0);
    CHECK(nearly_greatest({3}) == 3);
    CHECK(nearly_greatest({1, 2, 100}) == 100);
    CHECK(nearly_greatest({1, 2, 3, 4, 5, 100}) == 5);
    std::vector<double> many(100, 1.0);
    for (std::size_t i = 0; i < 5; ++i) many[i] = 50;
    CHECK(nearly_greatest(many) == 1);
    many[5] = 50;
    CHECK(nearly_greatest(many) == 50);
}

TEST_CASE("range: in a window it follows late and in large steps", "[demos]") {
    MeasuredRange range(10);
    for (int i = 0; i < 100; ++i) CHECK_FALSE(range.update(i % 2 == 0 ? 12 : 3, 0.5));  // neither far above nor far below
    CHECK(range.update(100, 0.5));
    CHECK(range.high() == 150);
    CHECK_FALSE(range.update(2, 0.5));  // for a moment
    CHECK_FALSE(range.update(60, 0.5));
    bool changed = false;
    for (int i = 0; i < 9; ++i) changed = range.update(2, 0.5) || changed;  // for four seconds
    CHECK(changed);
    CHECK(range.high() == 4);
}

TEST_CASE("style: what the user says goes before the scene's, and another quantity has its own scale and range", "[demos]") {
    const PictureStyle scene{ShownQuantity::speed, ShownMap::viridis, ShownScale::linear, {1, 5}, {Overlay::joints}};
    CHECK(style_of({}, scene) == scene);
    PictureOptions options;
    options.color = "momentum";
    options.show = std::vector<std::string>{"none"};
    const PictureStyle chosen = style_of(options, scene);
    CHECK(chosen.color == ShownQuantity::momentum);
    CHECK(chosen.map == ShownMap::viridis);
    CHECK(chosen.scale == ShownScale::automatic);
    CHECK(chosen.range == glm::vec2(0));
    CHECK(chosen.show.empty());
    options.color = "speed";
    options.color_range = {0, 3};
    CHECK(style_of(options, scene).scale == ShownScale::linear);
    CHECK(style_of(options, scene).range == glm::vec2(0, 3));
}

TEST_CASE("style: the canvas knows every word of scene files, and these every quantity and map of the canvas", "[demos]") {
    for (const std::string& word : color_words()) CHECK(host::color_by_named(word));
    for (const std::string& word : color_map_words()) CHECK(host::color_map_named(word));
    CHECK(color_words().size() == host::color_by_names().size());
    CHECK(color_map_words().size() == host::color_map_names().size());
}

TEST_CASE("style: momentum is shown by roots, and the legend's scale begins at 0", "[demos]") {
    const LoadedScene subject = wall_with({});
    const host::ColorScale scale = scale_of({}, subject, {});
    CHECK(scale.root);
    CHECK(scale.low == 0);
    CHECK(host::scale_place(scale, scale.high / 4) == Approx(0.5));
    PictureStyle speed;
    speed.color = ShownQuantity::speed;
    CHECK_FALSE(scale_of(speed, subject, {}).root);
}

TEST_CASE("looks: every demo of the gallery has one of its own", "[demos]") {
    for (const Demo& demo : all_demos()) {
        if (demo.trial) continue;
        INFO(demo.name);
        const DemoScene made = build(demo, {});
        CHECK((made.picture.color != ShownQuantity::momentum || made.picture.range.y > 0 || !made.picture.show.empty()));
    }
}
