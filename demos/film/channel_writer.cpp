// Channels of the pictures of a run as files.
#include "demos/film/channel_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "demos/program/exit_status.h"
#include "host/files/npy_file.h"
#include "host/pictures/channel_files.h"

namespace scree::demos {

namespace {

constexpr float most = 65535;

std::uint16_t level(float value) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, most)));  // infinity becomes the most
}

std::vector<std::uint16_t> millimetres(const std::vector<float>& depth) {
    std::vector<std::uint16_t> made(depth.size());
    std::transform(depth.begin(), depth.end(), made.begin(),
                   [](float d) { return std::isinf(d) ? std::uint16_t{0} : std::max(level(1000 * d), std::uint16_t{1}); });
    return made;
}

std::vector<std::uint16_t> one_more(const std::vector<std::int32_t>& ids) {
    std::vector<std::uint16_t> made(ids.size());
    std::transform(ids.begin(), ids.end(), made.begin(), [](std::int32_t id) { return level(static_cast<float>(id) + 1); });
    return made;
}

std::vector<std::uint16_t> unit_levels(const std::vector<float>& normals) {
    std::vector<std::uint16_t> made(normals.size());
    for (std::size_t i = 0; i < normals.size(); i += 3) {
        if (normals[i] == 0 && normals[i + 1] == 0 && normals[i + 2] == 0) continue;
        for (std::size_t k = i; k < i + 3; ++k) made[k] = level((normals[k] + 1) * 0.5f * most);
    }
    return made;
}

// As in the KITTI data set: 64 levels a pixel, 32768 for none, and a third channel that says where it is known.
std::vector<std::uint16_t> flow_levels(const std::vector<float>& flow) {
    std::vector<std::uint16_t> made(flow.size() / 2 * 3);
    for (std::size_t i = 0; i < flow.size() / 2; ++i) {
        if (!std::isfinite(flow[2 * i]) || !std::isfinite(flow[2 * i + 1])) continue;
        for (std::size_t k = 0; k < 2; ++k) made[3 * i + k] = level(64 * flow[2 * i + k] + 32768);
        made[3 * i + 2] = 1;
    }
    return made;
}

}  // namespace

ChannelWriter::ChannelWriter(const PictureOptions& options, const World& world)
    : folder_(options.frames),
      choice_(channels_named(options.channels)),
      layers_(options.frame_files == "exr"),
      numpy_(!layers_ && options.channel_files != "png"),
      png_(!layers_ && options.channel_files != "npy"),
      width_(options.width),
      height_(options.height) {
    const std::size_t bodies = world.scene().bodies.size();
    if (png_ && choice_.body && bodies > 65535)
        throw UsageError(
            fmt::format("--channels ids: a PNG of 16 bits numbers 65535 bodies, and there are {}, pieces included; "
                        "say --channel-files npy",
                        bodies));
}

std::vector<host::ExrLayer> ChannelWriter::add(DrawnLabels& drawn, const host::Camera& camera) {
    const World& world = drawn.world();
    const Before before{camera_before_.value_or(camera), static_cast<float>(camera_before_ ? world.time() - time_before_ : 0)};
    const Channels made = drawn.channels(camera, width_, height_, choice_, before);
    if (numpy_) write_numpy(made);
    if (png_) write_png(made);
    camera_before_ = camera;
    time_before_ = world.time();
    ++count_;
    return layers_ ? layers(made) : std::vector<host::ExrLayer>{};
}

std::vector<host::ExrLayer> ChannelWriter::layers(const Channels& made) const {
    std::vector<host::ExrLayer> all;
    // The numbers of a pixel lie side by side, one for each letter.
    const auto put = [&](const std::string& layer, const std::string& letters, const auto& values) {
        for (std::size_t k = 0; k < letters.size(); ++k) {
            host::ExrLayer& one = all.emplace_back();
            one.name = layer + letters[k];
            for (std::size_t i = k; i < values.size(); i += letters.size()) one.values.push_back(static_cast<float>(values[i]));
        }
    };
    if (choice_.depth) put("", "Z", made.depth);
    if (choice_.body) put("ids.", "X", made.body);
    if (choice_.part) put("parts.", "X", made.part);
    if (choice_.normal) put("normals.", "XYZ", made.normal);
    if (choice_.flow) put("flow.", "XY", made.flow);
    return all;
}

std::filesystem::path ChannelWriter::file(const char* channel, const char* ending) const {
    return folder_ / fmt::format("{}_{:06}.{}", channel, count_, ending);
}

void ChannelWriter::write_numpy(const Channels& made) const {
    const auto height = static_cast<std::size_t>(height_), width = static_cast<std::size_t>(width_);
    const std::array<std::size_t, 2> plain{height, width};
    const std::array<std::size_t, 3> of_two{height, width, 2}, of_three{height, width, 3};
    if (choice_.depth) host::write_npy(file("depth", "npy"), made.depth, plain);
    if (choice_.body) host::write_npy(file("ids", "npy"), made.body, plain);
    if (choice_.part) host::write_npy(file("parts", "npy"), made.part, plain);
    if (choice_.normal) host::write_npy(file("normals", "npy"), made.normal, of_three);
    if (choice_.flow) host::write_npy(file("flow", "npy"), made.flow, of_two);
}

void ChannelWriter::write_png(const Channels& made) const {
    const auto write = [&](const char* channel, int channels, const std::vector<std::uint16_t>& values) {
        host::write_png16(file(channel, "png"), width_, height_, channels, values);
    };
    if (choice_.depth) write("depth", 1, millimetres(made.depth));
    if (choice_.body) write("ids", 1, one_more(made.body));
    if (choice_.part) write("parts", 1, one_more(made.part));
    if (choice_.normal) write("normals", 3, unit_levels(made.normal));
    if (choice_.flow) write("flow", 3, flow_levels(made.flow));
}

}  // namespace scree::demos
