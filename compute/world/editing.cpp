// World: editing while it runs: grips, explosions, settings, new bodies.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

#include "compute/compile/scene_compiler.h"
#include "compute/compile/state_editor.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene/validation/periodic_validation.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

constexpr float farthest = 1e6f;  // m, as in a scene

void demand(bool condition, const std::string& what) {
    if (!condition) throw std::invalid_argument(what);
}

bool within(vec3 v, float limit) {
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

void check(const GripSpring& s) {
    demand(s.hertz >= 0.1f && s.hertz <= 30, "grip: hertz must be between 0.1 and 30");
    demand(s.damping_ratio >= 0 && s.damping_ratio <= 10, "grip: damping_ratio must be between 0 and 10");
    demand(s.max_acceleration >= 0 && s.max_acceleration <= 1e4f, "grip: max_acceleration must be between 0 and 10000 m/s^2");
    demand(s.spin_damping >= 0 && s.spin_damping <= 100, "grip: spin_damping must be between 0 and 100 1/s");
}

// Soft constraint coefficients (Catto, Soft Constraints, GDC 2011); see shaders/physics/body/grab_spring.h.
physics::Grip record_of(std::size_t body, vec3 anchor, vec3 target, const GripSpring& spring, float h) {
    const float omega = 2 * std::numbers::pi_v<float> * spring.hertz;
    const float a1 = 2 * spring.damping_ratio + h * omega;
    const float a2 = h * omega * a1;
    physics::Grip grip{};
    grip.body = static_cast<physics::uint>(body);
    grip.anchor = anchor;
    grip.target = target;
    grip.bias_rate = omega / a1;
    grip.mass_scale = a2 / (1 + a2);
    grip.most = spring.max_acceleration * h;
    grip.spin_kept = 1 / (1 + h * spring.spin_damping);
    return grip;
}

}  // namespace

World::Impl::Held& World::Impl::held(std::size_t grip) {
    if (grip < grips.size() && grips[grip]) return *grips[grip];
    throw std::out_of_range("grip " + std::to_string(grip) + " is not in use");
}

// Unused records are zeroed, so that equal grips give equal parameters.
void World::Impl::take_up_grips() {
    physics::Parameters& parameters = state.fixed();
    parameters.held = 0;
    for (physics::Grip& record : parameters.grips) record = {};
    for (std::optional<Held>& grip : grips) {
        // Bodies go with others: a fragment with its whole body, and in a state that is restored.
        if (grip &&
            (grip->body >= scene.bodies.size() || is_gone(grip->body) || scene.bodies[grip->body].motion != Motion::dynamic))
            grip.reset();
        if (!grip) continue;
        action_on(grip->body, vec3(0), vec3(0));  // wakes the body
        parameters.grips[parameters.held++] =
            record_of(state.row_of(grip->body), grip->anchor, grip->target, grip->spring, parameters.h);
    }
}

std::size_t World::grip(std::size_t body, vec3 anchor, vec3 target, const GripSpring& spring) {
    Impl& in = whole();
    const auto free = std::find(in.grips.begin(), in.grips.end(), std::nullopt);
    if (free == in.grips.end()) throw std::length_error("at most " + std::to_string(most_grips) + " grips hold at once");
    check(spring);
    demand(within(target, farthest), "grip: the target must be within 1000000 m of 0");
    in.action_on(body, anchor, target);
    const vec3 box = half_extents(in.scene.bodies[body].shape);
    *free = Impl::Held{body, glm::clamp(anchor, -box, box), target, spring};
    return static_cast<std::size_t>(free - in.grips.begin());
}

void World::move_grip(std::size_t grip, vec3 target) {
    demand(within(target, farthest), "grip: the target must be within 1000000 m of 0");
    whole().held(grip).target = target;
}

void World::release(std::size_t grip) {
    whole().held(grip);
    whole().grips[grip].reset();
}

void World::explode(vec3 centre, float radius, float speed, std::optional<std::size_t> copy) {
    if (copy) whole().require_copy(*copy);
    demand(within(centre, farthest), "explosion: the centre must be within 1000000 m of 0");
    demand(radius > 0 && radius <= farthest, "explosion: the radius must be in (0, 1000000] m");
    demand(std::abs(speed) <= 1e4f, "explosion: the speed must be within 10000 m/s");
    const std::vector<BodyState> states = bodies();
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Body& body = whole().scene.bodies[i];
        if (body.motion != Motion::dynamic || !states[i].exists || (copy && whole().copy_of(i) != *copy)) continue;
        const vec3 apart = states[i].position - centre;
        const float distance = glm::length(apart);
        if (!(distance < radius)) continue;
        const vec3 direction = distance > 1e-6f * radius ? apart / distance : vec3(0, 1, 0);
        const float mass = mass_properties(body).mass;
        apply_impulse(i, direction * (mass * speed * (1 - distance / radius)));
    }
}

void World::Impl::retune(const Settings& changed) {
    StateEditor editor(state);
    runner->download(editor.needed_to_tune(changed));
    const bool other_substeps = changed.substeps != settings.substeps;
    const SceneFeatures features = state.features();
    settings = changed;
    const TableRanges ranges = editor.tune(scene.gravity, settings);
    if (other_substeps || state.features() != features) runner->adapt();
    runner->upload(ranges);
    begin_impacts(features);
}

void World::set_fields(const Fields& fields) {
    Impl& in = whole();
    Fields changed = fields;
    check_world_fields(changed);
    in.scene.fields = std::move(changed);
    const TableLengths before = TableLengths::of(in.state);
    in.send(StateEditor(in.state).set_fields(in.scene), before);
    in.edits.clear();
    wake_all();
}

void World::set_cell_rate(vec3 rate) {
    Impl& in = whole();
    Scene changed;
    changed.periodic = in.scene.periodic;
    changed.periodic.rate = rate;
    if (!in.scene.joints.empty()) changed.joints.resize(1);  // what the check asks for
    check_periodic_cell(changed);
    in.scene.periodic.rate = rate;
    set_period(in.state.fixed(), in.scene.periodic);
    in.retune(in.settings);
    wake_all();
}

void World::Impl::require_room_in_cell() const {
    const physics::Parameters& p = state.fixed();
    if (!is_stretching(p)) return;
    float widest = 0;
    for (std::uint32_t row = 0; row < p.first_part; ++row) {
        const physics::BodyProperties& body = state.properties[row];
        if (body.motion == physics::MOTION_DYNAMIC) widest = std::max(widest, physics::bounding_radius(body));
    }
    for (int k = 0; k < 3; ++k) {
        if (!(p.cell_rate[k] < 0) || p.period[k] >= 4 * widest) continue;
        char text[200];
        std::snprintf(text, sizeof text,
                      "the periodic cell has become %.4g m wide along %c, less than four times the %.4g m that a "
                      "body reaches from its centre; end its rate",
                      static_cast<double>(p.period[k]), "xyz"[k], static_cast<double>(widest));
        throw std::domain_error(text);
    }
}

void World::Impl::stretch_cell() {
    physics::Parameters& p = state.fixed();
    if (!is_stretching(p)) return;
    PeriodicCell& cell = scene.periodic;
    cell.size = cell.size + cell.size * p.cell_rate * p.dt;
    set_period(p, cell);
}

void World::set_gravity(vec3 gravity) {
    whole().scene.gravity = checked(Scene{gravity, {}, {}}).gravity;
    if (!whole().state.gravities.empty()) whole().set_gravities({});
    whole().retune(whole().settings);
    wake_all();
}

void World::set_friction_factor(float factor) {
    Settings changed = whole().settings;
    changed.friction_factor = factor;
    whole().retune(checked(changed));
    wake_all();
}

void World::set_least_restitution(float restitution) {
    Settings changed = whole().settings;
    changed.least_restitution = restitution;
    whole().retune(checked(changed));
    wake_all();
}

void World::set_substeps(int substeps) {
    Settings changed = whole().settings;
    changed.substeps = substeps;
    whole().retune(checked(changed));
}

void World::set_sleeping(bool allowed) {
    whole().settings.sleeping = allowed;
    physics::Parameters& p = whole().state.fixed();
    p.sleep_steps = tuned(p, whole().scene.gravity, whole().settings).sleep_steps;
}

}  // namespace scree
