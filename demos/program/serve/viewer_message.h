// What viewers ask for, read from their messages: JSON objects whose key "do" names the deed.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "demos/film/orbit_camera.h"

namespace scree::demos {

enum class Deed {
    // of every viewer
    seen,   // frames: so many in all
    watch,  // on: false while the page is hidden
    pace,   // fps: pictures a second that it wants at most
    take,   // to drive, where nobody does
    // of the driver
    yield,  // to drive no more
    pause,  // on
    step,
    restart,
    keep,     // the present state
    restore,  // the state that was kept
    go,       // step: on the time line
    speed,    // value: simulated seconds a second
    open,     // name, and bodies, 0 for its own
    set,      // gravity, substeps
    press,    // at, and body: grab it
    move,     // at
    release,
    wheel,    // clicks, while a body is held
    key,      // key, on: w, a, s, d or space
    ball,     // at: throw one
    box,      // likewise
    explode,  // at
    undo,
    remove,     // what is selected
    duplicate,  // likewise
    righten,    // the vehicle
    select,     // body, or none
};

struct PointerAt {
    Viewpoint view;  // of the page
    Extent extent;
    double x = 0, y = 0;  // pixels
};

struct ViewerMessage {
    Deed deed = Deed::seen;
    double number = 0;  // frames, fps, step, value, clicks
    bool on = false;
    std::string word{};  // name, key
    std::optional<std::size_t> body{};
    std::optional<std::size_t> bodies{};
    std::optional<glm::vec3> gravity{};
    std::optional<int> substeps{};
    std::optional<PointerAt> at{};
};

// Throws std::invalid_argument with the reason.
ViewerMessage viewer_message(const std::string& text);

}  // namespace scree::demos
