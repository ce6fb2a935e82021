// Frame output as PNG files, video, animated preview and raw pixels, encoded on threads of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/pictures/exr_file.h"
#include "host/pictures/image.h"

namespace scree::host {

struct FrameWriterOptions {
    std::filesystem::path folder{};   // of frame_000000.png, ...; empty: no files
    std::string name = "frame_";      // how these begin; may be empty
    std::filesystem::path video{};    // an .mp4 file; empty: no video
    std::filesystem::path preview{};  // small animated .gif or .webp; empty: none
    std::filesystem::path raw{};      // raw frames (host/pictures/raw_frames.h): a file, a pipe or "-"; empty: none
    double frames_per_second = 60;
    int width = 1280;        // pixels
    int height = 720;        // pixels
    int bits = 8;            // per channel, 8 or 16
    int threads = 0;         // PNG encoders; 0: one, or two when there are more than four processors
    bool exr = false;        // frame_000000.exr instead of .png
    bool alpha = false;      // frames have alpha, by which their light is multiplied; videos and raw frames drop it
    bool overwrite = false;  // frames, channels and labels of an earlier run are removed from the folder, else refused
    int waiting = 6;         // queue length at which add() blocks; bounds memory
};

class FrameWriter {
public:
    // Creates the folder. Throws ImageError for an unwritable path, frames that already exist, missing ffmpeg, or an
    // unknown file extension of video or preview.
    explicit FrameWriter(const FrameWriterOptions& options);
    ~FrameWriter();  // finishes queued frames and ignores errors; leaves no file if no frame was added
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    // Queues the next frame; blocks while the queue is full; throws the encoders' first error. `layers`: of its EXR file.
    void add(Image image, std::vector<ExrLayer> layers = {});
    void finish();       // waits until everything is on disk; throws the encoders' first error
    int frames() const;  // added so far

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
