// Where a world is drawn: the choice between the two canvases, and the tables that the chosen one draws from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "compute/world.h"
#include "demos/program/backend.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

// Which bodies have which shape.
host::ShapeInstances instances_of(const World& world);
// What a canvas draws from where a world is simulated on the processor.
host::BodyTables tables_of(const State& state);

class Drawing {
public:
    // `canvas` is a word of --canvas. Throws UsageError where there is no such canvas, saying what to install.
    Drawing(const std::string& canvas, const Backend& machine, World& world, const host::CanvasOptions& options);

    host::Canvas& canvas() { return *canvas_; }
    void update();                   // the next picture shows the world as it is now, with the bodies that were added
    std::uint32_t contacts() const;  // in the world at the last update
    vec3 position_of(std::size_t body) const;
    // Whether a picture may be drawn while the next steps are made: not where both stand in one queue, for the steps would only
    // wait for it, and their time would be told as longer than it is.
    bool beside_steps() const { return !from_device_; }

private:
    std::unique_ptr<host::Canvas> make_canvas() const;

    World& world_;
    std::string word_;
    Backend machine_;
    host::CanvasOptions options_;
    std::size_t bodies_ = 0;  // that the canvas knows, and where
    std::uint64_t reorderings_ = 0;
    std::unique_ptr<host::Canvas> canvas_;
    bool from_device_ = false;  // draws from the very tables that the device works on
    std::uint32_t contacts_ = 0;
};

}  // namespace scree::demos
