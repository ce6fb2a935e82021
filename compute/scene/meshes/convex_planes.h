// Supporting planes of a convex shape in many directions: a polytope around the shape, for cutting.
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
    void touch_around(double slope);  // planes around the y axis; slope: y over horizontal component of the normal
    // In 42 directions, or 162 if `fine`; each divided by the stretch, which gives the normals of a stretched ball.
    void touch_all_over(bool fine, glm::dvec3 stretch = glm::dvec3(1));

    std::vector<glm::dvec4> planes;  // xyz: outward unit normal; w: distance from the centre, m

private:
    const Shape& shape_;
};

}  // namespace scree
