// Raw video frames, for another program to read through a pipe.
#pragma once

#include <filesystem>
#include <memory>

#include "host/pictures/image.h"

namespace scree::host {

// Format: rows from the top, RGB interleaved, 8 bits per channel (ffmpeg's rgb24) or 16 in native byte order
// (rgb48le); frames are concatenated without headers.
class RawFrames {
public:
    // "-" is the standard output; a pipe or a device is written in place; any other path is a file that appears when
    // finish() completes. Throws ImageError.
    explicit RawFrames(const std::filesystem::path& path);
    ~RawFrames();  // an unfinished file is removed
    RawFrames(const RawFrames&) = delete;
    RawFrames& operator=(const RawFrames&) = delete;

    void add(const Image& image);  // blocks on a slow reader; throws ImageError when the reader has closed the pipe
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
