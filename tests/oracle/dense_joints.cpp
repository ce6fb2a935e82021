// Laws of the rows and the dense complementarity problem.
#include "tests/oracle/dense_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/oracle/dense_joint_rows.h"

namespace scree::oracle {

namespace {

using glm::dvec3;

// Parameters of the joint solver (explained in shaders/physics/joint/joint_axis.h).
constexpr double closed_part = 0.25;      // fraction of drift corrected per substep
constexpr double max_turn_speed = 6;      // rad/s, maximum speed of angular drift correction
constexpr double compliance_part = 1e-3;  // compliance of rigid rows, as a fraction of their inverse effective mass
constexpr double gentle = 0.25;           // softer springs act as explicit forces

using Matrix = std::vector<std::vector<double>>;

// Solves A x = y by Gaussian elimination with partial pivoting.
std::vector<double> solve_linear(Matrix a, std::vector<double> y) {
    const std::size_t n = y.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
        std::swap(a[k], a[pivot]);
        std::swap(y[k], y[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            if (factor == 0) continue;
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            y[i] -= factor * y[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) y[k] -= a[k][j] * y[j];
        y[k] /= a[k][k];
    }
    return y;
}

using Branch = DenseBranch;
bool is_stop(Branch branch) {
    return branch == Branch::stop_low || branch == Branch::stop_high;
}

// The linear equation of a row on its branch: J v + bias + compliance * (change of the impulse) = 0.
struct Equation {
    double bias = 0, compliance = 0;
};

class Laws {
public:
    Laws(const DenseAxis& axis, const DenseRow& row, const DensePass& pass)
        : axis_(axis), row_(row), pass_(pass), soft_(compliance_part * row.give), most_(axis.max_force * pass.h) {}

    bool is_gentle() const {
        return pass_.h * pass_.h * axis_.stiffness * row_.give < gentle && pass_.h * axis_.damping * row_.give < gentle;
    }
    // Whether the impulse of the drive is one of the unknowns.
    bool is_solved(Branch branch) const {
        if (axis_.drive == DenseAxis::Drive::lock) return true;
        if (branch != Branch::drive) return is_stop(branch);
        if (axis_.drive == DenseAxis::Drive::spring) return pass_.biased && !is_gentle();
        return axis_.drive == DenseAxis::Drive::motor;
    }
    // The drive's impulse where it is no unknown: at its maximum; a soft spring's explicit force; a spring at a stop
    // without play. In the relax pass springs keep their impulse.
    double given_drive(Branch branch) const {
        if (axis_.drive == DenseAxis::Drive::spring) {
            if (!pass_.biased) return axis_.drive_impulse;
            if (is_stop(branch) || is_gentle()) {
                const double speed = is_stop(branch) ? 0 : row_.speed;
                const double force = axis_.stiffness * (axis_.rest - row_.place) + axis_.damping * (axis_.speed - speed);
                return std::clamp(force * pass_.h, -most_, most_);
            }
        }
        if (axis_.drive == DenseAxis::Drive::motor && is_stop(branch)) {
            if (axis_.speed != 0) return axis_.speed > 0 ? most_ : -most_;
            return std::clamp(axis_.drive_impulse, -most_, most_);
        }
        if (branch == Branch::drive_low) return -most_;
        return branch == Branch::drive_high ? most_ : 0;
    }
    Equation drive() const {
        switch (axis_.drive) {
            case DenseAxis::Drive::lock:
                if (!pass_.biased) return {0, soft_};
                return {closing(row_.place - axis_.rest) + row_.drift + soft_ * axis_.drive_impulse, soft_};
            case DenseAxis::Drive::spring: {
                // implicit Euler: l = -h (k (place + h v - rest) + c (v - speed)), solved for v
                const double resistance = axis_.damping + pass_.h * axis_.stiffness;
                const double compliance = 1 / (pass_.h * resistance);
                const double force = axis_.stiffness * (row_.place - axis_.rest) - axis_.damping * axis_.speed;
                return {force / resistance + compliance * axis_.drive_impulse, compliance};
            }
            default:
                return {-axis_.speed, soft_};
        }
    }
    // The equation of a limit: the lower one, or the upper one mirrored.
    Equation stop(bool low) const {
        const double room = low ? row_.place - axis_.lower : axis_.upper - row_.place;
        const double drift = low ? row_.drift : -row_.drift;
        double bias = room > 0 ? room / pass_.h : 0;
        if (pass_.biased) bias = (room > 0 ? room / pass_.h : closing(room)) + drift;
        Equation equation{low ? bias : -bias, soft_};
        if (pass_.biased) equation.bias += soft_ * axis_.stop_impulse;
        return equation;
    }

    // The branch on which the row's law would hold, given the change of its impulse and its velocity afterwards.
    Branch better(Branch branch, double change, double speed) const {
        if (branch == Branch::stop_low) return axis_.stop_impulse + change < 0 ? Branch::drive : branch;
        if (branch == Branch::stop_high) return axis_.stop_impulse + change > 0 ? Branch::drive : branch;
        if (axis_.limited && axis_.drive != DenseAxis::Drive::lock) {
            if (speed + stop(true).bias < 0) return Branch::stop_low;
            if (speed + stop(false).bias > 0) return Branch::stop_high;
        }
        if (axis_.drive != DenseAxis::Drive::motor && axis_.drive != DenseAxis::Drive::spring) return branch;
        if (branch == Branch::drive) {
            if (!is_solved(branch)) return branch;
            if (axis_.drive_impulse + change < -most_) return Branch::drive_low;
            return axis_.drive_impulse + change > most_ ? Branch::drive_high : branch;
        }
        // A saturated drive stays saturated only while the row lags behind.
        const double error = speed + drive().bias + drive().compliance * (given_drive(branch) - axis_.drive_impulse);
        if (branch == Branch::drive_low) return error < 0 ? Branch::drive : branch;
        return error > 0 ? Branch::drive : branch;
    }

private:
    double closing(double gap) const {
        const double fastest = row_.axis < 3 ? pass_.push_speed : max_turn_speed;
        return std::clamp(gap * closed_part / pass_.h, -fastest, fastest);
    }
    const DenseAxis& axis_;
    const DenseRow& row_;
    const DensePass& pass_;
    double soft_, most_;
};

struct Problem {
    std::vector<DenseRow> rows;
    std::vector<Laws> laws;
    Matrix gives;
};

// Changes of drive and stop impulses on given branches.
struct Changes {
    std::vector<double> drive, stop, speed;
};
Changes solve_branches(const Problem& problem, const std::vector<DenseJoint>& joints, const std::vector<Branch>& branches) {
    const std::size_t n = problem.rows.size();
    Changes changes{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
    std::vector<std::size_t> unknown;
    std::vector<double> given(n);
    for (std::size_t i = 0; i < n; ++i) {
        const DenseAxis& axis = joints[problem.rows[i].joint].axes[problem.rows[i].axis];
        const bool stopped = is_stop(branches[i]), solved = problem.laws[i].is_solved(branches[i]);
        if (stopped || solved) unknown.push_back(i);
        if (!stopped) changes.stop[i] = -axis.stop_impulse;
        if (stopped || !solved) changes.drive[i] = problem.laws[i].given_drive(branches[i]) - axis.drive_impulse;
        given[i] = changes.drive[i] + changes.stop[i];
    }
    Matrix a(unknown.size(), std::vector<double>(unknown.size()));
    std::vector<double> y(unknown.size());
    for (std::size_t r = 0; r < unknown.size(); ++r) {
        const std::size_t i = unknown[r];
        const Equation equation =
            is_stop(branches[i]) ? problem.laws[i].stop(branches[i] == Branch::stop_low) : problem.laws[i].drive();
        y[r] = -(problem.rows[i].speed + equation.bias);
        for (std::size_t j = 0; j < n; ++j) y[r] -= problem.gives[i][j] * given[j];
        for (std::size_t c = 0; c < unknown.size(); ++c) a[r][c] = problem.gives[i][unknown[c]];
        a[r][r] += equation.compliance;
    }
    const std::vector<double> x = solve_linear(std::move(a), std::move(y));
    for (std::size_t r = 0; r < unknown.size(); ++r)
        (is_stop(branches[unknown[r]]) ? changes.stop : changes.drive)[unknown[r]] = x[r];
    for (std::size_t i = 0; i < n; ++i) {
        changes.speed[i] = problem.rows[i].speed;
        for (std::size_t j = 0; j < n; ++j) changes.speed[i] += problem.gives[i][j] * (changes.drive[j] + changes.stop[j]);
    }
    return changes;
}

Problem problem_of(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints, const DensePass& pass) {
    Problem problem;
    for (std::size_t j = 0; j < joints.size(); ++j)
        for (std::size_t k = 0; k < 6; ++k)
            if (joints[j].axes[k].drive != DenseAxis::Drive::none || joints[j].axes[k].limited)
                problem.rows.push_back(dense_row(bodies, joints[j], j, k, pass.h));
    const std::size_t n = problem.rows.size();
    problem.gives.assign(n, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) problem.gives[i][j] = dense_entry(bodies, joints, problem.rows[i], problem.rows[j]);
    for (std::size_t i = 0; i < n; ++i) {
        problem.rows[i].give = problem.gives[i][i];
        problem.laws.emplace_back(joints[problem.rows[i].joint].axes[problem.rows[i].axis], problem.rows[i], pass);
    }
    return problem;
}

// Moves rows whose law does not hold to a better branch: all of them, or the one of least index. Returns true if
// there are none.
bool exchange(const Problem& problem, const Changes& changes, std::vector<Branch>& branches, bool only_one) {
    bool met = true;
    for (std::size_t i = 0; i < branches.size() && (met || !only_one); ++i) {
        const double change = is_stop(branches[i]) ? changes.stop[i] : changes.drive[i];
        const Branch better = problem.laws[i].better(branches[i], change, changes.speed[i]);
        met = met && better == branches[i];
        branches[i] = better;
    }
    return met;
}

DenseSolution solution_of(const Problem& problem, const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints,
                          const Changes& changes, bool solved) {
    std::vector<DenseImpulses> by(joints.size());
    for (std::size_t i = 0; i < problem.rows.size(); ++i) {
        by[problem.rows[i].joint].drive[problem.rows[i].axis] = changes.drive[i];
        by[problem.rows[i].joint].stop[problem.rows[i].axis] = changes.stop[i];
    }
    DenseSolution solution = push_densely(bodies, joints, by);
    solution.solved = solved;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        for (std::size_t k = 0; k < 6; ++k) {
            solution.joints[j].drive[k] += joints[j].axes[k].drive_impulse;
            solution.joints[j].stop[k] += joints[j].axes[k].stop_impulse;
        }
    }
    return solution;
}

}  // namespace

DenseSolution push_densely(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints,
                           const std::vector<DenseImpulses>& impulses) {
    DenseSolution solution;
    solution.joints = impulses;
    solution.velocity.assign(bodies.size(), dvec3(0));
    solution.spin.assign(bodies.size(), dvec3(0));
    for (std::size_t j = 0; j < joints.size(); ++j) {
        for (std::size_t k = 0; k < 6; ++k) {
            const double impulse = impulses[j].drive[k] + impulses[j].stop[k];
            if (impulse == 0) continue;
            const DenseJacobian row = dense_row(bodies, joints[j], j, k, 1).jacobian;
            const auto push = [&](std::size_t body, const dvec3& linear, const dvec3& angular) {
                if (body == no_dense_body) return;
                const DensePush by = dense_response(bodies[body], linear, angular);
                solution.velocity[body] += by.velocity * impulse;
                solution.spin[body] += by.spin * impulse;
            };
            push(joints[j].a, row.linear_a, row.angular_a);
            push(joints[j].b, row.linear_b, row.angular_b);
        }
    }
    return solution;
}

DenseSolution solve_densely(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints, const DensePass& pass) {
    const Problem problem = problem_of(bodies, joints, pass);
    std::vector<Branch> branches(problem.rows.size(), Branch::drive);
    Changes changes;
    bool solved = false;
    const int block_rounds = 20, most_rounds = 200;
    for (int round = 0; round < most_rounds && !solved; ++round) {
        changes = solve_branches(problem, joints, branches);
        solved = exchange(problem, changes, branches, /* only_one */ round >= block_rounds);
    }
    return solution_of(problem, bodies, joints, changes, solved);
}

DenseSolution solve_densely_on(const DenseBranches& branches, const std::vector<DenseBody>& bodies,
                               const std::vector<DenseJoint>& joints, const DensePass& pass) {
    const Problem problem = problem_of(bodies, joints, pass);
    std::vector<Branch> of_rows;
    for (const DenseRow& row : problem.rows) of_rows.push_back(branches[row.joint][row.axis]);
    const Changes changes = solve_branches(problem, joints, of_rows);
    const bool solved = exchange(problem, changes, of_rows, /* only_one */ true);
    return solution_of(problem, bodies, joints, changes, solved);
}

}  // namespace scree::oracle
