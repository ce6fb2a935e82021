// Convex hull of points: vertices, faces and mass properties (qhull; Barber, Dobkin and Huhdanpaa, 1996).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace scree {

struct HullForm {
    struct Face {
        glm::dvec3 normal;                   // outward unit normal
        double distance;                     // from the origin, m
        std::vector<std::uint32_t> corners;  // counter-clockwise seen from outside
    };
    std::vector<glm::dvec3> vertices;  // m
    std::vector<Face> faces;
    double volume = 0;        // m^3
    glm::dvec3 centre{0};     // centre of mass, m
    glm::dmat3 inertia{0};    // about the centre of mass, for density 1, m^5
    bool simplified = false;  // it had more than MOST_CORNERS vertices; those that change it least were left out
};

// Points without a usable hull; what() gives the reason.
struct HullError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// The hull of at least four finite points (m), not coplanar; throws HullError. Inner and repeated points are ignored;
// faces coplanar to a ten thousandth of the size are merged.
HullForm hull_form(std::span<const glm::vec3> points);

// Principal axes of inertia as columns of a rotation, nearest to the given axes. The unit matrix if those are
// principal.
glm::dmat3 principal_axes(const glm::dmat3& inertia);

}  // namespace scree
