// How a body comes apart: its pieces, cut when a scene is made.
//
// The pieces' masses add up to the body's, their centre of mass is its own, and so is their inertia together, to a few parts in a
// million: pieces that move as parts of a rigid body have its momentum. A round body is cut as a polytope around it, which is
// then stretched by a percent or so until its moments of inertia are those of the body.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "compute/scene.h"

namespace scree {

// Pieces of a body, which equal bodies share.
struct Cut {
    // As bodies of a checked scene in the frame of the body: position and orientation from its centre, the density that of a body
    // of density 1 kg/m^3. A piece that may break in its turn has its cut.
    std::vector<Body> pieces;
    std::size_t all = 0;  // pieces, and pieces of pieces
};

// A body that cannot be cut as it says; what() says why, and `key` of which of the fracture's members it comes.
struct FractureError : std::runtime_error {
    FractureError(const char* member, const std::string& reason) : std::runtime_error(reason), key(member) {}
    const char* key;
};

// Cuts that were made, by shape and fracture.
class Cuts {
public:
    // Of a checked body. Throws FractureError.
    std::shared_ptr<const Cut> of(const Shape& shape, const Fracture& fracture);

private:
    std::map<std::vector<double>, std::shared_ptr<const Cut>> made_;
};

// Adds the pieces of all bodies that may break and have none yet, the pieces' pieces included. Throws SceneError.
void add_pieces(Scene& scene);

// The body as one of its own, whatever it was a piece of or had as pieces.
Body on_its_own(Body body);

}  // namespace scree
