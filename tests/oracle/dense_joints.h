// One pass of the joint solver as a dense problem in double precision, the oracle of the block solver on CPU and
// device.
//
// A joint holds coordinates C_k(q) of body B against body A: three distances along A's axes (or the distance between the
// anchors), the twist and the swing. Everything follows from these functions. The Jacobian J = dC/dq and the second
// derivative of C along the bodies' motion are differences of C, taken numerically. A pass seeks impulses l so that
// the velocities v + M^-1 J^T dl meet every row's law (Anitescu and Potra, Nonlinear Dynamics 14, 1997; Catto, Soft
// Constraints, GDC 2011):
//   locked    J v + b + g l = 0
//   limited   J v + b + g l >= 0, l >= 0, one of them 0                    (a linear complementarity problem)
//   motor     J v + b + g l = 0 while |l| <= L, else l = -L or L           (box constraints)
//   spring    Hooke's and the damper's law, by implicit Euler while |l| <= L
// All rows of a block are solved in one dense matrix, J M^-1 J^T, by Gaussian elimination with row exchanges, inside
// principal pivoting that falls back to Murty's rule of the least index (Cottle, Pang, Stone, The Linear
// Complementarity Problem, 1992, ch. 4), until every row's law is met.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace scree::oracle {

struct DenseBody {
    glm::dvec3 position{0};  // m
    glm::dquat orientation{1, 0, 0, 0};
    glm::dvec3 velocity{0};         // m/s
    glm::dvec3 spin{0};             // rad/s
    double inverse_mass = 0;        // 1/kg; 0 unless dynamic
    glm::dvec3 inverse_inertia{0};  // principal, 1/(kg m^2)
    double split =
        1;  // mass splitting: the block solves with inverse mass split / m, and the body receives the impulse with 1 / m
};

struct DenseAxis {
    enum class Drive { none, lock, motor, spring };
    Drive drive = Drive::none;
    double rest = 0;       // m or rad, equilibrium of a lock or spring
    double stiffness = 0;  // N/m or N m/rad
    double damping = 0;    // N s/m or N m s/rad
    double speed = 0;      // m/s or rad/s, target of a motor
    double max_force = 0;  // N or N m, limit of a motor or spring
    bool limited = false;
    double lower = 0, upper = 0;  // m or rad
    double drive_impulse = 0;     // N s or N m s, at the begin of the pass
    double stop_impulse = 0;      // likewise; positive at the lower limit
};

constexpr std::size_t no_dense_body = static_cast<std::size_t>(-1);  // the world

struct DenseJoint {
    std::size_t a = no_dense_body, b = no_dense_body;
    glm::dvec3 anchor_a{0}, anchor_b{0};  // in the body's frame, m
    glm::dquat frame_a{1, 0, 0, 0}, frame_b{1, 0, 0, 0};
    bool radial = false;  // axis 0 is the distance between the anchors
    bool cone = false;    // axis 4 is the total swing
    bool spins = false;   // rotation about B's own x axis is no swing
    std::array<DenseAxis, 6> axes{};
};

// Distances along A's axes, m; twist, swing about y, swing about z, rad.
std::array<double, 6> coordinates(const DenseJoint& joint, const DenseBody& a, const DenseBody& b);

struct DensePass {
    bool biased = true;
    double h = 0;           // s, substep
    double push_speed = 3;  // m/s, maximum speed of drift correction
};

struct DenseImpulses {
    std::array<double, 6> drive{}, stop{};
};
// Branch of a row's law: drive within its bounds, at a bound, or at a limit.
enum class DenseBranch { drive, drive_low, drive_high, stop_low, stop_high };
using DenseBranches = std::vector<std::array<DenseBranch, 6>>;  // per joint and axis
struct DenseSolution {
    std::vector<DenseImpulses> joints;  // after the pass
    std::vector<glm::dvec3> velocity;   // velocity change of each body, m/s
    std::vector<glm::dvec3> spin;       // rad/s
    bool solved = false;                // every row's law is met
};
DenseSolution solve_densely(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints, const DensePass& pass);
// Solves the linear equations for given branches, whether or not these satisfy the laws.
DenseSolution solve_densely_on(const DenseBranches& branches, const std::vector<DenseBody>& bodies,
                               const std::vector<DenseJoint>& joints, const DensePass& pass);

// Applies impulses along the joints' axes to whole bodies: M^-1 J^T l, in velocity and spin.
DenseSolution push_densely(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints,
                           const std::vector<DenseImpulses>& impulses);

}  // namespace scree::oracle
