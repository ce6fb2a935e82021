// A video file, encoded by ffmpeg from frames sent through a pipe.
#pragma once

#include <filesystem>
#include <memory>

#include "host/image.h"

namespace scree::host {

class Video {
public:
    // Starts ffmpeg (H.264, readable by browsers). Throws ImageError at once when ffmpeg is missing or the folder is not
    // writable, or when the path is there and not a file. An odd width or height loses its last column or row.
    Video(const std::filesystem::path& path, int width, int height, double frames_per_second);
    ~Video();  // an unfinished video is removed
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    void add(const Image& image);  // throws ImageError with what ffmpeg said
    void finish();                 // the file appears under its name only now

private:
    struct Interior;
    std::unique_ptr<Interior> interior_;
};

}  // namespace scree::host
