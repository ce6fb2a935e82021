// Ten boxes fall onto one another; prints where the top one comes to lie.
#include <scree/compute/world.h>
#include <cstdio>
int main() {
    scree::Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = scree::Motion::fixed, .shape = scree::Plane{}});
    for (int i = 0; i < 10; ++i) {
        scree::Body box{.name = "box", .shape = scree::Box{{0.5f, 0.5f, 0.5f}}};
        box.position = {0.1f * float(i % 2), 0.5f + 1.01f * float(i), 0};
        scene.bodies.push_back(box);
    }
    scree::World world(scene);  // on the CPU, with all cores; a Vulkan device would give the same bits
    world.step(120);            // two seconds
    const scree::BodyState top = world.bodies().back();
    std::printf("after %.1f s the top box lies at %.3f %.3f %.3f; state %016llx\n", world.time(), top.position.x, top.position.y,
                top.position.z, static_cast<unsigned long long>(world.state_hash()));
}
