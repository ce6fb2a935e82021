// A video file or an animated picture, encoded by ffmpeg from frames sent through a pipe.
#pragma once

#include <filesystem>
#include <memory>

#include "host/pictures/image.h"

namespace scree::host {

enum class Clip {
    film,  // H.264 in MP4, readable by browsers; an odd width or height loses its last column or row
    gif,   // animated pictures that play again and again, at most 480 pixels wide and 15 frames a second
    webp,
};

struct VideoShape {
    int width = 1280;  // pixels, of the frames that are added
    int height = 720;
    int bits = 8;  // of a channel, as in Image
    double frames_per_second = 30;
    Clip clip = Clip::film;
};

class Video {
public:
    // Starts ffmpeg. Throws ImageError at once when ffmpeg is missing or the folder is not writable, or when the path is there
    // and not a file.
    Video(const std::filesystem::path& path, const VideoShape& shape);
    ~Video();  // an unfinished video is removed
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    void add(const Image& image);  // throws ImageError with what ffmpeg said
    void finish();                 // the file appears under its name only now

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
