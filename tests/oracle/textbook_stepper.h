// A simple rigid body stepper in double precision from textbook impulse formulas, the simulator's oracle.
//
// Semi-implicit Euler in small substeps; contacts by projected Gauss-Seidel to convergence; restitution by j = -(1+e)
// v_rel.n / (1/m_a + 1/m_b + n.[(I_a^-1 (r_a x n)) x r_a + (I_b^-1 (r_b x n)) x r_b]) and Coulomb friction |j_t| <=
// mu j.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "compute/scene.h"
#include "tests/oracle/textbook_contacts.h"

namespace scree::oracle {

struct TextbookOptions {
    double substep = 1.0 / 2000;       // s
    int iterations = 400;              // maximum Gauss-Seidel iterations; ends early when no impulse changes
    double restitution_threshold = 1;  // m/s, no restitution below (Settings::restitution_threshold)
};

struct TextbookBody {
    TextbookPose pose;
    glm::dvec3 velocity{0};          // m/s
    glm::dvec3 angular_velocity{0};  // rad/s, world
    double mass = 0;                 // kg; 0 unless dynamic
    glm::dvec3 inertia{0};           // principal, body frame, kg m^2
};

class TextbookStepper {
public:
    // Throws std::invalid_argument for unsupported features: damping, rolling resistance.
    explicit TextbookStepper(const Scene& scene, const TextbookOptions& options = {});

    // Simulates `seconds`, rounded to whole substeps.
    void run(double seconds);

    const std::vector<TextbookBody>& bodies() const { return bodies_; }
    double kinetic_energy() const;        // J
    glm::dvec3 momentum() const;          // kg m/s
    glm::dvec3 angular_momentum() const;  // kg m^2/s, about the origin

private:
    // A contact point with its accumulated impulses.
    struct Contact {
        std::size_t a, b;
        glm::dvec3 normal, arm_a, arm_b;
        double friction;
        double least_speed;      // m/s, minimum separating speed along the normal
        double impulse = 0;      // N s
        glm::dvec3 sideways{0};  // N s, friction
    };

    void substep();
    std::vector<Contact> find_contacts() const;
    bool solve(Contact& contact);
    void apply(const Contact& contact, glm::dvec3 impulse);
    void move();
    void separate();

    double inverse_mass(std::size_t body) const;
    glm::dvec3 turn_by(std::size_t body, glm::dvec3 angular_impulse) const;  // I^-1 L
    glm::dvec3 relative_velocity(const Contact& contact) const;              // velocity of B relative to A at the point
    double response(const Contact& contact, glm::dvec3 direction) const;     // inverse effective mass, 1/kg

    Scene scene_;
    TextbookOptions options_;
    std::vector<TextbookBody> bodies_;
};

}  // namespace scree::oracle
