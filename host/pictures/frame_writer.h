// Frames to PNG files, to a video, to an animated preview and as bare pixels, encoded beside the simulation.
#pragma once

#include <filesystem>
#include <memory>

#include "host/pictures/image.h"

namespace scree::host {

struct FrameWriterOptions {
    std::filesystem::path folder{};   // frame_000000.png, ... are written here; empty: no files
    std::filesystem::path video{};    // an .mp4 file; empty: no video
    std::filesystem::path preview{};  // a small animated picture, .gif or .webp; empty: none
    std::filesystem::path raw{};      // frames as they are (host/pictures/raw_frames.h): a file, a pipe or "-"; empty: none
    double frames_per_second = 60;
    int width = 1280;  // pixels
    int height = 720;  // pixels
    int bits = 8;      // of a channel, 8 or 16
    int threads = 0;   // PNG encoders; 0: one, or two when there are more than four processors
    int waiting = 6;   // frames held at most before add() waits; bounds memory
};

class FrameWriter {
public:
    // Makes the folder. Throws ImageError now for what can be known now: an unwritable place, frames that are there already,
    // no ffmpeg, a video or preview of an unknown kind.
    explicit FrameWriter(const FrameWriterOptions& options);
    ~FrameWriter();  // finishes what waits, and stays silent about errors; without a frame it leaves no file
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    void add(Image image);  // the next frame; waits while too many are held; throws the first error of the encoders
    void finish();          // waits until all is on disk; throws the first error
    int frames() const;     // added so far

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
