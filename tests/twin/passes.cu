// The passes of the contact solver as CUDA kernels, of the laws that the shaders compile. nvcc tells their registers, spills and
// instructions on a machine without a GPU (tests/twin/run).
#include <cstdint>
#include <cstring>

#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/base/passes.h"
#include "shaders/physics/base/record_groups.h"
#include "shaders/physics/contact/contact_pass.h"

namespace {

using namespace scree::physics;
using Quad = uint4;

// What a scene has, as shaders/stages/lib/features.glsl narrows it.
constexpr bool everything = TWIN_ALL_FEATURES != 0;
constexpr unsigned group_shift = GROUP_SHIFT;
// Quads of a ContactImpulse that the biased pass writes (SOLVED_MEMBERS in pass_contacts.glsl): normal, friction and stretch;
// rolling.
constexpr unsigned solved = 1u << 0 | 1u << 2 | 1u << 5, rolled = 1u << 3;

struct Tables {
    const Parameters* parameters;
    const Quad* constraints;
    Quad* impulses;
    Quad* impacts;
    const Quad* masses;
    const Quad* velocities;
    const Quad* forces;
    Quad* slots;
    const uint* contacts_to_solve;
    const float* impact_debts;
    float* carried;
    uint contacts;
};

template <typename Record>
__device__ Record read(const Quad* quads, uint i, uint shift) {
    constexpr uint count = sizeof(Record) / sizeof(Quad);
    Quad words[count];
    for (uint k = 0; k < count; ++k) words[k] = quads[place_in_groups(count, i, k, shift)];
    Record record;
    memcpy(&record, words, sizeof record);
    return record;
}
template <typename Record>
__device__ void write(Quad* quads, uint i, uint shift, const Record& record, uint members = ~0u) {
    constexpr uint count = sizeof(Record) / sizeof(Quad);
    Quad words[count];
    memcpy(words, &record, sizeof record);
    for (uint k = 0; k < count; ++k)
        if (members >> k & 1u) quads[place_in_groups(count, i, k, shift)] = words[k];
}

__device__ Constraint constraint_at(const Tables& t, uint i) {
    Constraint c = read<Constraint>(t.constraints, i, group_shift);
    if (everything) return c;
    c.restitution = 0.0f;
    c.links = 0u;
    c.flags = c.flags & ~(CONSTRAINT_FOLLOWS | CONSTRAINT_LEADS | CONSTRAINT_ROUND | CONSTRAINT_ROLLS_ONLY);
    c.rolling_resistance = 0.0f;
    c.tyre_slip = 0.0f;
    c.drive1 = c.drive2 = c.static_friction = c.restitution_threshold = 0.0f;
    return c;
}
__device__ Impulse impulse_at(const Tables& t, uint i) {
    const ContactImpulse own = read<ContactImpulse>(t.impulses, i, group_shift);
    return whole_impulse(own, everything ? read<ContactImpact>(t.impacts, i, group_shift) : no_impact());
}
__device__ VelocityPair velocities_of(const Tables& t, Constraint c) {
    return {read<Velocity>(t.velocities, c.a, 0), read<Velocity>(t.velocities, c.b, 0)};
}
__device__ ImpactContext around_impact(const Tables& t, Constraint c, const Parameters& p) {
    if (!(c.restitution > 0.0f)) return no_impact_context();
    return impact_context(c, read<BodyForces>(t.forces, c.a, 0), read<BodyForces>(t.forces, c.b, 0),
                          read<BodyMass>(t.masses, c.a, 0), read<BodyMass>(t.masses, c.b, 0), p);
}
__device__ BlockLoad load_of_block(const Tables& t, uint i, Constraint c, Impulse impulse) {
    BlockLoad load = with_contact(no_load(), c, impulse);
    if (!everything) return load;
    uint before = i + 1u;
    for (uint here = next_of_block(c, 0u); here != 0u;) {
        c = read<Constraint>(t.constraints, here - 1u, group_shift);
        load = with_contact(load, c, impulse_at(t, here - 1u));
        const uint next = next_of_block(c, before);
        before = here;
        here = next;
    }
    return load;
}
__device__ void write_slots(const Tables& t, Constraint c, VelocityPair share, float weight, float passed_on) {
    if (c.slot_a != NONE) write(t.slots, c.slot_a, 0, velocity_delta(share.a, weight, passed_on));
    if (c.slot_b != NONE) write(t.slots, c.slot_b, 0, velocity_delta(share.b, weight, passed_on));
}

}  // namespace

extern "C" __global__ void __launch_bounds__(128, TWIN_GROUPS) solve_contacts(Tables t) {
    const uint place = blockIdx.x * blockDim.x + threadIdx.x;
    if (place >= t.contacts) return;
    const Parameters& p = *t.parameters;
    const uint i = t.contacts_to_solve[place];
    Constraint c = constraint_at(t, i);
    if (everything && follows_in_block(c)) return;
    Impulse impulse = impulse_at(t, i);
    BlockBodies bodies = biased_bodies(read<BodyMass>(t.masses, c.a, 0), read<BodyMass>(t.masses, c.b, 0), impulse,
                                       load_of_block(t, i, c, impulse), velocities_of(t, c), p);
    if (!everything) bodies.part = 1.0f;
    VelocityPair v = bodies.moved;
    uint came_from = 0u, here = i + 1u;
    do {
        if (came_from != 0u) {
            c = constraint_at(t, here - 1u);
            impulse = impulse_at(t, here - 1u);
        }
        const BiasedOutcome after = biased_pass(c, impulse, v, bodies, around_impact(t, c, p), p);
        write(t.impulses, here - 1u, group_shift, contact_impulse_of(after.impulse), everything ? solved | rolled : solved);
        if (everything) write(t.impacts, here - 1u, group_shift, contact_impact_of(after.impulse));
        write_slots(t, c, after.share, after.impact_weight, everything ? after.debt : 0.0f);
        v = after.velocity;
        const uint next = next_of_block(c, came_from);
        came_from = here;
        here = next;
    } while (everything && here != 0u);
}

extern "C" __global__ void __launch_bounds__(128, TWIN_GROUPS) relax_contacts(Tables t, uint pass) {
    const uint place = blockIdx.x * blockDim.x + threadIdx.x;
    if (place >= t.contacts) return;
    const Parameters& p = *t.parameters;
    const uint i = t.contacts_to_solve[place];
    Constraint c = constraint_at(t, i);
    if (everything && leads_in_block(c)) return;
    Impulse impulse = impulse_at(t, i);
    BlockBodies bodies =
        relax_bodies(read<BodyMass>(t.masses, c.a, 0), read<BodyForces>(t.forces, c.a, 0), read<BodyMass>(t.masses, c.b, 0),
                     read<BodyForces>(t.forces, c.b, 0), impulse, load_of_block(t, i, c, impulse), velocities_of(t, c), p);
    if (!everything) bodies.part = 1.0f;
    const bool last = (pass & PASS_LAST) != 0u;
    VelocityPair v = bodies.moved;
    float weight = 0.0f;
    uint came_from = 0u, here = i + 1u;
    do {
        if (came_from != 0u) {
            c = constraint_at(t, here - 1u);
            impulse = impulse_at(t, here - 1u);
        }
        ImpactContext around = around_impact(t, c, p);
        if (everything && is_impact(impulse))
            around.debt = part_of_debts(impulse, t.impact_debts[c.a], read<BodyForces>(t.forces, c.a, 0), bodies.a,
                                        t.impact_debts[c.b], read<BodyForces>(t.forces, c.b, 0), bodies.b);
        const RelaxOutcome after = relax_pass(c, impulse, v, bodies, around, last, p);
        if (everything) t.carried[here - 1u] = (pass & PASS_FIRST) != 0u ? after.borne : t.carried[here - 1u] + after.borne;
        write(t.impulses, here - 1u, group_shift, contact_impulse_of(after.impulse));
        if (everything) write(t.impacts, here - 1u, group_shift, contact_impact_of(after.impulse));
        v = after.velocity;
        weight = larger(weight, after.counts);
        const uint next = next_of_block(c, came_from);
        write_slots(t, c, after.share, next == 0u ? weight : 0.0f, after.normal_sum);
        came_from = here;
        here = next;
    } while (everything && here != 0u);
}
