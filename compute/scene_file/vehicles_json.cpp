// Vehicles of a scene file: reading and writing them.
#include "compute/scene_file/vehicles_json.h"

#include <map>

namespace scree {

namespace json_reading {

// One list of keys for reading and writing; `numbers` visits each key with its value.
template <class Visit>
static void numbers_of(auto& engine, const Visit& visit) requires requires {
    engine.back_speed;
}
{
    visit("torque", engine.torque);
    visit("power", engine.power);
    visit("top_speed", engine.top_speed);
    visit("back_speed", engine.back_speed);
    visit("drag", engine.drag);
}
template <class Visit>
static void numbers_of(auto& steering, const Visit& visit) requires requires {
    steering.lateral;
}
{
    visit("angle", steering.angle);
    visit("time", steering.time);
    visit("lateral", steering.lateral);
}
template <class Visit>
static void numbers_of(auto& controls, const Visit& visit) requires requires {
    controls.throttle;
}
{
    visit("throttle", controls.throttle);
    visit("brake", controls.brake);
    visit("steer", controls.steer);
    visit("hand_brake", controls.hand_brake);
}
template <class Visit>
static void numbers_of(auto& wheel, const Visit& visit) requires requires {
    wheel.skid;
}
{
    visit("radius", wheel.radius);
    visit("drive", wheel.drive);
    visit("brake", wheel.brake);
    visit("hand_brake", wheel.hand_brake);
    visit("skid", wheel.skid);
}

template <class Part>
static void read_numbers(const json& value, const Place& place, Part& part, Names further = {}) {
    Names known = std::move(further);
    numbers_of(part, [&](const char* key, float&) { known.emplace_back(key); });
    only(value, place, known);
    numbers_of(part, [&](const char* key, float& number) { optional(value, place, key, number); });
}
static void read(const json& value, const Place& place, Engine& out) {
    read_numbers(value, place, out);
}
static void read(const json& value, const Place& place, Steering& out) {
    read_numbers(value, place, out);
}
static void read(const json& value, const Place& place, Controls& out) {
    read_numbers(value, place, out);
}
static void read(const json& value, const Place& place, std::vector<WayPoint>& route) {
    if (!value.is_array()) refuse(place, "must be an array of way points, is " + kind(value));
    for (std::size_t i = 0; i < value.size(); ++i) {
        only(value[i], place / i, {"position", "speed"});
        WayPoint& point = route.emplace_back();
        required(value[i], place / i, "position", point.position);
        optional(value[i], place / i, "speed", point.speed);
    }
}

}  // namespace json_reading

namespace {

using namespace json_reading;

using Named = std::map<std::string, std::size_t>;  // the first of each name

template <class Things>
Named names_of(const Things& things) {
    Named named;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (!things[i].name.empty()) named.try_emplace(things[i].name, i);
    return named;
}

std::size_t index_of(const json& value, const Place& place, const char* key, const char* what, const Named& named) {
    const auto found = value.find(key);
    if (found == value.end()) refuse(place, std::string("lacks \"") + key + "\"");
    if (found->is_number_unsigned()) return found->template get<std::size_t>();
    if (!found->is_string()) refuse(place / key, std::string("must be a ") + what + "'s index or name, is " + kind(*found));
    const auto one = named.find(found->template get<std::string>());
    if (one == named.end())
        refuse(place / key,
               std::string("there is no ") + what + " named " + found->dump() + "; they have indices from 0, or names");
    return one->second;
}

Vehicle vehicle_of(const json& value, const Place& place, const Named& bodies, const Named& joints) {
    only(value, place, {"name", "chassis", "wheels", "engine", "steering", "controls", "route", "loops", "by_route", "next"});
    Vehicle vehicle;
    optional(value, place, "name", vehicle.name);
    vehicle.chassis = index_of(value, place, "chassis", "body", bodies);
    if (!value.contains("wheels") || !value["wheels"].is_array()) refuse(place, "needs \"wheels\", an array");
    const Place wheels = place / "wheels";
    for (std::size_t k = 0; k < value["wheels"].size(); ++k) {
        const json& one = value["wheels"][k];
        Wheel& wheel = vehicle.wheels.emplace_back();
        read_numbers(one, wheels / k, wheel, {"joint", "steers"});
        wheel.joint = index_of(one, wheels / k, "joint", "joint", joints);
        optional(one, wheels / k, "steers", wheel.steers);
    }
    optional(value, place, "engine", vehicle.engine);
    optional(value, place, "steering", vehicle.steering);
    optional(value, place, "controls", vehicle.controls);
    optional(value, place, "route", vehicle.route);
    optional(value, place, "loops", vehicle.loops);
    optional(value, place, "by_route", vehicle.by_route);
    optional(value, place, "next", vehicle.next);
    return vehicle;
}

template <class Part>
nlohmann::ordered_json json_of(const Part& part) {
    nlohmann::ordered_json made = nlohmann::ordered_json::object();
    numbers_of(part, [&](const char* key, float number) { made[key] = number; });
    return made;
}

}  // namespace

void read_vehicles(const nlohmann::json& value, Scene& scene) {
    const Place root{nullptr, nullptr, 0};
    const Place vehicles = root / "vehicles";
    if (!value.is_array()) refuse(vehicles, "must be an array, is " + kind(value));
    const Named bodies = names_of(scene.bodies), joints = names_of(scene.joints);
    for (std::size_t i = 0; i < value.size(); ++i) scene.vehicles.push_back(vehicle_of(value[i], vehicles / i, bodies, joints));
}

std::string vehicle_to_json(const Vehicle& vehicle) {
    nlohmann::ordered_json made = nlohmann::ordered_json::object();
    if (!vehicle.name.empty()) made["name"] = vehicle.name;
    made["chassis"] = vehicle.chassis;
    made["wheels"] = nlohmann::ordered_json::array();
    for (const Wheel& wheel : vehicle.wheels) {
        nlohmann::ordered_json one = {{"joint", wheel.joint}};
        one.update(json_of(wheel));
        if (wheel.steers) one["steers"] = true;
        made["wheels"].push_back(std::move(one));
    }
    made["engine"] = json_of(vehicle.engine);
    made["steering"] = json_of(vehicle.steering);
    if (!(vehicle.controls == Controls{})) made["controls"] = json_of(vehicle.controls);
    for (const WayPoint& point : vehicle.route)
        made["route"].push_back({{"position", {point.position.x, point.position.y, point.position.z}}, {"speed", point.speed}});
    if (vehicle.loops) made["loops"] = true;
    if (!vehicle.by_route) made["by_route"] = false;
    if (vehicle.next != 1) made["next"] = vehicle.next;
    return made.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace scree
