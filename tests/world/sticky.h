// A scene of tests whose bodies and parts are cohesive.
#pragma once

#include <variant>

#include "compute/scene.h"
#include "tests/world/belts.h"

namespace scree::tests {

inline Scene sticky(Scene scene, float cohesion) {
    for (Body& body : scene.bodies) {
        body.cohesion = cohesion;
        if (auto* compound = std::get_if<Compound>(&body.shape))
            for (Part& part : compound->parts)
                if (part.material) part.material->cohesion = cohesion;
    }
    return scene;
}

}  // namespace scree::tests
