// The looks of the demos.
#include "demos/scenes/looks.h"

#include <algorithm>
#include <array>
#include <optional>

namespace scree::demos {

namespace {

using enum ShownQuantity;

struct Look {
    std::string_view demo;
    PictureStyle style;
    std::optional<float> vertical_fov{};  // degrees
    std::optional<vec3> eye{}, target{};  // m
};

PictureStyle by(ShownQuantity quantity, float high = 0, std::vector<Overlay> show = {}) {
    return {quantity, ShownMap::ember, ShownScale::automatic, {0, high}, std::move(show)};
}

PictureStyle lit(PictureStyle style, float azimuth, float elevation) {
    style.sun_azimuth = azimuth;
    style.sun_elevation = elevation;
    return style;
}

const std::vector<Look>& looks() {
    using enum Overlay;
    static const std::vector<Look> all = {
        {"rest", by(body)},
        {"stack", by(contact_impulse, 420, {contacts})},
        {"tower", by(contact_impulse, 1700), 85, vec3(5, 1, 7), vec3(0.3f, 9, 0)},
        {"wall", by(contact_impulse, 260)},
        {"pyramid", by(contact_impulse, 700), 38},
        {"seesaw", by(momentum, 500, {contacts, velocities})},
        {"slopes", by(momentum, 800, {velocities}), 39},
        {"cradle", by(momentum, 1500, {velocities}), 35, vec3(0.5f, 3.2f, 12.2f), vec3(0.5f, 0.4f, 0)},
        {"dominoes", by(momentum, 100)},
        {"pile", by(momentum, 600)},
        {"mix", by(kinetic_energy, 3000)},
        {"avalanche", by(momentum, 3000)},
        {"assortment", by(body)},
        {"bins", by(body)},
        {"terrain", by(momentum, 15000), 46},
        {"mesh", by(momentum, 300), 38},
        {"chain", by(momentum, 80, {joints})},
        {"bridge", by(momentum, 1000, {joints})},
        {"ragdolls", by(body), 43},
        {"pendulums", by(body, 0, {joints})},
        {"machine", by(momentum, 500, {joints})},
        {"wrecking", lit(by(speed, 12), -105, 42)},
        {"glass", by(speed, 12)},
        {"shatter", by(speed, 15)},
        {"drive", by(own)},
        {"cars", by(speed, 14)},
        {"ring", by(contact_impulse, 260)},
        {"gables", by(contact_impulse, 260)},
        {"net", by(height)},
        {"fountain", by(speed, 9)},
        {"hopper", by(speed, 5)},
        {"ballast", by(contact_impulse, 20)},
        {"drum", by(speed, 2)},
    };
    return all;
}

}  // namespace

void set_look(std::string_view demo, DemoScene& scene) {
    const auto look = std::find_if(looks().begin(), looks().end(), [&](const Look& one) { return one.demo == demo; });
    if (look == looks().end()) return;
    scene.picture = look->style;
    if (look->vertical_fov) scene.viewpoint.vertical_fov = *look->vertical_fov;
    if (look->eye) scene.viewpoint.eye = *look->eye;
    if (look->target) scene.viewpoint.target = *look->target;
}

}  // namespace scree::demos
