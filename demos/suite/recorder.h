// Steps a world with its script and records the trace that its promise needs.
#pragma once

#include "demos/scenes/script.h"
#include "demos/suite/promise.h"

namespace scree::demos {

class Recorder {
public:
    // `seconds`: how long the run takes, simulated, to know when its last seconds begin.
    Recorder(World& world, const Promise& promise, double seconds, Script before_step = {});
    double step();   // runs the script and one step, and records; returns the step's duration alone, s
    Trace finish();  // records the final state

private:
    void look();

    World& world_;
    const Promise& promise_;
    double seconds_;
    Script before_step_;
    Trace trace_;
};

}  // namespace scree::demos
