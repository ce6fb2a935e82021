// The list of shapes against everything derived from it: scene files, messages, the schema, shape ids.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/scene_schema.h"

using namespace scree;
using nlohmann::json;

namespace {

json published_schema() {
    return json::parse(scene_schema());
}

// The schema that "$ref" names, merged with its siblings.
json resolved(const json& schema, json value) {
    if (!value.contains("$ref")) return value;
    json made = schema.at(json::json_pointer(value["$ref"].get<std::string>().substr(1)));
    for (const auto& [key, said] : value.items()) made[key] = said;
    return made;
}

json json_of(float number) {
    return number;
}
json json_of(vec3 v) {
    return {v.x, v.y, v.z};
}

// The numeric schema of a field; the innermost one of nested arrays.
json numbers_of(const json& schema, json value) {
    value = resolved(schema, value);
    while (value.contains("items")) value = resolved(schema, value["items"]);
    return value;
}

}  // namespace

TEST_CASE("the published schema says of each shape what the list of shapes says") {
    const json schema = published_schema();
    const json& known = schema["$defs"]["shape"]["oneOf"];
    REQUIRE(known.size() == std::variant_size_v<Shape>);
    for_each_shape([&](const auto& shape) {
        using Kind = std::remove_cvref_t<decltype(shape)>;
        const std::string name = ShapeInfo<Kind>::name;
        CAPTURE(name);
        const auto entry =
            std::find_if(known.begin(), known.end(), [&](const json& one) { return one["required"] == json::array({name}); });
        REQUIRE(entry != known.end());
        json fields = (*entry)["properties"][name];
        if (std::is_same_v<Kind, Mesh>) fields = fields["oneOf"][1];  // the first alternative is a file
        REQUIRE(fields["additionalProperties"] == false);
        std::set<std::string> said, required;
        for (const auto& [key, value] : fields["properties"].items()) said.insert(key);
        for (const auto& key : fields.value("required", json::array())) required.insert(key.template get<std::string>());
        for_each_shape_field<Kind>([&](const auto& field) {
            CAPTURE(field.name);
            REQUIRE(said.erase(field.name) == 1);
            CHECK(required.erase(field.name) == (field.required ? 1 : 0));
            const json value = resolved(schema, fields["properties"][field.name]);
            if constexpr (requires { json_of(shape.*field.member); })
                if (!field.required) CHECK(value["default"] == json_of(shape.*field.member));
            using Value = std::remove_cvref_t<decltype(shape.*field.member)>;
            if (field.is_direction() || std::is_same_v<Value, std::vector<Part>>) return;
            const json number = numbers_of(schema, value);
            CHECK(number["minimum"].template get<float>() == field.range.least);
            if (number.contains("maximum")) CHECK(number["maximum"].template get<float>() == field.range.most);
        });
        const std::set<std::string> beside = name == "compound" ? std::set<std::string>{"skins"}
                                             : name == "mesh"   ? std::set<std::string>{"decompose"}
                                                                : std::set<std::string>{};
        CHECK(said == beside);  // what is not in the list
        CHECK(required.empty());
        return true;
    });
}

TEST_CASE("every shape of the list is written to a scene file by its name and read back") {
    for_each_shape([&](auto shape) {
        using Kind = decltype(shape);
        CAPTURE(ShapeInfo<Kind>::name);
        Scene scene;
        scene.bodies.resize(1);
        scene.bodies[0].shape = shape;
        const std::string text = scene_to_json(scene);
        CHECK(text.find(std::string("{\"") + ShapeInfo<Kind>::name + "\": {\"") != std::string::npos);
        const Scene read = scene_from_json(text).scene;
        REQUIRE(std::holds_alternative<Kind>(read.bodies[0].shape));
        CHECK(scene_to_json(read) == text);
        return true;
    });
}

TEST_CASE("every number of a convex shape is held to its range, and refused by its name") {
    for_each_shape([&](const auto& shape) {
        using Kind = std::remove_cvref_t<decltype(shape)>;
        if constexpr (std::is_constructible_v<SimpleShape, Kind>) {
            for_each_shape_field<Kind>([&](const auto& field) {
                CAPTURE(ShapeInfo<Kind>::name, field.name);
                Kind wrong = shape;
                auto& value = wrong.*field.member;
                if constexpr (requires { value.x; })
                    value.y = NAN;
                else if constexpr (requires { value.resize(1); })
                    value.resize(5, vec3(1e6f));
                else
                    value = 2 * field.range.most;
                Scene scene;
                scene.bodies.resize(1);
                scene.bodies[0].motion = Motion::fixed;
                scene.bodies[0].shape = wrong;
                CHECK_THROWS_WITH(checked(scene),
                                  Catch::Contains(std::string("/bodies/0/shape/") + ShapeInfo<Kind>::name + "/" + field.name));
            });
        }
        return true;
    });
}

TEST_CASE("what surrounds a convex shape holds it, as closely as it says") {
    const Shape shapes[] = {Sphere{0.4f}, Capsule{0.2f, 0.5f}, Box{{0.2f, 0.3f, 0.5f}}, Cylinder{0.3f, 0.6f}, Cone{0.4f, 1}};
    for (const Shape& shape : shapes) {
        CAPTURE(shape_name(shape));
        const vec3 half = half_extents(shape);
        double farthest = 0;
        for (int k = 0; k < 4000; ++k) {
            const double y = 1 - (2 * k + 1.0) / 4000, angle = 2.399963229728653 * k, r = std::sqrt(1 - y * y);
            const glm::dvec3 n(r * std::cos(angle), y, r * std::sin(angle));
            const double reach = reach_along(shape, n);
            farthest = std::max(farthest, reach);
            REQUIRE(reach <= glm::dot(glm::abs(n), glm::dvec3(half)) + 1e-6);
        }
        CHECK(farthest <= bounding_radius(shape) + 1e-6);
        CHECK(farthest >= 0.99 * bounding_radius(shape));
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 n(0);
            n[axis] = 1;
            CHECK(std::max(reach_along(shape, n), reach_along(shape, -n)) == Approx(half[axis]));
        }
    }
}
