// Steps a world with its script and records the trace that its promise needs.
#pragma once

#include "demos/scenes/script.h"
#include "demos/suite/promise.h"

namespace scree::demos {

class Recorder {
public:
    Recorder(World& world, const Promise& promise, Script before_step = {});
    double step();   // runs the script and one step, and records; returns the step's duration alone, s
    Trace finish();  // records the final state

private:
    void look();
    void keep_ending(Trace::Moment moment);  // and drops what is older than the last second

    World& world_;
    const Promise& promise_;
    Script before_step_;
    Trace trace_;
};

}  // namespace scree::demos
