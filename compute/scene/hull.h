// The convex hull of points: its corners, faces and mass, about its centre of mass (qhull, Barber, Dobkin and Huhdanpaa, 1996).
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
        glm::dvec3 normal;                   // outward, unit
        double distance;                     // from the origin, m
        std::vector<std::uint32_t> corners;  // counter-clockwise seen from outside
    };
    std::vector<glm::dvec3> vertices;  // m
    std::vector<Face> faces;
    double volume = 0;        // m^3
    glm::dvec3 centre{0};     // of mass, m
    glm::dmat3 inertia{0};    // about it, for a density of 1, m^5
    bool simplified = false;  // it had more corners than MOST_CORNERS; some were left out, those that change it least
};

// Points that have no hull to simulate; what() says why.
struct HullError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// Of at least four finite points (m), not in one plane. Inner and repeated points do not matter; faces that lie in one plane to a
// ten thousandth of its size are one.
HullForm hull_form(std::span<const glm::vec3> points);

// Principal axes of inertia as the columns of a rotation, those nearest to the axes that the form has. The unit matrix where its
// own axes are principal already.
glm::dmat3 principal_axes(const glm::dmat3& inertia);

}  // namespace scree
