// Channels of the pictures of a run as files, beside its frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/film/drawn_labels.h"
#include "demos/program/options/options.h"
#include "host/pictures/exr_file.h"

namespace scree::demos {

class ChannelWriter {
public:
    // Throws UsageError for bodies that a PNG's 16 bits cannot number.
    ChannelWriter(const PictureOptions& options, const World& world);
    // Writes the channels of what is drawn, DIR/depth_000000.npy and so on, or returns them as layers of the frame's EXR
    // file. Throws host::DeviceError, host::FileError, host::ImageError.
    std::vector<host::ExrLayer> add(DrawnLabels& drawn, const host::Camera& camera);

private:
    void write_numpy(const Channels& made) const;
    void write_png(const Channels& made) const;
    std::vector<host::ExrLayer> layers(const Channels& made) const;
    std::filesystem::path file(const char* channel, const char* ending) const;

    std::filesystem::path folder_;
    ChannelChoice choice_;
    bool layers_, numpy_, png_;
    int width_, height_;
    int count_ = 0;
    std::optional<host::Camera> camera_before_;
    double time_before_ = 0;  // s
};

}  // namespace scree::demos
