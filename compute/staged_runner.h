// A runner whose step is led through its stages from outside: the device of a rank in a distributed world (compute/distributed).
#pragma once

#include "compute/runner.h"

namespace scree {

class StagedRunner : public Runner {
public:
    // Begins a step, or its repetition, with the state's parameters and actions.
    virtual void begin_step() = 0;
    // Goes on with the step after adapt() within it.
    virtual void resume_step() = 0;
    // Runs the plan's stages from `first` up to `last`, and waits for them; upload() and download() may come in between. An
    // overflow is noted in the table of counts, and later stages then do nothing.
    virtual void run_stages(std::size_t first, std::size_t last) = 0;
};

}  // namespace scree
