// Fracture: cutting a body into fragments when the scene is checked.
//
// The fragments' masses, centres of mass and inertias sum to the body's, to a few parts in a million: fragments moving
// as parts of the rigid body have its momentum. A round body is cut as a polytope around it, which is then stretched by
// a percent or so until its moments of inertia match.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "compute/scene.h"

namespace scree {

// The fragments of a body; shared by equal bodies.
struct Cut {
    // Bodies of a checked scene in the body's frame: position (m) and orientation from its centre, density relative to
    // the body's. A fragment that may break in turn has its own cut.
    std::vector<Body> pieces;
    std::size_t all = 0;  // fragments, and those of fragments
};

// A body that cannot be cut; what() gives the reason, `key` the member of Fracture.
struct FractureError : std::runtime_error {
    FractureError(const char* member, const std::string& reason) : std::runtime_error(reason), key(member) {}
    const char* key;
};

// Cache of cuts by shape and fracture.
class Cuts {
public:
    // The cut of a checked body's shape. Throws FractureError.
    std::shared_ptr<const Cut> of(const Shape& shape, const Fracture& fracture);

private:
    std::map<std::vector<double>, std::shared_ptr<const Cut>> made_;
};

// Appends the fragments, on all levels, of all breakable bodies that have none yet. Throws SceneError.
void add_pieces(Scene& scene);

// Indices of the fragments of a body of a checked scene, on all levels below it.
std::vector<std::size_t> fragments_of(const Scene& scene, std::size_t body);

// The body without relations to fragments or to the body it is a fragment of.
Body on_its_own(Body body);

}  // namespace scree
