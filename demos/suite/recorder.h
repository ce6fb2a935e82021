// Steps a world by its script, and remembers what the promise will be judged by.
#pragma once

#include "demos/scenes/script.h"
#include "demos/suite/promise.h"

namespace scree::demos {

class Recorder {
public:
    Recorder(World& world, const Promise& promise, Script before_step = {});
    double step();   // runs the script, makes one step and looks at it; returns what the step alone took, s
    Trace finish();  // looks at the end

private:
    void look();

    World& world_;
    const Promise& promise_;
    Script before_step_;
    Trace trace_;
};

}  // namespace scree::demos
