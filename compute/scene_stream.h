// A scene whose bodies are made, or read, one after the other: no rank of a world on several ranks (compute/distributed) needs
// to hold them all.
#pragma once

#include <functional>

#include "compute/scene.h"

namespace scree {

using TakeBody = std::function<void(Body)>;

struct StreamedScene {
    Scene scene;  // gravity, fields, joints and so on, and the first bodies
    // Calls take(body) for each further body, in the order of ids; may be null. Every rank calls it several times; it gives the
    // same bodies each time.
    std::function<void(const TakeBody& take)> others{};

    void for_each_body(const TakeBody& take) const;  // the first ones, then the others
    Scene whole() const;                             // with all bodies
};

}  // namespace scree
