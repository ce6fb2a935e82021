// Blocks of contacts: the contacts of one pair of bodies are one block of the mass-splitting iteration.
//
// A compound or a mesh touches another body in several contacts, one for each pair of parts. As blocks of their own they rock: in
// the split of the mass each leg of a table is as stiff as its share of the load, so the load that wanders from leg to leg drives
// the table (mass_splitting.h), and a column of three swung at 0.2 m/s for ever. So the contacts of a pair count once in the
// splitting of both masses, by the sum of their loads, and are solved one after the other on the same two split bodies
// (Gauss-Seidel), as the points of one contact are.
//
// A penetrating point is a spring whose stiffness goes with the split mass, whatever the number of points, and more than four of
// them would be stiffer than the substep allows: with the 16 points of four legs three tables swing at 71 mm/s. So each of more
// than four points has its part of the stiffness of four, in the relax pass too: where that removes all of the velocity, columns
// on six to twelve legs rock at 7 to 15 mm/s. Points that are still apart stop their bodies with the whole mass.
//
// The relax pass goes through the contacts in the order opposite to that of the biased pass: in one order they push each other
// round, and columns on twelve legs rock at 4 mm/s and creep by 1 mm a second.
//
// Measured (20 to 80 s after the start, awake): columns of two, three and five tables move at 0.002, 0.003 and 0.02 mm/s, and at
// 55, 180 and 240 where each contact is a block of its own.
//
// Elastic contacts and tyres are blocks of their own: an impact needs the velocities before it.
#ifndef SCREE_PHYSICS_CONTACT_BLOCK_H
#define SCREE_PHYSICS_CONTACT_BLOCK_H

#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/collide/shape_data.h"
#include "shaders/physics/constraint/constraint.h"

LAWS_BEGIN

// Contacts of a block, at most: those of a hull on hundreds of triangles are several blocks, so no thread solves hundreds.
CONSTANT uint BLOCK_CONTACTS = 32u;

LAW bool is_of_compound(BodyProperties row) {
    return is_part(row) && row.shape != SHAPE_TRIANGLE;
}
// Whether a contact shares its block with others of the same two bodies. The properties are those of the rows in contact.
LAW bool shares_block(BodyProperties ta, BodyProperties tb, Parameters parameters) {
    bool elastic = larger(parameters.least_restitution, larger(ta.restitution, tb.restitution)) > 0.0f;
    return (is_of_compound(ta) || is_of_compound(tb)) && !elastic && tyre_of(ta) == 0u && tyre_of(tb) == 0u;
}

// The contacts of a block are a list, gone through either way: `links` has the numbers of the contact before and of that behind,
// one xor the other. A contact's number is its index and 1; 0: none.
LAW Constraint linked(Constraint c, uint before, uint behind) {
    c.links = before ^ behind;
    c.flags = c.flags | (before != 0u ? CONSTRAINT_FOLLOWS : 0u) | (behind != 0u ? CONSTRAINT_LEADS : 0u);
    return c;
}
LAW uint next_of_block(Constraint c, uint came_from) {
    return c.links ^ came_from;
}

struct BlockLoad {
    float normal_sum;  // sum of its contacts' normal impulses as the substep began, N s
    float points;      // that bear or penetrate
};
LAW BlockLoad no_load() {
    BlockLoad load;
    load.normal_sum = 0.0f;
    load.points = 0.0f;
    return load;
}
LAW BlockLoad with_contact(BlockLoad load, Constraint c, Impulse impulse) {
    load.normal_sum = load.normal_sum + impulse.normal_sum;
    for (int k = 0; k < 4; ++k) {
        bool bears = uint(k) < point_count(c) && (impulse.normal[k] > 0.0f || impulse.separation[k] <= 0.0f);
        load.points = load.points + choose(bears, 1.0f, 0.0f);
    }
    return load;
}
// The part of the stiffness of a contact by itself that each penetrating point has.
LAW float part_of_stiffness(BlockLoad load) {
    return choose(load.points > 4.0f, 4.0f * reciprocal(larger(load.points, 4.0f)), 1.0f);
}

LAWS_END

#endif
