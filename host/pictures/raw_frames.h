// Frames as bare pixels, for another program to read through a pipe.
#pragma once

#include <filesystem>
#include <memory>

#include "host/pictures/image.h"

namespace scree::host {

// Rows from the top, red, green and blue, a byte each (ffmpeg's rgb24), or two in the machine's order for pictures of 16 bits
// (rgb48le); frame after frame with nothing between.
class RawFrames {
public:
    // "-" is the standard output; a pipe or a device is written in place; anything else becomes a file, which appears under its
    // name when it is whole. Throws ImageError.
    explicit RawFrames(const std::filesystem::path& path);
    ~RawFrames();  // an unfinished file is removed
    RawFrames(const RawFrames&) = delete;
    RawFrames& operator=(const RawFrames&) = delete;

    void add(const Image& image);  // waits for a slow reader; throws ImageError when it is gone
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
