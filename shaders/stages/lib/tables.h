// The one table of buffers of a step: binding, name, record, and what it is as long as. C++ and GLSL both expand it.
//
// *_before are last step's contacts: their buffers and those without the suffix change places after every step.
#ifndef SCREE_STAGES_TABLES_H
#define SCREE_STAGES_TABLES_H

//   binding, name, block, record, length
#define SCREE_TABLES(X)                                \
    X(0, parameters, ParametersTable, Parameters, one) \
    SCREE_CHANGING_TABLES(X)

// All but the parameters, which no stage writes.
#define SCREE_CHANGING_TABLES(X)                                                                                                 \
    X(1, counts, CountsTable, Counts, one)                                                                                       \
    X(2, traits, TraitsTable, Traits, bodies)                                                                                    \
    X(3, poses, PosesTable, Pose, bodies)                                                                                        \
    X(4, velocities, VelocitiesTable, Velocity, bodies)                                                                          \
    X(5, masses, MassesTable, Mass, bodies)                                                                                      \
    X(6, loads, LoadsTable, Load, bodies)                                                                                        \
    X(7, actions, ActionsTable, Action, actions)                                                                                 \
    X(8, bounds, BoundsTable, Bounds, bodies)                                                                                    \
    X(9, cells, CellsTable, uint, buckets) /* counted, scanned, and after filling the end of each bucket's entries */            \
    X(10, cell_entries, CellEntriesTable, CellEntry, bodies)                                                                     \
    X(11, pair_starts, PairStartsTable, uint, bodies_and_end)                                                                    \
    X(12, pairs, PairsTable, Pair, pairs)                                                                                        \
    X(13, binned, BinnedTable, uint, pairs) /* pairs by kind; later the contacts that the solver works on */                     \
    X(14, manifolds, ManifoldsTable, Manifold, pairs)                                                                            \
    X(15, touching, TouchingTable, uint, pairs)                    /* points of each pair's manifold */                          \
    X(16, contact_starts, ContactStartsTable, uint, pairs_and_end) /* before: where the kinds of each span begin in `binned` */  \
    X(17, contacts, ContactsTable, Contact, contacts)                                                                            \
    X(18, contacts_before, ContactsBeforeTable, Contact, contacts)                                                               \
    X(19, impulses, ImpulsesTable, Impulse, contacts)                                                                            \
    X(20, impulses_before, ImpulsesBeforeTable, Impulse, contacts)                                                               \
    X(21, first_contacts, FirstContactsTable, uint, bodies_and_end) /* of those that a body owns */                              \
    X(22, first_contacts_before, FirstContactsBeforeTable, uint, bodies_and_end)                                                 \
    X(23, slot_ends, SlotEndsTable, uint, bodies_and_end) /* counted, scanned, and after filling the end of each body's slots */ \
    X(24, slot_sides, SlotSidesTable, uint, slots)        /* which side of which contact owns a slot: 2 * contact + side */      \
    X(25, constraints, ConstraintsTable, Constraint, contacts)                                                                   \
    X(26, slots, SlotsTable, Slot, slots)                                                                                        \
    X(27, candidates, CandidatesTable, Candidate, candidates) /* near each body, in any order; or a scan's sums */               \
    X(28, rests, RestsTable, uint, bodies)                    /* how long each body has been quiet, and what woke it: sleep.h */ \
    X(29, hulls, HullsTable, uvec4, hulls)                    /* the convex hulls that there are, in the form of shape_data.h */ \
    X(30, joints, JointsTable, Joint, joints)                                                                                    \
    X(31, vehicles, VehiclesTable, Vehicle, vehicles)                                                                            \
    X(32, ids, IdsTable, uint, bodies) /* which of the scene's bodies, or which part, is in each row */

#endif
