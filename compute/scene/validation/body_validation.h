// Validation of one body of a scene after the other.
#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "compute/scene/validation/shape_validation.h"

namespace scree {

// Remembers the shapes of bodies checked before, which equal ones share.
class BodyValidation {
public:
    explicit BodyValidation(std::vector<std::string>* notes = nullptr) : notes_(notes) {}
    // Checks and completes a body as checked() (compute/scene.h) does, but for its fragments. Returns how far its frame has
    // moved. Throws SceneError, with the body's index. A mesh must stay where it is.
    Shift check(Body& body, std::size_t index);
    // Of a body that does not stay.
    Shift check_passing(Body& body, std::size_t index);

private:
    CheckedShapes shapes_;
    std::list<Mesh> meshes_;  // of bodies that did not stay, one of each kind
    std::vector<std::string>* notes_;
};

}  // namespace scree
