// The joint that leaves some of six axes free.
#include "compute/scene_file/import/joint_axes.h"

#include <algorithm>

namespace scree::imports {

JointKind joint_of(const JointAxes& axes, glm::dquat& turn) {
    int free_linear = -1, free_angular = -1, count = 0;
    for (int k = 0; k < 3; ++k) {
        if (!axes.linear[k].locked) free_linear = k, ++count;
        if (!axes.angular[k].locked) free_angular = k, ++count;
    }
    if (count == 0) return Fixed{};
    if (count == 1) {
        const int k = std::max(free_linear, free_angular);
        glm::dmat3 cycled(0);  // its axis first, the others in order
        for (int i = 0; i < 3; ++i) cycled[i][(k + i) % 3] = 1;
        turn = glm::normalize(turn * glm::quat_cast(cycled));
        if (free_angular >= 0) return Hinge{axes.angular[k]};
        return Slider{axes.linear[k]};
    }
    return SixDof{axes.linear[0], axes.linear[1], axes.linear[2], axes.angular[0], axes.angular[1], axes.angular[2]};
}

}  // namespace scree::imports
