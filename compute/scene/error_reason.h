// What a SceneError says of its place, for an error at another place.
#pragma once

#include <algorithm>
#include <string>

#include "compute/scene.h"

namespace scree {

// The message without the pointer before it.
inline std::string reason_of(const SceneError& error) {
    const std::string what = error.what();
    return error.pointer.empty() ? what : what.substr(std::min(what.size(), error.pointer.size() + 2));
}

}  // namespace scree
