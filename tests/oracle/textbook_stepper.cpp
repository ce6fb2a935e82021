// The textbook stepper: impulse formulas in order.
#include "tests/oracle/textbook_stepper.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scree::oracle {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;

namespace {

constexpr double pi = 3.14159265358979323846;

void set_mass(const Shape& shape, double density, TextbookBody& body) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const double r = sphere->radius;
        body.mass = density * 4 / 3 * pi * r * r * r;
        body.inertia = dvec3(0.4 * body.mass * r * r);
    } else if (const auto* box = std::get_if<Box>(&shape)) {
        const dvec3 h = box->half_extents;
        body.mass = density * 8 * h[0] * h[1] * h[2];
        body.inertia = body.mass / 3 * dvec3(h[1] * h[1] + h[2] * h[2], h[0] * h[0] + h[2] * h[2], h[0] * h[0] + h[1] * h[1]);
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        const double r = capsule->radius, length = 2.0 * capsule->half_height;
        const double cylinder = density * pi * r * r * length, caps = density * 4 / 3 * pi * r * r * r;
        // The hemispheres' centres of mass are 3/8 r beyond the cylinder's ends; parallel axis theorem.
        const double across =
            cylinder * (r * r / 4 + length * length / 12) + caps * (0.4 * r * r + length * length / 4 + 0.375 * length * r);
        body.mass = cylinder + caps;
        body.inertia = dvec3(across, cylinder * r * r / 2 + caps * 0.4 * r * r, across);
    }
}

dvec4 turned(dvec4 q, dvec3 rotation) {
    const double angle = magnitude(rotation);
    if (angle == 0) return q;
    const dvec3 p = rotation / angle * std::sin(angle / 2);
    const dvec3 v(q[0], q[1], q[2]);
    const double w = std::cos(angle / 2);
    const dvec3 vector = w * v + q[3] * p + cross_product(p, v);
    const dvec4 result(vector[0], vector[1], vector[2], w * q[3] - dot_product(p, v));
    const double length = std::sqrt(dot_product(vector, vector) + result[3] * result[3]);
    return result / length;
}

// R diag(d) R^T v
dvec3 in_body_axes(dvec4 orientation, dvec3 diagonal, dvec3 v) {
    const dmat3 turn = rotation_matrix(orientation);
    dvec3 result(0);
    for (int axis = 0; axis < 3; ++axis) result += turn[axis] * (diagonal[axis] * dot_product(turn[axis], v));
    return result;
}

}  // namespace

TextbookStepper::TextbookStepper(const Scene& scene, const TextbookOptions& options) : scene_(scene), options_(options) {
    for (const Body& body : scene.bodies) {
        if (body.linear_damping != 0 || body.angular_damping != 0 || body.rolling_resistance != 0) {
            throw std::invalid_argument("TextbookStepper: knows neither damping nor rolling resistance");
        }
        TextbookBody state;
        state.pose = {dvec3(body.position), dvec4(body.orientation)};
        state.velocity = dvec3(body.velocity);
        state.angular_velocity = dvec3(body.angular_velocity);
        if (body.motion == Motion::dynamic) set_mass(body.shape, body.density, state);
        bodies_.push_back(state);
    }
}

void TextbookStepper::run(double seconds) {
    const auto count = std::llround(seconds / options_.substep);
    for (long long i = 0; i < count; ++i) substep();
}

void TextbookStepper::substep() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].mass > 0)
            bodies_[i].velocity += dvec3(scene_.gravity) * double(scene_.bodies[i].gravity_scale) * options_.substep;
    }
    std::vector<Contact> contacts = find_contacts();
    bool changed = true;
    for (int i = 0; i < options_.iterations && changed; ++i) {
        changed = false;
        for (Contact& contact : contacts) changed = solve(contact) || changed;
    }
    move();
    separate();
}

std::vector<TextbookStepper::Contact> TextbookStepper::find_contacts() const {
    std::vector<Contact> contacts;
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
        for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
            if (bodies_[a].mass == 0 && bodies_[b].mass == 0) continue;
            const Body &body_a = scene_.bodies[a], &body_b = scene_.bodies[b];
            const double restitution = std::max(body_a.restitution, body_b.restitution);
            for (const TextbookPoint& point :
                 textbook_points(body_a.shape, bodies_[a].pose, body_b.shape, bodies_[b].pose, 0.1)) {
                Contact contact{};
                contact.a = a;
                contact.b = b;
                contact.normal = point.normal;
                contact.arm_a = point.position - bodies_[a].pose.position;
                contact.arm_b = point.position - bodies_[b].pose.position;
                contact.friction = std::sqrt(double(body_a.friction) * double(body_b.friction));
                const double speed = dot_product(relative_velocity(contact), point.normal);
                // In contact now or before the end of this substep.
                if (point.separation + speed * options_.substep > 0) continue;
                contact.least_speed = -std::max(point.separation, 0.0) / options_.substep;
                if (speed < -options_.restitution_threshold && restitution > 0) contact.least_speed = -restitution * speed;
                contacts.push_back(contact);
            }
        }
    }
    return contacts;
}

// One Gauss-Seidel update of a contact. Returns true if an impulse changed.
bool TextbookStepper::solve(Contact& contact) {
    const double speed = dot_product(relative_velocity(contact), contact.normal);
    const double before = contact.impulse;
    contact.impulse = std::max(0.0, before - (speed - contact.least_speed) / response(contact, contact.normal));
    apply(contact, contact.normal * (contact.impulse - before));

    const dvec3 v = relative_velocity(contact);
    const dvec3 slip = v - contact.normal * dot_product(v, contact.normal);
    const double slip_speed = magnitude(slip);
    dvec3 push(0);
    if (slip_speed > 1e-14) {
        const dvec3 wanted = contact.sideways - slip / response(contact, slip / slip_speed);
        const double size = magnitude(wanted), limit = contact.friction * contact.impulse;
        push = (size > limit ? wanted * (limit / size) : wanted) - contact.sideways;
        contact.sideways += push;
        apply(contact, push);
    }
    return std::abs(contact.impulse - before) + magnitude(push) > 1e-12 * (contact.impulse + 1e-6);
}

void TextbookStepper::apply(const Contact& contact, dvec3 impulse) {
    bodies_[contact.a].velocity -= impulse * inverse_mass(contact.a);
    bodies_[contact.b].velocity += impulse * inverse_mass(contact.b);
    bodies_[contact.a].angular_velocity -= turn_by(contact.a, cross_product(contact.arm_a, impulse));
    bodies_[contact.b].angular_velocity += turn_by(contact.b, cross_product(contact.arm_b, impulse));
}

void TextbookStepper::move() {
    for (TextbookBody& body : bodies_) {
        body.pose.position += body.velocity * options_.substep;
        if (body.mass == 0) {
            body.pose.orientation = turned(body.pose.orientation, body.angular_velocity * options_.substep);
            continue;
        }
        // Torque-free motion conserves angular momentum; the angular velocity follows from the orientation (at
        // mid-substep).
        const dvec3 inverse(1 / body.inertia[0], 1 / body.inertia[1], 1 / body.inertia[2]);
        const dvec3 momentum = in_body_axes(body.pose.orientation, body.inertia, body.angular_velocity);
        const dvec4 middle = turned(body.pose.orientation, body.angular_velocity * (options_.substep / 2));
        const dvec3 middle_velocity = in_body_axes(middle, inverse, momentum);
        body.pose.orientation = turned(body.pose.orientation, middle_velocity * options_.substep);
        body.angular_velocity = in_body_axes(body.pose.orientation, inverse, momentum);
    }
}

// Projects remaining penetration along the normal, weighted by inverse mass.
void TextbookStepper::separate() {
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
        for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
            const double mobility = inverse_mass(a) + inverse_mass(b);
            if (mobility == 0) continue;
            const auto points =
                textbook_points(scene_.bodies[a].shape, bodies_[a].pose, scene_.bodies[b].shape, bodies_[b].pose, 0);
            const auto deepest =
                std::min_element(points.begin(), points.end(),
                                 [](const TextbookPoint& p, const TextbookPoint& q) { return p.separation < q.separation; });
            if (deepest == points.end()) continue;
            const dvec3 shift = deepest->normal * (deepest->separation / mobility);
            bodies_[a].pose.position += shift * inverse_mass(a);
            bodies_[b].pose.position -= shift * inverse_mass(b);
        }
    }
}

double TextbookStepper::inverse_mass(std::size_t body) const {
    return bodies_[body].mass > 0 ? 1 / bodies_[body].mass : 0;
}

dvec3 TextbookStepper::turn_by(std::size_t index, dvec3 angular_impulse) const {
    const TextbookBody& body = bodies_[index];
    if (body.mass == 0) return dvec3(0);
    return in_body_axes(body.pose.orientation, dvec3(1 / body.inertia[0], 1 / body.inertia[1], 1 / body.inertia[2]),
                        angular_impulse);
}

dvec3 TextbookStepper::relative_velocity(const Contact& contact) const {
    const TextbookBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    return b.velocity + cross_product(b.angular_velocity, contact.arm_b) - a.velocity -
           cross_product(a.angular_velocity, contact.arm_a);
}

double TextbookStepper::response(const Contact& contact, dvec3 n) const {
    const dvec3 turn_a = cross_product(turn_by(contact.a, cross_product(contact.arm_a, n)), contact.arm_a);
    const dvec3 turn_b = cross_product(turn_by(contact.b, cross_product(contact.arm_b, n)), contact.arm_b);
    return inverse_mass(contact.a) + inverse_mass(contact.b) + dot_product(n, turn_a + turn_b);
}

double TextbookStepper::kinetic_energy() const {
    double energy = 0;
    for (const TextbookBody& body : bodies_) {
        const dvec3 spin = in_body_axes(body.pose.orientation, body.inertia, body.angular_velocity);
        energy += body.mass / 2 * dot_product(body.velocity, body.velocity) + dot_product(spin, body.angular_velocity) / 2;
    }
    return energy;
}

dvec3 TextbookStepper::momentum() const {
    dvec3 sum(0);
    for (const TextbookBody& body : bodies_) sum += body.mass * body.velocity;
    return sum;
}

dvec3 TextbookStepper::angular_momentum() const {
    dvec3 sum(0);
    for (const TextbookBody& body : bodies_) {
        sum += cross_product(body.pose.position, body.mass * body.velocity) +
               in_body_axes(body.pose.orientation, body.inertia, body.angular_velocity);
    }
    return sum;
}

}  // namespace scree::oracle
