// What changes in the tables of a state between two steps: dials, bodies, joints.
#pragma once

#include <cstddef>
#include <optional>

#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/step/state.h"

namespace scree {

class StateEditor {
public:
    explicit StateEditor(State& state) : state_(state) {}

    // What may change between steps, into the parameters (grips, which depend on the substeps, are the caller's to make anew).
    // Impulses that last are those of a substep; those of the last step are brought to the new length of one. They, and
    // everything else that lasts, must be here (Runner::fetch), and the runner be attached again, if the substeps change.
    void tune(vec3 gravity, const Settings& settings);
    // One more body, the last; the rows of parts move up behind it. Everything that lasts must be here, and the runner be
    // attached again.
    void add(const Body& body);
    // The joints are the scene's: those that were here, but for the one at `without`, and then others. The same holds.
    void rejoin(const Scene& scene, std::optional<std::size_t> without = std::nullopt);

private:
    State& state_;
};

}  // namespace scree
