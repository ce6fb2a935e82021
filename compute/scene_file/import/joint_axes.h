// A joint as what each of six axes may do.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree::imports {

struct JointAxes {
    Axis linear[3], angular[3];
};
// One free axis: a hinge or slider about or along x, to which the frame is turned.
JointKind joint_of(const JointAxes& axes, glm::dquat& turn);

}  // namespace scree::imports
