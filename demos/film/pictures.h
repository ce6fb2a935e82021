// Pictures of a run at a fixed rate of simulated time, with one camera and a fixed colour scale.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/scene_file/picture_style.h"
#include "compute/world.h"
#include "demos/program/backend.h"
#include "demos/program/copies.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"

namespace scree::demos {

// Time that the simulating thread spent on pictures, s.
struct PictureTimes {
    double draw = 0;         // drawing and reading back
    double encode_wait = 0;  // waiting for the encoding threads
};

class Pictures {
public:
    // Throws if the folder, the video or the device is not usable. On several ranks (compute/distributed) all have one with the
    // same options and call the same functions; the first writes. While the world is shared out, each rank draws its own bodies
    // where that can be (PartDrawing), and otherwise the first rank draws the whole world.
    Pictures(const PictureOptions& options, const Backend& machine, const LoadedScene& subject, World& world,
             const CopiesShown& shown = {});
    ~Pictures();
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

    void after_step();  // draws if a picture is due; call it before the first step, too
    void finish();      // waits until everything is written; throws the first error
    int count() const;
    PictureTimes times() const;
    std::string canvas() const;  // API and device, for messages

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Sets the overlays of a style, and what they need to know of the world.
void show_overlays(const PictureStyle& style, const World& world, host::CanvasOptions& canvas);

}  // namespace scree::demos
