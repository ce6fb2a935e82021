// Rays against single shapes: equal to a judge in double precision, near and far, with normals.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/world.h"
#include "shaders/physics/collide/ray.h"
#include "tests/oracle/ray_cast.h"
#include "tests/oracle/surface_normal.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

// Shapes as a scene checks them, thin and thick.
std::vector<Body> bodies_of_every_kind() {
    HeightField hill;
    hill.columns = hill.rows = 5;
    hill.spacing = 0.6f;
    for (int i = 0; i < 25; ++i) hill.heights.push_back(0.1f * static_cast<float>(i * 7 % 5));
    const std::vector<Shape> shapes{Sphere{0.5f},
                                    Capsule{0.2f, 0.6f},
                                    Box{vec3(0.5f, 0.1f, 0.8f)},
                                    Cylinder{0.4f, 0.3f},
                                    Cylinder{0.5f, 0.01f},
                                    Cone{0.5f, 0.9f},
                                    Cone{0.6f, 0.05f},
                                    Cone{0.05f, 1.2f},
                                    Ellipsoid{vec3(0.7f, 0.2f, 0.4f)},
                                    tests::wedge(),
                                    tests::hammer(),
                                    Plane{vec3(0, 1, 0), -0.2f},
                                    hill,
                                    Box{vec3(0.01f, 0.7f, 0.01f)},
                                    Sphere{0.005f}};
    Scene scene;
    for (const Shape& shape : shapes) {
        Body body;
        body.shape = shape;
        if (std::holds_alternative<Plane>(shape) || std::holds_alternative<HeightField>(shape)) body.motion = Motion::fixed;
        scene.bodies.push_back(body);
    }
    return World(scene, {}, 1).scene().bodies;
}

vec3 unit_vector(tests::Noise& noise) {
    for (;;) {
        const vec3 v = noise.vector();
        if (glm::length(v) > 0.1f) return glm::normalize(v);
    }
}
vec4 any_turn(tests::Noise& noise) {
    const vec4 q{noise(), noise(), noise(), noise() + 1.1f};
    return vec4(glm::normalize(glm::dvec4(q)));
}

}  // namespace

TEST_CASE("rays meet every shape where a judge in double precision says, also from a kilometre away", "[physics]") {
    for (const float away : {2.0f, 30.0f, 1000.0f}) {
        tests::Noise noise(4);
        const float within = 2e-6f * (1 + away);  // single precision resolves 1e-7 of coordinates
        for (const Body& body : bodies_of_every_kind()) {
            const bool plane = std::holds_alternative<Plane>(body.shape);
            int hits = 0, doubtful = 0;
            for (int i = 0; i < 4000; ++i) {
                const vec3 position = plane ? vec3(0) : noise.vector() * 3.0f;
                const vec4 turn = plane ? vec4(0, 0, 0, 1) : any_turn(noise);
                const vec3 target = position + noise.vector() * (i % 2 ? 0.8f : 0.1f), along = unit_vector(noise);
                const Ray ray{target - along * away, along};
                const auto at = ray_distance(body.shape, position, turn, ray.from, ray.along);
                const auto judged = oracle::ray_distance(body.shape, position, turn, ray.from, ray.along);
                INFO("shape " << body.shape.index() << " from " << away << " m, ray " << i << ": " << at.value_or(-1)
                              << " m, not " << judged.value_or(-1));
                if (at && judged && std::abs(*at - *judged) <= within) {
                    ++hits;
                    const vec3 point = ray.from + ray.along * *judged;
                    if (away > 2 || !simple_shape(body.shape)) continue;
                    REQUIRE(glm::dot(oracle::surface_normal(body.shape, position, turn, ray, point), along) < 1e-3f);
                    continue;
                }
                if (!at && !judged) continue;
                // Else it grazes the shape: the judge decides otherwise for a ray that is beside it by as much.
                bool grazes = false;
                for (int k = 0; k < 60 && !grazes; ++k) {
                    const vec3 beside = ray.from + unit_vector(noise) * (2 * within);
                    const auto other = oracle::ray_distance(body.shape, position, turn, beside, ray.along);
                    grazes = other.has_value() != judged.has_value() ||
                             (other && judged && std::abs(*other - *judged) > 0.3f * std::abs(at.value_or(0) - *judged));
                }
                REQUIRE(grazes);
                ++doubtful;
            }
            INFO("shape " << body.shape.index() << " from " << away << " m");
            const auto* ball = std::get_if<Sphere>(&body.shape);
            CHECK(hits > (ball && ball->radius < 0.1f ? 0 : 100));
            CHECK(doubtful * 20 <= hits);
        }
    }
}

TEST_CASE("the normal of a ray's hit is the judge's", "[physics]") {
    tests::Noise noise(6);
    for (const Body& body : bodies_of_every_kind()) {
        if (std::holds_alternative<Plane>(body.shape)) continue;
        Scene scene;
        Body fixed = body;
        fixed.motion = Motion::fixed;
        fixed.position = vec3(0.3f, -0.2f, 0.5f);
        fixed.orientation = any_turn(noise);
        scene.bodies.push_back(fixed);
        World world(scene, {}, 1);
        const Body& made = world.scene().bodies[0];
        int hits = 0, otherwise = 0;
        for (int i = 0; i < 2000; ++i) {
            const vec3 along = unit_vector(noise);
            const RayQuery query{.from = made.position + noise.vector() * 0.4f - along * 3.0f, .along = along, .reach = 10};
            const auto hit = world.cast_rays({&query, 1})[0];
            if (!hit) continue;
            ++hits;
            const vec3 judged =
                oracle::surface_normal(made.shape, made.position, made.orientation, {query.from, along}, hit->point);
            REQUIRE(std::abs(glm::length(hit->normal) - 1) < 1e-5f);
            REQUIRE(glm::dot(hit->normal, along) < 1e-3f);
            otherwise += glm::length(hit->normal - judged) > 2e-3f;  // on edges either face may be told
        }
        INFO("shape " << body.shape.index() << ": " << otherwise << " of " << hits);
        CHECK(otherwise * 200 <= hits);
    }
}

TEST_CASE("a ray's entry into a box never precedes that into a box around it", "[physics]") {
    tests::Noise noise(7);
    int met = 0;
    for (int i = 0; i < 200000; ++i) {
        const vec3 middle = noise.vector() * 3.0f, half = glm::abs(noise.vector()), more = glm::abs(noise.vector()) * 1e-5f;
        const vec3 from = noise.vector() * 5.0f;
        vec3 along = glm::normalize(middle + noise.vector() * 0.7f - from);
        if (i % 5 == 0) along = {0, i % 2 ? 1 : -1, 0};
        const vec3 inverse = physics::ray_inverse3(along);
        const float reach = 8 + 4 * noise();
        const float inner = physics::entry_into_box(middle - half, middle + half, from, inverse, reach);
        const float outer = physics::entry_into_box(middle - half - more, middle + half, from, inverse, reach);
        REQUIRE(outer <= inner);
        met += inner <= reach;
    }
    CHECK(met > 20000);
}
