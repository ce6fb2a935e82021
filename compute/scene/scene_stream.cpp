// Scenes whose bodies come one after the other.
#include "compute/scene_stream.h"

#include <utility>

namespace scree {

void StreamedScene::for_each_body(const TakeBody& take) const {
    for (const Body& body : scene.bodies) take(body);
    if (others) others(take);
}

Scene StreamedScene::whole() const {
    Scene all = scene;
    if (others) others([&](Body body) { all.bodies.push_back(std::move(body)); });
    return all;
}

}  // namespace scree
