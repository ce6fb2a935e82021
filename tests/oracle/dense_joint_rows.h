// Rows of the dense joint problem: Jacobians and drifts by numerical differentiation, and the matrix J M^-1 J^T.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "tests/oracle/dense_joints.h"

namespace scree::oracle {

// A row of the Jacobian J: coefficients of linear and angular velocity of both bodies.
struct DenseJacobian {
    glm::dvec3 linear_a{0}, angular_a{0}, linear_b{0}, angular_b{0};
    double speed(const DenseBody& a, const DenseBody& b) const {
        return glm::dot(linear_a, a.velocity) + glm::dot(angular_a, a.spin) + glm::dot(linear_b, b.velocity) +
               glm::dot(angular_b, b.spin);
    }
};

struct DenseRow {
    std::size_t joint = 0, axis = 0;
    DenseJacobian jacobian;
    double place = 0, drift = 0, speed = 0;
    double give = 0;  // diagonal entry of J M^-1 J^T
};

DenseRow dense_row(const std::vector<DenseBody>& bodies, const DenseJoint& joint, std::size_t index, std::size_t axis, double h);

// M^-1 J^T of a row, for one body.
struct DensePush {
    glm::dvec3 velocity{0}, spin{0};
};
DensePush dense_response(const DenseBody& body, const glm::dvec3& linear, const glm::dvec3& angular);

// An entry of J M^-1 J^T, with split masses.
double dense_entry(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints, const DenseRow& left,
                   const DenseRow& right);

}  // namespace scree::oracle
