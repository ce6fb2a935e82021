// glTF's implicit shapes under transforms of every kind, judged by rays against the map of the shape itself, and by sums over
// points; its meshes with those of child nodes; its rules of pairs.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using scree::imported::Case;

namespace {

// How far a point is outside of a shape, roughly; below 0 inside, 0 on its surface.
using Outside = std::function<double(const dvec3&)>;

double out_of_capsule(const dvec3& p, double height, double bottom, double top) {
    double low = 0, high = 1;
    const auto at = [&](double s) { return glm::length(p - dvec3(0, height * (s - 0.5), 0)) - (bottom + (top - bottom) * s); };
    for (int i = 0; i < 40; ++i) {  // convex in s
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return at(0.5 * (low + high));
}

struct Implicit {
    std::string json;
    Outside outside;
    bool exact_if_round;  // has a shape of scree's where its node is scaled evenly across
    double reach = 0.85;  // from its origin along the axes, at most
};

Outside out_of_frustum(double height, double bottom, double top) {
    return [=](const dvec3& p) {
        const double radius = bottom + (top - bottom) * (p.y / height + 0.5);
        return std::max(std::abs(p.y) - 0.5 * height, std::hypot(p.x, p.z) - radius);
    };
}

std::vector<Implicit> all_shapes() {
    const auto capsule = [](double bottom, double top) {
        return [=](const dvec3& p) { return out_of_capsule(p, 0.8, bottom, top); };
    };
    return {{R"("type": "sphere", "sphere": {"radius": 0.5})", [](const dvec3& p) { return glm::length(p) - 0.5; }, true},
            {R"("type": "box", "box": {"size": [0.8, 1, 0.6]})",
             [](const dvec3& p) {
                 const dvec3 d = glm::abs(p) - dvec3(0.4, 0.5, 0.3);
                 return std::max({d.x, d.y, d.z});
             },
             true},
            {R"("type": "cylinder", "cylinder": {"height": 0.8, "radiusBottom": 0.4, "radiusTop": 0.4})",
             out_of_frustum(0.8, 0.4, 0.4), true},
            {R"("type": "cylinder", "cylinder": {"height": 0.8, "radiusBottom": 0.4, "radiusTop": 0})",
             out_of_frustum(0.8, 0.4, 0), true},
            {R"("type": "cylinder", "cylinder": {"height": 0.8, "radiusBottom": 0, "radiusTop": 0.4})",
             out_of_frustum(0.8, 0, 0.4), true},
            {R"("type": "cylinder", "cylinder": {"height": 0.8, "radiusBottom": 0.4, "radiusTop": 0.2})",
             out_of_frustum(0.8, 0.4, 0.2), false},
            {R"("type": "capsule", "capsule": {"height": 0.8, "radiusBottom": 0.3, "radiusTop": 0.3})", capsule(0.3, 0.3), true},
            {R"("type": "capsule", "capsule": {"height": 0.8, "radiusBottom": 0.1, "radiusTop": 0.4})", capsule(0.1, 0.4), false},
            {R"("type": "capsule", "capsule": {"height": 0.8, "radiusBottom": 0.9, "radiusTop": 0.05})", capsule(0.9, 0.05), true,
             1.4}};
}

struct Frame {
    std::string above, own;  // members of two nested nodes
    dmat4 map;
    bool round;  // keeps right angles, and circles about y
};

std::vector<Frame> all_frames() {
    const dmat4 one(1);
    const auto turn = [&](double angle, dvec3 axis) { return glm::rotate(one, angle, axis); };
    const double half = std::sin(0.4), whole = std::cos(0.4);
    const std::string turned = R"("rotation": [0, 0, )" + std::to_string(half) + ", " + std::to_string(whole) + "]";
    return {{"", R"("scale": [1.5, 1.5, 1.5], "translation": [1, 2, 3])",
             glm::translate(one, dvec3(1, 2, 3)) * glm::scale(one, dvec3(1.5)), true},
            {"", R"("scale": [1, 2, 1], )" + turned, turn(0.8, {0, 0, 1}) * glm::scale(one, dvec3(1, 2, 1)), true},
            {"", R"("scale": [2, 1, 0.5])", glm::scale(one, dvec3(2, 1, 0.5)), false},
            // Of the node's own scale the absolute value counts.
            {"", R"("scale": [2, -1, 2])", glm::scale(one, dvec3(2, 1, 2)), true},
            {R"("scale": [3, 1, 1])", turned, glm::scale(one, dvec3(3, 1, 1)) * turn(0.8, {0, 0, 1}), false},
            {R"("scale": [1, 1, -1])", turned + R"(, "scale": [1, 0.5, 2])",
             glm::scale(one, dvec3(1, 1, -1)) * turn(0.8, {0, 0, 1}) * glm::scale(one, dvec3(1, 0.5, 2)), false},
            {R"("matrix": [1, 0.5, 0, 0, 0, 1, 0.3, 0, 0.2, 0, 1, 0, 4, 0, 0, 1])", "",
             dmat4(1, 0.5, 0, 0, 0, 1, 0.3, 0, 0.2, 0, 1, 0, 4, 0, 0, 1), false}};
}

std::string scene_of(const std::string& shape, const Frame& frame, bool moves) {
    const auto comma = [](const std::string& members) { return members.empty() ? "" : members + ", "; };
    return R"({"asset": {"version": "2.0"}, "extensions": {"KHR_implicit_shapes": {"shapes": [{)" + shape +
           R"(}]}}, "scenes": [{"nodes": [0]}], "nodes": [{)" + comma(frame.above) + R"("children": [1]}, {)" + comma(frame.own) +
           R"("extensions": {"KHR_physics_rigid_bodies": {)" + (moves ? R"("motion": {}, )" : "") +
           R"("collider": {"geometry": {"shape": 0}}}}}]})";
}

void judge_by_rays(const Scene& scene, const Implicit& shape, const dmat4& map, double most) {
    const World world(scene);
    const dmat4 back = glm::inverse(map);
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const dvec3 centre(map[3]);
    int hits = 0;
    for (int i = 0; i < 80; ++i) {
        const dvec3 from = centre + 8.0 * glm::normalize(dvec3{any(dice), any(dice), any(dice)});
        const dvec3 along = glm::normalize(centre + dvec3{any(dice), any(dice), any(dice)} - from);
        const auto hit = world.cast_ray({vec3(from), vec3(along)});
        const double end = hit ? static_cast<double>(hit->distance) : 16;
        if (hit) ++hits;
        double least = 1;  // nothing is missed before
        for (double t = 5; t < end - 0.01; t += 0.02)
            least = std::min(least, shape.outside(dvec3(back * glm::dvec4(from + t * along, 1))));
        REQUIRE(least > -most);
        if (hit) REQUIRE(std::abs(shape.outside(dvec3(back * glm::dvec4(from + end * along, 1)))) < most);
    }
    REQUIRE(hits > 8);
}

struct Summed {
    double mass = 0;
    dvec3 centre{0};
    dmat3 inertia{0};
};
// Of density 1000, over points of which each cell of a grid has one.
Summed summed(const Implicit& shape, const dmat4& map) {
    Summed all;
    constexpr int cells = 50;
    const double cell = 2 * shape.reach / cells, each = 1000 * std::abs(glm::determinant(dmat3(map))) * cell * cell * cell;
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<dvec3> points;
    for (int k = 0; k < cells * cells * cells; ++k) {
        const dvec3 within{any(dice), any(dice), any(dice)};
        const dvec3 p = (dvec3(k % cells, k / cells % cells, k / cells / cells) + within) * cell - shape.reach;
        if (shape.outside(p) <= 0) points.emplace_back(map * glm::dvec4(p, 1));
    }
    for (const dvec3& p : points) all.mass += each, all.centre += each * p;
    all.centre /= all.mass;
    for (const dvec3& p : points) {
        const dvec3 d = p - all.centre;
        all.inertia += each * (dmat3(glm::dot(d, d)) - glm::outerProduct(d, d));
    }
    return all;
}

}  // namespace

TEST_CASE("imports: implicit shapes of glTF keep their shape under every transform, at rest and moving") {
    Case file;
    for (const Implicit& shape : all_shapes()) {
        for (const Frame& frame : all_frames()) {
            INFO(shape.json << " under " << frame.above << " " << frame.own);
            const bool box = shape.json.find("box") != std::string::npos, ball = shape.json.find("sphere") != std::string::npos;
            const bool exact = box || ball || (shape.exact_if_round && frame.round);
            for (const bool moves : {false, true}) {
                const SceneDocument document = file.load("a.gltf", scene_of(shape.json, frame, moves));
                judge_by_rays(document.scene, shape, frame.map, exact ? 3e-4 : 2.5e-3);
            }
            if (!exact) CHECK_FALSE(file.notes.empty());
        }
    }
}

TEST_CASE("imports: implicit shapes of glTF have the masses of what they are, stretched and sheared") {
    Case file;
    const std::vector<Frame> frames = all_frames();
    for (const Implicit& shape : all_shapes()) {
        for (const std::size_t k : {std::size_t{0}, std::size_t{4}, std::size_t{6}}) {
            INFO(shape.json << " under " << frames[k].above << " " << frames[k].own);
            const Scene scene = checked(file.load("a.gltf", scene_of(shape.json, frames[k], true)).scene);
            const Body& body = scene.bodies.at(0);
            const Summed right = summed(shape, frames[k].map);
            const MassProperties mass = mass_properties(body);
            CHECK(static_cast<double>(mass.mass) == Approx(right.mass).epsilon(0.03));
            CHECK(glm::length(dvec3(body.position) - right.centre) < 0.02);
            const dmat3 axes =
                glm::mat3_cast(glm::dquat(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z));
            dmat3 inertia(0);
            for (int i = 0; i < 3; ++i) inertia[i][i] = static_cast<double>(mass.inertia[i]);
            inertia = axes * inertia * glm::transpose(axes);
            const dmat3 off = inertia / static_cast<double>(mass.mass) - right.inertia / right.mass;
            const double trace = (right.inertia[0][0] + right.inertia[1][1] + right.inertia[2][2]) / right.mass;
            for (int i = 0; i < 9; ++i) CHECK(std::abs(off[i / 3][i % 3]) < 0.02 * trace);
        }
    }
}

TEST_CASE("imports: planes, joints, centres of mass and nothing at all, of nodes that are scaled and sheared") {
    Case file;
    const Frame sheared = all_frames()[4];
    const World plane(file.load("a.gltf", scene_of(R"("type": "plane", "plane": {})", sheared, false)).scene);
    for (const float x : {-2.0f, 0.0f, 3.0f}) {
        const auto hit = plane.cast_ray({{x, 50, 0}, {0, -1, 0}});
        REQUIRE(hit);
        CHECK((glm::inverse(sheared.map) * glm::dvec4(dvec3(hit->point), 1)).y == Approx(0).margin(1e-4));
    }
    const std::string sphere = R"("type": "sphere", "sphere": {})";
    CHECK(file.refusal("a.gltf", scene_of(sphere, {R"("scale": [1, 0, 1])", "", {}, {}}, true)).find("is scaled flat") !=
          std::string::npos);
    std::string text = scene_of(sphere, {R"("scale": [0, 0, 0])", "", {}, {}}, true);
    CHECK(file.refusal("a.gltf",
                       text.replace(text.find("\"motion\": {}"), 12, R"("motion": {"mass": 1, "inertiaDiagonal": [1, 1, 1]})"))
              .empty());
    CHECK(file.noted("of its node is 0: it is disabled"));
    text = scene_of(sphere, all_frames()[2], true);
    text.replace(text.find("\"motion\": {}"), 12, R"("motion": {"mass": 2, "centerOfMass": [0.1, 0.2, 0.4]})");
    const Scene moved = checked(file.load("a.gltf", text).scene);
    CHECK(glm::length(dvec3(moved.bodies[0].position) - dvec3(0.2, 0.2, 0.2)) < 1e-5);
    for (const char* scale : {R"("scale": [3, 1, 1])", R"("scale": [-1, 1, 1])"}) {
        const std::string joint =
            R"({"asset": {"version": "2.0"}, "extensions": {"KHR_implicit_shapes": {"shapes": [{)" + sphere +
            R"(}]}, "KHR_physics_rigid_bodies": {"physicsJoints": [{"limits": [{"linearAxes": [0, 1, 2], "min": 0, "max": 0}]}]}},
            "scenes": [{"nodes": [0]}], "nodes": [{)" +
            scale + R"(, "children": [1, 2]}, {"rotation": [0, 0, 0.6, 0.8], "extensions": {"KHR_physics_rigid_bodies": {
            "motion": {}, "collider": {"geometry": {"shape": 0}}, "joint": {"connectedNode": 2, "joint": 0}}}}, {}]})";
        CHECK(file.refusal("a.gltf", joint).find("is sheared, mirrored or flat") != std::string::npos);
    }
}

namespace {

// Four faces, of corners 0, x, y and z.
const std::string tetrahedron = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
 "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAAADAAIAAQACAAMA"}]})";

// A collider of node 1, whose children lie at x = 3 and mirrored at x = -3, and a body of its own below.
std::string of_nodes(const std::string& physics, const std::string& geometry) {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [
        {"translation": [0, 10, 0], "children": [], "extensions": {"KHR_physics_rigid_bodies": {)" +
           physics + R"("collider": {"geometry": {"node": 1)" + geometry + R"(}}}}},
        {"mesh": 0, "translation": [50, 50, 50], "children": [2, 3, 5]},
        {"translation": [3, 0, 0], "children": [4]},
        {"mesh": 0, "translation": [-3, 0, 0], "scale": [-1, 1, 1]},
        {"mesh": 0},
        {"mesh": 0, "extensions": {"KHR_physics_rigid_bodies": {"motion": {"mass": 1}}}}],)" +
           tetrahedron;
}

}  // namespace

TEST_CASE("imports: a collider of a glTF node has the meshes of its child nodes, too, where they lie") {
    Case file;
    for (const std::string physics : {"", R"("motion": {}, )"}) {
        const Scene scene = file.load("a.gltf", of_nodes(physics, "")).scene;
        CHECK(file.noted("makes it another body; its mesh is left out"));
        REQUIRE(scene.bodies.size() == 1);
        const World world(scene);
        for (const float x : {0.2f, 3.2f, -3.2f}) {
            INFO(physics << " " << x);
            const auto above = world.cast_ray({{x, 19, 0.2f}, {0, -1, 0}}), below = world.cast_ray({{x, 0, 0.2f}, {0, 1, 0}});
            REQUIRE((above && below));
            CHECK(above->point.y == Approx(10.6).margin(1e-4));  // the face whose coordinates sum to 1
            CHECK(below->point.y == Approx(10).margin(1e-4));
        }
        CHECK_FALSE(world.cast_ray({{1.5f, 19, 0.2f}, {0, -1, 0}}));
    }
    const Scene parts = checked(file.load("a.gltf", of_nodes(R"("motion": {}, )", "")).scene);
    CHECK(std::get<Compound>(parts.bodies[0].shape).parts.size() == 3);
    CHECK(mass_properties(parts.bodies[0]).mass == Approx(500));
    const World whole(file.load("a.gltf", of_nodes("", R"(, "convexHull": true)")).scene);
    CHECK(whole.cast_ray({{1.5f, 19, 0.2f}, {0, -1, 0}}));
    CHECK(file.refusal("a.gltf", of_nodes("", "").replace(of_nodes("", "").find("[2, 3, 5]"), 9, "[1, 3, 5]"))
              .find("deeper than 100, or in a circle") != std::string::npos);
}

TEST_CASE("imports: of two combine rules of glTF average counts before minimum, maximum and multiply") {
    const char* const rules[] = {"average", "minimum", "maximum", "multiply"};
    const double right[] = {0.65, 0.5, 0.8, 0.4};  // of 0.8 and 0.5
    std::string materials, nodes, roots;
    const auto add = [](std::string& list, const std::string& text) { list += (list.empty() ? "" : ", ") + text; };
    for (int k = 0; k < 8; ++k) {
        const std::string value = k < 4 ? "0.8" : "0.5", rule = rules[k % 4];
        add(materials, R"({"restitution": )" + value + R"(, "staticFriction": 0, "dynamicFriction": 0, "restitutionCombine": ")" +
                           rule + "\"}");
        add(materials, R"({"staticFriction": )" + value + R"(, "dynamicFriction": )" + value +
                           R"(, "restitutionCombine": "minimum",
            "frictionCombine": ")" +
                           rule + "\"}");
    }
    // Of floor i and body k: a ball that meets it at 4 m/s, and a box that slides.
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            const auto node = [&](int kind, double y, int shape, int material, const std::string& motion) {
                add(roots, std::to_string(4 * (4 * i + k) + kind));
                add(nodes, R"({"translation": [)" + std::to_string(100 * i + 10 * (kind / 2 * 5)) + ", " + std::to_string(y) +
                               ", " + std::to_string(20 * k) + R"(], "extensions": {"KHR_physics_rigid_bodies": {)" + motion +
                               R"("collider": {"geometry": {"shape": )" + std::to_string(shape) + R"(}, "physicsMaterial": )" +
                               std::to_string(material) + "}}}}");
            };
            node(0, -0.5, 0, 2 * i, "");
            node(1, 1.48, 1, 2 * (4 + k), R"("motion": {"gravityFactor": 0, "linearVelocity": [0, -4, 0]}, )");
            node(2, -0.5, 0, 2 * i + 1, "");
            node(3, 0.1, 2, 2 * (4 + k) + 1, R"("motion": {"linearVelocity": [6, 0, 0]}, )");
        }
    }
    Case file;
    const Scene scene =
        file.load("a.gltf",
                  R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [)" + roots + R"(]}], "nodes": [)" + nodes +
                      R"(], "extensions": {"KHR_implicit_shapes": {"shapes": [{"type": "box", "box": {"size": [40, 1, 10]}},
        {"type": "sphere", "sphere": {"radius": 0.5}}, {"type": "box", "box": {"size": [1, 0.2, 1]}}]},
        "KHR_physics_rigid_bodies": {"physicsMaterials": [)" +
                      materials + "]}}}")
            .scene;
    CHECK(file.notes.empty());
    World world(scene);
    std::vector<std::size_t> moving;  // ball and box in turn; fixed bodies come first
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (scene.bodies[b].motion == Motion::dynamic) moving.push_back(b);
    REQUIRE(moving.size() == 32);
    world.step(40);
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            INFO(rules[i] << " and " << rules[k]);
            const auto n = static_cast<std::size_t>(2 * (4 * i + k));
            const double rule = right[std::min(i, k)];
            CHECK(static_cast<double>(world.body(moving[n]).velocity.y) == Approx(4 * rule).epsilon(0.01));
            CHECK(6 - static_cast<double>(world.body(moving[n + 1]).velocity.x) == Approx(rule * 9.81 * 40 / 60).epsilon(0.03));
        }
    }
}
