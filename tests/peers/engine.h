// The race's interface to a simulator of scree scenes: Bullet, MuJoCo, Box3D, scree.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree::peers {

constexpr float step_seconds = 1.0f / 60;  // s, time step of every engine

struct Pose {
    vec3 position{0};              // m, of the centre
    vec4 orientation{0, 0, 0, 1};  // quaternion x, y, z, w
};

class Engine {
public:
    virtual ~Engine() = default;
    virtual std::string name() const = 0;         // name, version and device
    virtual void step() = 0;                      // one step of step_seconds
    virtual std::vector<Pose> poses() const = 0;  // of bodies in the scene's order; a plane's means nothing
    virtual std::size_t points() const = 0;       // contact points after the last step
};

// A scene that an engine cannot represent. The message says what is missing.
struct Unsupported : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// `scene` must be validated (compute/scene.h). Throw Unsupported for scenes that cannot be translated exactly.
// substeps 0: scree's default. contact_hertz: stiffness of contacts, at most an eighth of the substep rate; 0: Box3D's
// default. Bodies never sleep unless `sleeps`. Bullet divides a step into whole steps of its own, `substeps` of them.
std::unique_ptr<Engine> make_scree_on_processor(const Scene& scene, int threads, int substeps = 0);
std::unique_ptr<Engine> make_scree_on_device(const Scene& scene, int substeps = 0);  // the first Vulkan device
std::unique_ptr<Engine> make_bullet(const Scene& scene, int substeps = 1, bool sleeps = false);
#ifdef SCREE_PEER_MUJOCO
std::unique_ptr<Engine> make_mujoco(const Scene& scene);
#endif
#ifdef SCREE_PEER_BOX3D
std::unique_ptr<Engine> make_box3d(const Scene& scene, int substeps = 4, float contact_hertz = 0, bool sleeps = false);
#endif

}  // namespace scree::peers
