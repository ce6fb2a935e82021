// Planes that touch a shape in many directions, so that it can be cut as the inside of them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compute/scene.h"

namespace scree {

class TouchingPlanes {
public:
    explicit TouchingPlanes(const Shape& shape) : shape_(shape) {}

    void touch(glm::dvec3 direction);
    void touch_along_axes();
    void touch_around(double slope);  // the y axis: what rises by `slope` for each metre outward
    // In 42 directions, or 162 where it shall be `fine`; each divided by the stretch, as normals are of what is a ball before it
    // is stretched.
    void touch_all_over(bool fine, glm::dvec3 stretch = glm::dvec3(1));

    std::vector<glm::dvec4> planes;  // xyz: outward, unit; w: distance from the centre, m

private:
    const Shape& shape_;
};

}  // namespace scree
