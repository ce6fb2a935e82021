// A video file or an animated picture, encoded by ffmpeg from frames sent through a pipe.
#pragma once

#include <filesystem>
#include <memory>

#include "host/pictures/image.h"

namespace scree::host {

enum class Clip {
    film,  // H.264 in MP4, readable by browsers; an odd width or height loses its last column or row
    gif,   // looping animations of at most 480 pixels width and 15 frames per second
    webp,
};

struct VideoShape {
    int width = 1280;  // pixels, of the input frames
    int height = 720;
    int bits = 8;  // per channel, as in Image
    double frames_per_second = 30;
    Clip clip = Clip::film;
};

class Video {
public:
    // Starts ffmpeg. Throws ImageError when ffmpeg is missing, the folder is not writable, or the path exists and is
    // no regular file.
    Video(const std::filesystem::path& path, const VideoShape& shape);
    ~Video();  // an unfinished video is removed
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    void add(const Image& image);  // throws ImageError with ffmpeg's error output
    void finish();                 // waits for ffmpeg and renames the file to its final path

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
