// Messages of viewers, read strictly: they come from outside.
#include "demos/program/serve/viewer_message.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "compute/schema/settings.h"

namespace scree::demos {

namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, Deed>, 27> words{{
    {"seen", Deed::seen},
    {"watch", Deed::watch},
    {"pace", Deed::pace},
    {"take", Deed::take},
    {"yield", Deed::yield},
    {"pause", Deed::pause},
    {"step", Deed::step},
    {"restart", Deed::restart},
    {"keep", Deed::keep},
    {"restore", Deed::restore},
    {"go", Deed::go},
    {"speed", Deed::speed},
    {"open", Deed::open},
    {"set", Deed::set},
    {"press", Deed::press},
    {"move", Deed::move},
    {"release", Deed::release},
    {"wheel", Deed::wheel},
    {"key", Deed::key},
    {"ball", Deed::ball},
    {"box", Deed::box},
    {"explode", Deed::explode},
    {"undo", Deed::undo},
    {"remove", Deed::remove},
    {"duplicate", Deed::duplicate},
    {"righten", Deed::righten},
    {"select", Deed::select},
}};

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument(why);
}

Deed deed_named(const std::string& word) {
    for (const auto& [name, deed] : words)
        if (name == word) return deed;
    refuse("do: nothing that scree serve knows");
}

const json& value_of(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end()) refuse(fmt::format("{} is missing", key));
    return *found;
}

double number_of(const json& object, const char* key, double low, double high) {
    const json& value = value_of(object, key);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= low && number <= high)) refuse(fmt::format("{} must be a number between {} and {}", key, low, high));
    return number;
}
std::size_t whole_of(const json& object, const char* key, double high) {
    const double number = number_of(object, key, 0, high);
    if (number != std::floor(number)) refuse(fmt::format("{} must be a whole number", key));
    return static_cast<std::size_t>(number);
}
bool switch_of(const json& object, const char* key) {
    const json& value = value_of(object, key);
    if (!value.is_boolean()) refuse(fmt::format("{} must be true or false", key));
    return value.get<bool>();
}
std::string word_of(const json& object, const char* key) {
    const json& value = value_of(object, key);
    if (!value.is_string()) refuse(fmt::format("{} must be a text", key));
    return value.get<std::string>();
}
glm::vec3 vector_of(const json& object, const char* key, double most) {
    const json& value = value_of(object, key);
    if (!value.is_array() || value.size() != 3) refuse(fmt::format("{} must be three numbers", key));
    glm::vec3 vector(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const double number = value[k].is_number() ? value[k].get<double>() : std::nan("");
        if (!(std::abs(number) <= most)) refuse(fmt::format("{}: each number must be between -{} and {}", key, most, most));
        vector[static_cast<glm::length_t>(k)] = static_cast<float>(number);
    }
    return vector;
}

PointerAt pointer_of(const json& message) {
    const json& at = value_of(message, "at");
    if (!at.is_object()) refuse("at must be an object");
    constexpr double far = 1e6, widest = 16384;
    PointerAt pointer;
    pointer.view.eye = vector_of(at, "eye", far);
    pointer.view.target = vector_of(at, "target", far);
    if (!(glm::length(pointer.view.eye - pointer.view.target) > 1e-4f)) refuse("at: eye and target coincide");
    pointer.view.vertical_fov = static_cast<float>(number_of(at, "fov", 0.1, 179));
    pointer.extent.width = static_cast<int>(number_of(at, "width", 1, widest));
    pointer.extent.height = static_cast<int>(number_of(at, "height", 1, widest));
    pointer.x = number_of(at, "x", -widest, 2 * widest);
    pointer.y = number_of(at, "y", -widest, 2 * widest);
    return pointer;
}

constexpr double most_bodies = 1e8, most_steps = 1e15;

}  // namespace

ViewerMessage viewer_message(const std::string& text) {
    const json read = json::parse(text, nullptr, false);
    if (!read.is_object()) refuse("messages are JSON objects");
    ViewerMessage message;
    message.deed = deed_named(word_of(read, "do"));
    const auto range = [](auto Settings::*setting) { return schema::field_of(setting).range; };
    switch (message.deed) {
        case Deed::seen:
            message.number = static_cast<double>(whole_of(read, "frames", most_steps));
            break;
        case Deed::go:
            message.number = static_cast<double>(whole_of(read, "step", most_steps));
            break;
        case Deed::pace:
            message.number = number_of(read, "fps", 0.1, 1000);
            break;
        case Deed::speed:
            message.number = number_of(read, "value", 0.01, 100);
            break;
        case Deed::wheel:
            message.number = number_of(read, "clicks", -20, 20);
            break;
        case Deed::watch:
        case Deed::pause:
            message.on = switch_of(read, "on");
            break;
        case Deed::key:
            message.word = word_of(read, "key");
            message.on = switch_of(read, "on");
            if (message.word != "w" && message.word != "a" && message.word != "s" && message.word != "d" &&
                message.word != "space")
                refuse("key must be w, a, s, d or space");
            break;
        case Deed::open:
            message.word = word_of(read, "name");
            if (read.contains("bodies")) message.bodies = whole_of(read, "bodies", most_bodies);
            break;
        case Deed::set:
            if (read.contains("gravity")) message.gravity = vector_of(read, "gravity", 1000);
            if (read.contains("substeps")) {
                const auto bounds = range(&Settings::substeps);
                message.substeps = static_cast<int>(number_of(read, "substeps", bounds.low, bounds.high));
            }
            break;
        case Deed::press:
            message.at = pointer_of(read);
            message.body = whole_of(read, "body", most_bodies);
            break;
        case Deed::move:
        case Deed::ball:
        case Deed::box:
        case Deed::explode:
            message.at = pointer_of(read);
            break;
        case Deed::select:
            if (read.contains("body")) message.body = whole_of(read, "body", most_bodies);
            break;
        default:
            break;
    }
    return message;
}

}  // namespace scree::demos
