// Pictures of a run: at fixed moments of simulated time, from one camera, in colours that mean the same from first to last.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/world.h"
#include "demos/program/backend.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options.h"

namespace scree::demos {

// Where the time of the one who simulates went, s.
struct PictureTimes {
    double draw = 0;         // until the device had drawn, and the picture was here
    double encode_wait = 0;  // until the encoders, which work beside it, had room; and at the end until they were done
};

class Pictures {
public:
    // Throws before anything is simulated if the folder, the video or the device will not do.
    Pictures(const PictureOptions& options, const Backend& machine, const LoadedScene& subject, World& world);
    ~Pictures();
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

    void after_step();  // draws if a picture is due; also before the first step
    void finish();      // waits until all is written, and throws what went wrong there
    int count() const;
    PictureTimes times() const;
    std::string canvas() const;  // for people: what draws them, and on which device

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// The colours that the options ask for. Throws UsageError for a logarithmic scale that begins at 0.
host::ColorScale scale_of(const PictureOptions& options, const LoadedScene& subject, const Settings& settings);

// The words of --color and --color-map.
const std::vector<std::string>& color_words();
const std::vector<std::string>& color_map_words();

}  // namespace scree::demos
