// Joining the parts of pictures, and drawing one.
#include "demos/film/rank_parts.h"

#include <algorithm>
#include <cstring>

#include "compute/distributed/ranks.h"
#include "compute/tables/state.h"
#include "demos/film/drawing.h"
#include "host/device_error.h"

namespace scree::demos {

namespace {

// The range of `size` items that a rank joins.
std::pair<std::size_t, std::size_t> range_of(std::size_t rank, std::size_t ranks, std::size_t size) {
    return {size * rank / ranks, size * (rank + 1) / ranks};
}

template <class Value>
void append_values(Bytes& sent, std::span<const Value> values) {
    const auto bytes = std::as_bytes(values);
    sent.insert(sent.end(), bytes.begin(), bytes.end());
}
template <class Value>
Value value_at(const Bytes& received, std::size_t index, std::size_t behind = 0) {
    Value value;
    std::memcpy(&value, &received.at(behind + index * sizeof value), sizeof value);
    return value;
}

}  // namespace

bool all_ranks(Exchange& exchange, bool own) {
    const std::vector<Bytes> received = exchange.all_gather({std::byte{own}});
    return std::all_of(received.begin(), received.end(), [](const Bytes& one) { return one.at(0) != std::byte{0}; });
}

void RankParts::unite(std::span<float> depths) {
    const auto ranks = static_cast<std::size_t>(exchange_.ranks()), own = static_cast<std::size_t>(exchange_.rank());
    std::vector<Bytes> to(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        const auto [first, last] = range_of(r, ranks, depths.size());
        append_values<float>(to[r], depths.subspan(first, last - first));
    }
    const auto [first, last] = range_of(own, ranks, depths.size());
    std::vector<float> least(depths.begin() + static_cast<std::ptrdiff_t>(first),
                             depths.begin() + static_cast<std::ptrdiff_t>(last));
    for (const Bytes& received : exchange_.all_to_all(to))
        for (std::size_t k = 0; k < least.size(); ++k) least[k] = std::min(least[k], value_at<float>(received, k));
    Bytes sent;
    append_values<float>(sent, least);
    const std::vector<Bytes> united = exchange_.all_gather(sent);
    for (std::size_t r = 0; r < ranks; ++r)
        if (!united[r].empty()) std::memcpy(&depths[range_of(r, ranks, depths.size()).first], united[r].data(), united[r].size());
}

void RankParts::compose(std::span<std::uint32_t> colors, std::span<const float> depths) {
    const auto ranks = static_cast<std::size_t>(exchange_.ranks()), own = static_cast<std::size_t>(exchange_.rank());
    std::vector<Bytes> to(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        const auto [first, last] = range_of(r, ranks, depths.size());
        append_values<float>(to[r], depths.subspan(first, last - first));
        append_values<std::uint32_t>(to[r], colors.subspan(first, last - first));
    }
    const auto [first, last] = range_of(own, ranks, depths.size());
    const std::size_t count = last - first;
    std::vector<float> nearest(count, -1);
    std::vector<std::uint32_t> shown(count);
    for (const Bytes& received : exchange_.all_to_all(to))
        for (std::size_t k = 0; k < count; ++k)
            if (const auto depth = value_at<float>(received, k); depth > nearest[k]) {
                nearest[k] = depth;
                shown[k] = value_at<std::uint32_t>(received, k, count * sizeof(float));
            }
    std::vector<Bytes> to_first(ranks);
    append_values<std::uint32_t>(to_first[0], shown);
    const std::vector<Bytes> composed = exchange_.all_to_all(to_first);
    if (!is_first()) return;
    for (std::size_t r = 0; r < ranks; ++r)
        if (!composed[r].empty())
            std::memcpy(&colors[range_of(r, ranks, depths.size()).first], composed[r].data(), composed[r].size());
}

PartDrawing::PartDrawing(World& world, std::unique_ptr<host::Canvas> canvas)
    : world_(world), parts_(world.runner().ranks()->exchange()), canvas_(std::move(canvas)) {}

std::unique_ptr<PartDrawing> PartDrawing::make(World& world, const host::CanvasOptions& options) {
    std::unique_ptr<host::Canvas> canvas;
    try {
        canvas = host::make_gl_canvas({}, options);
        if (!canvas->draws_parts()) canvas.reset();
    } catch (const host::DeviceError&) {  // some rank has none: all draw whole pictures, which tell why
    }
    if (!all_ranks(world.runner().ranks()->exchange(), canvas != nullptr)) return nullptr;
    return std::unique_ptr<PartDrawing>(new PartDrawing(world, std::move(canvas)));
}

PartDrawing::Moment PartDrawing::look(std::optional<std::size_t> followed) const {
    struct Told {
        Moment moment;
        bool follows = false;
    } own;
    const State& state = world_.share()->state;
    for (std::uint32_t k = 0; k < state.counted().contacts; ++k) own.moment.contacts += state.owns_contact(state.contacts[k]);
    if (followed)
        if (const std::uint32_t row = state.row_of(*followed); row != physics::NONE && state.is_stepped(row)) {
            own.moment.followed = state.poses[row].position;
            own.follows = true;
        }
    Bytes sent;
    append_values<Told>(sent, std::span(&own, 1));
    Moment all;
    for (const Bytes& one : world_.runner().ranks()->exchange().all_gather(sent)) {
        const auto received = value_at<Told>(one, 0);
        all.contacts += received.moment.contacts;
        if (received.follows) all.followed = received.moment.followed;
    }
    return all;
}

host::Image PartDrawing::draw(const host::Camera& camera, const host::ColorScale& scale, const std::string& caption, vec3 low,
                              vec3 high) {
    const World::Share share = *world_.share();
    canvas_->set_bodies(instances_of(share, parts_.is_first()));
    canvas_->set_tables(tables_of(share.state));
    return canvas_->draw_part(camera, scale, caption, low, high, parts_);
}

}  // namespace scree::demos
