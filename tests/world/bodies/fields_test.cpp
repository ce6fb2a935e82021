// Field tables: everything that follows from a line of a table; reading, writing, validation and schema agree.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/fields_write.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/vehicle_presets.h"
#include "tests/house/tree.h"
#include "tests/refusal.h"

using namespace scree;
using nlohmann::json;

namespace {

// A struct with one property, declared by a member and a line of a table.
struct Lamp {
    float brightness = 5;  // lx
};

const json_reading::Place root{nullptr, nullptr, 0};

Scene brick() {
    Scene scene;
    scene.bodies.emplace_back().name = "brick";
    return scene;
}

// A scene that sets every field.
Scene of_all() {
    Scene scene = brick();
    scene.bodies[0].tyre.emplace();
    scene.bodies[0].filter = Filter{2, 5, -3};
    scene.exclusions.push_back({0, 1});
    scene.bodies[0].fracture.emplace().impulse = 3;
    add_car(scene, {});
    scene.vehicles[0].controls.throttle = 1;
    scene.vehicles[0].route = {{vec3(0), 1}, {vec3(9), 1}};
    Axis axis;
    axis.limits = Limits{-1, 1};
    axis.spring = Spring{1, 1, 0, 1};
    for (const JointKind& kind : {JointKind(Ball{1}), JointKind(Hinge{axis}), JointKind(Slider{axis}), JointKind(Fixed{}),
                                  JointKind(Distance{0, 2, Spring{}}), JointKind(ConeTwist{1, {-1, 1}, 1})}) {
        Joint joint;
        joint.name = "pin";
        joint.kind = kind;
        joint.b = 0;
        joint.break_force = joint.break_torque = 9;
        joint.collide = joint.broken = true;
        scene.joints.push_back(joint);
    }
    return scene;
}

json at_ref(const json& schema, const json& found) {
    if (!found.contains("$ref")) return found;
    return schema.at(json::json_pointer(found["$ref"].get<std::string>().substr(1)));
}

// Walks a value and its schema in parallel.
void require_known(const json& schema, const json& known, const json& value, const std::string& place) {
    INFO(place);
    const json type = at_ref(schema, known);
    if (value.is_object() && type.contains("properties")) {
        for (const auto& [key, inner] : value.items()) {
            INFO(key);
            REQUIRE(type["properties"].contains(key));
            require_known(schema, type["properties"][key], inner, place + "/" + key);
        }
    } else if (value.is_array() && type.contains("items")) {
        for (std::size_t i = 0; i < value.size(); ++i)
            require_known(schema, type["items"], value[i], place + "/" + std::to_string(i));
    }
}

}  // namespace

namespace scree::schema {
template <>
inline constexpr auto table<Lamp> = table_of("lamp", "A lamp",
                                             field("brightness", &Lamp::brightness, between(0, 10), "lx", "Illuminance"));
}

TEST_CASE("fields: a property is a member and a line, from which it is read, written and checked", "[scene]") {
    const auto read = [](const std::string& text) {
        Lamp lamp;
        json_reading::read_value(json::parse(text), root / "lamp", lamp, "", {});
        schema::check_fields(root / "lamp", lamp);
        return lamp.brightness;
    };
    CHECK(read("{}") == 5);
    CHECK(read(R"({"brightness": 7})") == 7);
    CHECK(tests::refusal_of([&] { read(R"({"brightness": 11})"); }) == "/lamp/brightness: must be between 0 and 10 lx, is 11");
    CHECK(tests::refusal_of([&] { read(R"({"brightness": "much"})"); }) ==
          "/lamp/brightness: must be a number, is the string \"much\"");
    CHECK(tests::refusal_of([&] { read(R"({"brigtness": 1})"); }) ==
          "/lamp/brigtness: unknown key \"brigtness\"; nearest: \"brightness\"; known: brightness");
    const auto written = [](float brightness) {
        Text text;
        write_value(text, Lamp{brightness});
        return text.take();
    };
    CHECK(written(5) == "{}");
    CHECK(written(0.1f) == R"({"brightness": 0.1})");
    CHECK(tests::refusal_of([&] { written(std::nanf("")); }).find("not finite") != std::string::npos);
}

TEST_CASE("fields: the host code names a body's property in its table alone", "[house]") {
    for (const char* key : {"restitution", "rolling_resistance", "linear_damping", "angular_damping", "gravity_scale"}) {
        INFO(key);
        std::vector<std::string> found;
        for (const house::SourceFile& file : house::source_files())
            // Files of other programs have keys of their own.
            if (file.in("compute/") && !file.in("compute/scene_file/import/") &&
                file.text.find("\"" + std::string(key) + "\"") != std::string::npos)
                found.push_back(file.path);
        CHECK(found == std::vector<std::string>{"compute/schema/body.h"});
    }
}

TEST_CASE("fields: the schema has the ranges and defaults of the table, which a body is held to", "[scene]") {
    const json schema = json::parse(scene_schema());
    const json& properties = schema["$defs"]["body"]["properties"];
    std::size_t numbers = 0;
    schema::for_each_field<Body>([&]<class Member>(const schema::Field<Body, Member>& field) {
        INFO(field.key);
        REQUIRE(properties.contains(field.key));
        if constexpr (std::is_same_v<Member, float>) {
            ++numbers;
            const json& known = properties[field.key];
            CHECK(known["minimum"].get<double>() == field.range.low);
            CHECK(known["maximum"].get<double>() == field.range.high);
            if (field.range.holds(Body{}.*field.member)) CHECK(known["default"].get<float>() == Body{}.*field.member);
            CHECK(known["description"].get<std::string>().size() > 5);
            const auto said = [&](float value) {
                Scene scene = brick();
                scene.bodies[0].*field.member = value;
                return tests::refusal_of([&] { checked(scene); });
            };
            const std::string place = "/bodies/0/" + std::string(field.key) + ": must be ";
            for (const float wrong : {std::nextafter(static_cast<float>(field.range.high), HUGE_VALF),
                                      std::nextafter(static_cast<float>(field.range.low), -HUGE_VALF), std::nanf(""), HUGE_VALF})
                CHECK(said(wrong).starts_with(place));
            CHECK_FALSE(said(static_cast<float>(field.range.high)).starts_with(place));
            CHECK_FALSE(said(static_cast<float>(field.range.low)).starts_with(place));
            CHECK(said(std::nanf("")).ends_with("(body \"brick\")"));
        }
    });
    CHECK(numbers == 13);
}

TEST_CASE("fields: the schema knows every key of a scene that says all, which reads back to the same text", "[scene]") {
    const json schema = json::parse(scene_schema());
    Viewpoint path;
    path.path = {{0, vec3(1), vec3(0), 30}, {2, vec3(2), vec3(0), 40}};
    for (const Viewpoint& view : {Viewpoint{vec3(1), vec3(0), 33, true, {}}, path}) {
        const std::string text = scene_to_json(of_all(), view);
        require_known(schema, schema, json::parse(text), "");
        const SceneDocument again = scene_from_json(text);
        CHECK(scene_to_json(again.scene, again.viewpoint) == text);
    }
}

TEST_CASE("fields: a joint's unit is that of its axis", "[scene]") {
    const auto said = [](const JointKind& kind) {
        Scene scene = brick();
        scene.joints.emplace_back().kind = kind;
        scene.joints[0].b = 0;
        return tests::refusal_of([&] { checked(scene); });
    };
    Axis axis;
    axis.friction = -1;
    CHECK(said(Hinge{axis}) == "/joints/0/kind/hinge/friction: must be between 0 and 1e+30 N m, is -1");
    CHECK(said(Slider{axis}) == "/joints/0/kind/slider/friction: must be between 0 and 1e+30 N, is -1");
    SixDof six;
    six.twist.limits = Limits{-2e30f, 0};
    CHECK(said(six) == "/joints/0/kind/six_degrees/twist/limits/lower: must be within 1e+30 rad of 0, is -2e+30");
    CHECK(said(Distance{-1, 1, {}}) == "/joints/0/kind/distance/least: must be between 0 and 1e+30 m, is -1");
    CHECK(said(Distance{2, 1, {}}).starts_with("/joints/0/kind/distance: the limits are reversed"));
}
