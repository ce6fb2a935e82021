// Recordings that play in any browser: one page with the viewer (demos/viewer) and the run's frames, chunk by chunk.
//
//     PageRecording page("run.html", world, {.title = "my run"});
//     while (...) { world.step(); page.after_step(); }
//     page.finish();
//
// Or in memory, where page() is what there is so far; or live, for viewers that show what happens now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/scene_file/picture_style.h"
#include "compute/world.h"
#include "demos/program/copies.h"
#include "host/canvas/camera.h"
#include "host/canvas/colors.h"

namespace scree::demos {

struct PageOptions {
    std::string title;
    double fps = 30;           // frames a simulated second; steps between them are a whole number
    host::ColorScale scale{};  // how the page begins
    std::vector<std::pair<host::ColorBy, std::pair<float, float>>> ranges{};  // of other quantities that the page offers
    PictureStyle style{};                                                     // its light and what it shows
    host::vec3 toward_sun{-0.52f, 0.74f, 0.43f};
    host::vec3 low{-5, 0, -5}, high{5, 5, 5};              // corners of the action, m
    std::function<host::Camera(double seconds)> camera{};  // called with rising times; none: one that sees low to high
    bool events = true;                                    // hits and breaks; asks the world for events, which may cost time
    bool contacts = true;                                  // every point that touches
    CopiesShown shown{};
};

struct PageFigures {
    std::size_t frames = 0;
    std::uint64_t bytes = 0;      // of the page so far
    double seconds_encoding = 0;  // of frames, compression included
};

class PageRecording {
public:
    // Whether this program was built with the viewer; why not, else.
    static bool is_possible();
    static std::string why_not();

    // Records the beginning. Throws host::FileError, and std::logic_error where it is not possible.
    PageRecording(const std::filesystem::path& path, World& world, PageOptions options);
    // In memory: page() gives it as often as wanted.
    PageRecording(World& world, PageOptions options);
    // Keeps nothing: take() gives a live viewer its chunks. Possible in every program.
    static std::unique_ptr<PageRecording> live(World& world, PageOptions options);
    ~PageRecording();  // nothing is left of what was not finished
    PageRecording(const PageRecording&) = delete;
    PageRecording& operator=(const PageRecording&) = delete;

    int steps_until_due() const;
    void after_step();             // records if it is due
    void finish();                 // the page appears under its name
    std::string page() const;      // one in memory, as if it ended now; also after the world's end
    std::string take(bool frame);  // of a live one: what is new in the scene, at first all, and a frame of now
    PageFigures figures() const;

private:
    PageRecording();
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
