// The words with which a scene, or a change of one, is refused.
#pragma once

#include <string>

#include "compute/scene.h"

namespace scree::tests {

// Empty where `work` throws no SceneError.
std::string refusal_of(const auto& work) {
    try {
        work();
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

}  // namespace scree::tests
