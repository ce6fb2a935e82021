// What a drawing shows at each pixel, by body and part.
#include "demos/film/drawn_labels.h"

#include <algorithm>
#include <variant>

#include "compute/parallel/threads.h"
#include "compute/runner.h"
#include "host/device_error.h"

namespace scree::demos {

namespace {

bool has_skins(const Scene& scene) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) {
        const auto* compound = std::get_if<Compound>(&body.shape);
        return compound != nullptr && !compound->skins.empty();
    });
}

}  // namespace

RowNames::RowNames(const World& world) {
    const std::vector<std::size_t> first_parts = world.first_part_rows();
    for (std::size_t body = 0; body < first_parts.size(); ++body) {
        const std::size_t row = world.row_of(body);
        if (row >= bodies_.size()) bodies_.resize(row + 1, host::no_row);
        bodies_[row] = static_cast<std::uint32_t>(body);
        if (first_parts[body] != no_body) begins_.emplace_back(first_parts[body], static_cast<std::uint32_t>(body));
    }
    std::sort(begins_.begin(), begins_.end());
}

RowNames::Name RowNames::operator[](std::uint32_t row) const {
    if (row < bodies_.size() && bodies_[row] != host::no_row) return {bodies_[row], 0};
    const auto next = std::upper_bound(begins_.begin(), begins_.end(), std::pair(std::size_t{row}, host::no_row));
    const auto& [begin, body] = *(next - 1);
    return {body, row - begin};
}

std::unique_ptr<host::Labels> DrawnLabels::label(const host::Camera& camera, const host::LabelRequest& request) {
    std::unique_ptr<host::Labels> made = drawing_.canvas().label(camera, request);
    if (!made)
        throw host::DeviceError("labels of pictures: " + drawing_.canvas().name() +
                                " does not write lists from fragment shaders (fragmentStoresAndAtomics); try another --canvas");
    return made;
}

const RowNames& DrawnLabels::names() {
    if (!names_ || arrangements_ != world_.arrangements()) {
        names_.emplace(world_);
        arrangements_ = world_.arrangements();
        skins_ = !parts_ && has_skins(world_.scene());
    }
    return *names_;
}

Channels DrawnLabels::channels(const host::Camera& camera, int width, int height, const ChannelChoice& choice,
                               const Before& before) {
    const host::PixelRays rays = host::pixel_rays(camera, width, height);
    const std::unique_ptr<host::Labels> labels = label(camera, {.width = width, .height = height});
    const RowNames& known = names();
    ChannelMaker maker(world_, rays, width, height, choice, before);
    world_.runner().threads().for_each(labels->pixels.size(), [&](std::size_t i) {
        const host::LabelledPixel& pixel = labels->pixels[i];
        if (pixel.row == host::no_row) return maker.take_nothing(i);
        const RowNames::Name name = known[pixel.row];
        const glm::vec2 at = maker.centre_of(i);
        const vec3 offset = rays.corner + rays.right * at.x + rays.down * at.y;
        const vec3 point = rays.eye + (rays.orthographic ? offset + rays.forward * pixel.depth : offset * pixel.depth);
        maker.take(i, {name.body, name.part, pixel.depth, point, host::normal_of(pixel)});
    });
    // A skin has no parts of its own: those behind it.
    if (choice.part && skins_) maker.made.part = channels_of(world_, camera, width, height, {.part = true}, before).part;
    return std::move(maker.made);
}

}  // namespace scree::demos
