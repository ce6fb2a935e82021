// Drawing of joints: positions of anchors, colour of the force, no broken joints.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/host/vulkan/canvas_stage.h"

using namespace scree::host;
using glm::vec3;
namespace physics = scree::physics;

namespace {

constexpr std::uint32_t world = physics::NONE;
// At z = 0 a metre is 100 / (10 tan 20) = 27.5 pixels.
constexpr int metre = 27;

// Two small spheres, 2 m above the ground, with a hinge midway whose axis is vertical.
physics::Joint& add_pair(Stage& stage) {
    stage.add(physics::SHAPE_SPHERE, vec3(0.2f), {-2, 2, 0});
    stage.add(physics::SHAPE_SPHERE, vec3(0.2f), {2, 2, 0});
    physics::Joint& joint = stage.add_hinge(0, {2, 0, 0}, 1, {-2, 0, 0});
    const float h = std::sqrt(0.5f);
    joint.frame_a = joint.frame_b = {0, 0, h, h};  // maps x to y
    return joint;
}

CanvasOptions with_joints(int samples) {
    CanvasOptions options = small(samples);
    options.joints = true;
    return options;
}

bool blue(const Pixel& seen) {
    return seen.b > 200 && seen.r < 90;
}
bool red(const Pixel& seen) {
    return seen.r > 200 && seen.b < 90 && seen.g < 90;
}

}  // namespace

TEST_CASE("a joint is drawn from its bodies to its anchor, with a dot there and its axis", "[canvas]") {
    const int samples = GENERATE(1, 4);
    CAPTURE(samples);
    Stage stage;
    add_pair(stage);
    const Image without = stage.picture(small(samples), AHEAD), with = stage.picture(with_joints(samples), AHEAD);
    const auto drawn = [&](int x, int y) { return differ(at(with, x, y), at(without, x, y)); };
    CHECK(blue(at(with, 160, 100)));
    for (const int side : {-1, 1}) {
        CHECK(blue(at(with, 160 + side * metre, 100)));
        CHECK(blue(at(with, 160 + side * (2 * metre - 2), 100)));  // in front of the body
        CHECK_FALSE(drawn(160 + side * (2 * metre + 9), 100));
        CHECK_FALSE(drawn(160 + side * metre, 106));
        const Pixel axis = at(with, 160, 100 + side * 5);
        CHECK(std::min(axis.r, std::min(axis.g, axis.b)) > 200);
        CHECK_FALSE(drawn(160 + side * 6, 100 + 6));
    }
    require_no_messages();
}

TEST_CASE("a joint's colour tells the force on the lighter body", "[canvas]") {
    Stage stage;
    add_pair(stage).force = {0, 200 * 9.81f, 0};  // 200 times the weight of 1 kg
    CHECK(red(at(stage.picture(with_joints(1), AHEAD), 160, 100)));
    CanvasOptions heavier = with_joints(1);
    heavier.joint_pull *= 1e5f;
    CHECK(blue(at(stage.picture(heavier, AHEAD), 160, 100)));
}

TEST_CASE("torn joints are not drawn, nor those of bodies that are not there, nor records without a joint", "[canvas]") {
    Stage plain;
    plain.add(physics::SHAPE_SPHERE, vec3(0.2f), {-2, 2, 0});
    plain.add(physics::SHAPE_SPHERE, vec3(0.2f), {2, 2, 0});
    Stage torn, gone, empty;
    add_pair(torn).broken = 1;
    add_pair(empty).b = 0;
    add_pair(gone);
    gone.properties(1).motion = plain.properties(1).motion = physics::MOTION_BROKEN;
    CHECK(gone.picture(with_joints(1), AHEAD).rgba == plain.picture(small(1), AHEAD).rgba);
    plain.properties(1).motion = physics::MOTION_DYNAMIC;
    CHECK(torn.picture(with_joints(1), AHEAD).rgba == plain.picture(small(1), AHEAD).rgba);
    CHECK(empty.picture(with_joints(1), AHEAD).rgba == plain.picture(small(1), AHEAD).rgba);
    require_no_messages();
}

TEST_CASE("of the world's side of a joint only the anchor is drawn, and ball joints have no axis", "[canvas]") {
    Stage stage;
    stage.add(physics::SHAPE_SPHERE, vec3(0.2f), {-1, 2, 0});
    physics::Joint& ball = stage.add_hinge(world, {1, 2, 0}, 0, {2, 0, 0});
    for (std::size_t k = 3; k < 6; ++k) ball.axes[k].mode = 0;
    const Image without = stage.picture(small(1), AHEAD), with = stage.picture(with_joints(1), AHEAD);
    const auto drawn = [&](int x, int y) { return differ(at(with, x, y), at(without, x, y)); };
    CHECK(blue(at(with, 160 + metre, 100)));
    CHECK(blue(at(with, 160, 100)));
    CHECK_FALSE(drawn(160, 100 + metre));  // no line to the world's origin
    CHECK_FALSE(drawn(160 + metre, 100 + 7));
    CHECK_FALSE(drawn(160 + metre + 7, 100));
    require_no_messages();
}

TEST_CASE("what of a joint lies behind a body is drawn faintly", "[canvas]") {
    Stage plain, stage;
    for (Stage* each : {&plain, &stage}) each->add(physics::SHAPE_BOX, {1, 1, 0.1f}, {0, 2, 4}, vec3(0), 0);
    stage.add(physics::SHAPE_SPHERE, vec3(0.2f), {-3, 2, 0});
    stage.add_hinge(world, {3, 2, 0}, 1, {6, 0, 0});
    const Image without = plain.picture(small(1), AHEAD), with = stage.picture(with_joints(1), AHEAD);
    CHECK(differ(at(with, 160, 100), at(without, 160, 100)));
    CHECK_FALSE(blue(at(with, 160, 100)));
    CHECK(blue(at(with, 160 + 2 * metre, 100)));
}
