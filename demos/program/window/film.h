// A video of what the window shows, without its panel.
#pragma once

#include <memory>
#include <string>

#include "compute/scene_file/picture_style.h"
#include "demos/film/drawing.h"
#include "demos/film/orbit_camera.h"
#include "host/pictures/frame_writer.h"
#include "host/window/window.h"

namespace scree::demos {

// 30 pictures for each simulated second, from when it begins until the destructor, or until it is shown another world.
class Film {
public:
    // `beginning`: the world's number (Session::beginnings). Throws as Drawing and FrameWriter do.
    Film(std::string file, Extent extent, const PictureStyle& style, const Backend& machine, World& world,
         std::uint64_t beginning);

    bool is_of(std::uint64_t beginning) const { return beginning_ == beginning; }
    void look(const World& world, const host::View& view);  // after each picture of the window; draws if one is due
    void finish();                                          // throws the first error of the encoder
    const std::string& file() const { return file_; }
    int pictures() const { return writer_.frames(); }

private:
    std::string file_;
    host::FrameWriter writer_;
    Drawing drawing_;
    std::uint64_t beginning_;
    double next_;  // s, time of the next picture
};

}  // namespace scree::demos
