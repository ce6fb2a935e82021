// Framing: fitted cameras see a scene whole above legend and caption, and are not led away by bodies far off.
#include "demos/film/camera.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "demos/scenes/scene_builder.h"

using namespace scree;
using namespace scree::demos;

namespace {

// A point in the picture: from -1 to 1, upward and to the right.
struct Seen {
    float right, up;
};

Seen seen_by(const host::Camera& camera, vec3 point, float aspect) {
    const vec3 back = glm::normalize(camera.eye - camera.target);
    const vec3 right = glm::normalize(glm::cross(camera.up, back)), up = glm::cross(back, right);
    const vec3 p = point - camera.eye;
    const float depth = camera.orthographic ? glm::length(camera.eye - camera.target) : -glm::dot(p, back);
    const float rise = depth * std::tan(glm::radians(camera.vertical_fov) / 2);
    return {glm::dot(p, right) / (rise * aspect), glm::dot(p, up) / rise};
}

SceneDocument wall(vec3 size, std::size_t count) {
    SceneDocument document;
    document.scene.bodies.push_back(ground());
    for (std::size_t i = 0; i < count; ++i) {
        const auto column = static_cast<float>(i % 6), row = static_cast<float>(i / 6);
        document.scene.bodies.push_back(box_at({size.x * column, size.y * (row + 0.5f), 0}, 0.49f * size));
    }
    return document;
}

}  // namespace

TEST_CASE("camera: a scene without a camera is seen whole, above the strip of legend and caption", "[demos]") {
    for (const bool orthographic : {false, true}) {
        for (const float aspect : {0.5f, 1.0f, 16.0f / 9, 4.0f}) {
            for (const float strip : {0.0f, 0.17f, 0.4f}) {
                for (const vec3 size : {vec3(0.3f, 0.2f, 0.2f), vec3(0.1f, 3, 0.1f), vec3(20, 1, 30)}) {
                    CAPTURE(orthographic, aspect, strip, size.x);
                    const LoadedScene subject = subject_of(wall(size, 30), "wall");
                    CameraOptions options;
                    options.orthographic = orthographic;
                    const host::Camera camera = CameraMan(options, subject, aspect, strip).at(0);
                    float most = 0, lowest = 1, highest = -1;
                    for (const vec3& corner : corners_of(subject.low, subject.high)) {
                        const Seen seen = seen_by(camera, corner, aspect);
                        most = std::max(most, std::abs(seen.right));
                        lowest = std::min(lowest, seen.up);
                        highest = std::max(highest, seen.up);
                    }
                    CHECK(most < 1);
                    CHECK(highest < 1);
                    CHECK(lowest > -1 + 2 * strip);
                    // As near as that allows.
                    CHECK(std::max(most, (highest - lowest) / (2 - 2 * strip)) > 0.85f);
                }
            }
        }
    }
}

TEST_CASE("camera: a body far away does not make the scene small, a near one stays in the picture", "[demos]") {
    const float aspect = 16.0f / 9;
    const auto width_with = [&](std::size_t count, const std::vector<vec3>& balls) {
        SceneDocument document = wall({0.3f, 0.2f, 0.2f}, count);
        for (const vec3& place : balls) {
            Body ball;
            ball.shape = Sphere{0.1f};
            ball.position = place;
            document.scene.bodies.push_back(ball);
        }
        const LoadedScene subject = subject_of(document, "wall");
        const host::Camera camera = CameraMan({}, subject, aspect).at(0);
        return seen_by(camera, {1.5f, 0.5f, 0}, aspect).right - seen_by(camera, {0, 0.5f, 0}, aspect).right;
    };
    const float alone = width_with(30, {});
    CHECK(width_with(30, {vec3(500, 1, 0), vec3(0, 9000, 0)}) == alone);
    CHECK(width_with(30, {vec3(0.7f, 0.5f, 5)}) < 0.8f * alone);  // a ball that will strike the wall
    CHECK(width_with(3, {vec3(500, 1, 0)}) < 0.1f * alone);       // too few to tell which is far
}
