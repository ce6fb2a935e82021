// The tables of a step (record, length, one meaning each) and the device buffers that hold them. C++ and GLSL both
// expand these lists.
//
// Wide tables have a buffer each. Tables of single words share one buffer, and so do tables of quads (16 bytes),
// because devices bind few storage buffers (MoltenVK 31, lavapipe 32): Parameters.table_offsets says where each begins,
// and shaders/stages/lib/words.glsl and quads.glsl access them. On the host every table is a vector
// (compute/tables/state.h).
//
// *_before are the contacts of the last step: their buffers and those without the suffix are swapped after every step.
#ifndef SCREE_STAGES_TABLES_H
#define SCREE_STAGES_TABLES_H

// ---- tables: buffer, name, block, record, length
#define SCREE_RECORD_TABLES(X)                                                                 \
    X(1, counts, CountsTable, Counts, one)                                                     \
    X(2, properties, PropertiesTable, BodyProperties, bodies)                                  \
    X(3, poses, PosesTable, Pose, bodies)                                                      \
    X(4, velocities, VelocitiesTable, Velocity, bodies)                                        \
    X(5, masses, MassesTable, BodyMass, bodies)                                                \
    X(6, forces, ForcesTable, BodyForces, bodies)                                              \
    X(7, actions, ActionsTable, Action, actions)                                               \
    X(8, bounds, BoundsTable, Bounds, bodies)                                                  \
    X(9, cell_entries, CellEntriesTable, CellEntry, bodies)                                    \
    X(10, pairs, PairsTable, Pair, pairs)                                                      \
    X(11, manifolds, ManifoldsTable, Manifold, contacts) /* of pairs with points, any order */ \
    X(12, contacts, ContactsTable, Contact, contacts)                                          \
    X(13, contacts_before, ContactsBeforeTable, Contact, contacts)                             \
    X(14, slots, SlotsTable, VelocityDelta, slots)                                             \
    X(15, candidates, CandidatesTable, Candidate, candidates) /* pairs found, in any order */  \
    X(16, joints, JointsTable, Joint, joints)                                                  \
    X(17, joint_blocks, JointBlocksTable, JointBlock, joint_blocks)                            \
    X(18, block_bodies, BlockBodiesTable, BlockBody, block_bodies)                             \
    X(19, joint_equations, JointEquationsTable, JointEquations, joints) /* within a pass */    \
    X(20, vehicles, VehiclesTable, Vehicle, vehicles)

// In groups on a device (shaders/physics/base/record_groups.h): shaders/stages/lib/grouped.glsl accesses them.
#define SCREE_GROUPED_TABLES(X)                                           \
    X(21, impulses, ImpulsesTable, ContactImpulse, contacts)              \
    X(22, impulses_before, ImpulsesBeforeTable, ContactImpulse, contacts) \
    X(23, impacts, ImpactsTable, ContactImpact, impacts)                  \
    X(24, impacts_before, ImpactsBeforeTable, ContactImpact, impacts)     \
    X(25, constraints, ConstraintsTable, Constraint, contacts)

#define SCREE_WIDE_TABLES(X) \
    SCREE_RECORD_TABLES(X)   \
    SCREE_GROUPED_TABLES(X)

// Lists that are counted, scanned and filled are named after their final content; earlier contents have names of their
// own (SCREE_VIEWS).
#define SCREE_WORD_TABLES(X)                                                                                                  \
    X(26, cell_ends, WordsTable, uint, buckets)             /* end of each bucket in cell_entries */                          \
    X(26, pair_starts, WordsTable, uint, bodies_and_end)    /* first pair that each row owns */                               \
    X(26, slot_ends, WordsTable, uint, bodies_and_end)      /* end of each body's slots */                                    \
    X(26, first_contacts, WordsTable, uint, bodies_and_end) /* first contact each row owns; until sort_slots last step's */   \
    X(26, sleep_states, WordsTable, uint, bodies)           /* quiet steps, and what woke the body: sleep.h */                \
    X(26, ids, WordsTable, uint, bodies)                    /* id of the body or part in each row */                          \
    X(26, strains, WordsTable, float, bodies)      /* last step's impulse or momentum of breakable bodies: fracture.h */      \
    X(26, impact_debts, WordsTable, float, bodies) /* J, of bodies in an impact in this substep: restitution.h */             \
    X(26, point_counts, WordsTable, uint, pairs)   /* points of each pair's manifold; with SPECULATIVE or POINTS_HIDDEN */    \
    X(26, pairs_by_type, WordsTable, uint, pairs)                                                                             \
    X(26, contacts_to_solve, WordsTable, uint, contacts)   /* contacts of the solver, in any order */                         \
    X(26, contact_owners, WordsTable, uint, contacts)      /* if rows are reordered: id of the body that owns each contact */ \
    X(26, pair_type_starts, WordsTable, uint, pair_types)  /* in pairs_by_type, per pair type and pair block */               \
    X(26, contact_starts, WordsTable, uint, pairs_and_end) /* each pair's contact, if it has points */                        \
    X(26, manifold_places, WordsTable, uint, pairs)        /* each pair's manifold, if it has points */                       \
    X(26, contact_pairs, WordsTable, uint, contacts)       /* each contact's pair */                                          \
    X(26, contact_slots, WordsTable, uint, contact_sides)  /* of each 2 * contact + side; NONE: contacts do not move it */    \
    X(26, carried, WordsTable, float, contacts)            /* if bodies may break: normal impulse in this step, N s */        \
    X(26, attractions, WordsTable, float, attractions)     /* of each 2 * contact: force at a point, N; then which points */  \
    X(26, slot_sides, WordsTable, uint, slots)             /* of each slot: 2 * contact + side, or OF_JOINT | block body */   \
    X(26, neighbours_quiet, WordsTable, float, slots)      /* of each slot: quiet steps of the other body: sleep.h */         \
    X(26, scan_sums, WordsTable, uint, scan_blocks)                                                                           \
    X(26, births, WordsTable, uint, copies)              /* step in which each copy began anew: copies.h */                   \
    X(26, copy_states, WordsTable, uint, copies)         /* COPY_* of this step */                                            \
    X(26, bond_states, WordsTable, uint, bonds)          /* 1: broken */                                                      \
    X(26, bond_ends, WordsTable, uint, bond_ends)        /* by id: end of each body's changes in bond_changes */              \
    X(26, bond_changes, WordsTable, float, bond_changes) /* of each side of a bond: BOND_WORDS */

#define SCREE_QUAD_TABLES(X)                                                                                  \
    X(27, hulls, QuadsTable, uvec4, hulls)              /* hulls, triangles of meshes, seams: shape_data.h */ \
    X(27, parts, QuadsTable, PoseInBody, parts)         /* poses of parts in their bodies */                  \
    X(27, fractures, QuadsTable, Fracturing, fractures) /* of each breakable body */                          \
    X(27, pieces, QuadsTable, PoseInBody, pieces)       /* poses of fragments in their bodies */              \
    X(27, tyres, QuadsTable, Tyre, tyres)                                                                     \
    X(27, immersions, QuadsTable, Immersion, immersions) /* by id, if there is air or water: medium.h */      \
    X(27, surfaces, QuadsTable, Surface, surfaces)       /* of rows with one: material.h */                   \
    X(27, way_points, QuadsTable, WayPoint, way_points)  /* of the vehicles' routes */                        \
    X(27, filters, QuadsTable, uvec4, filters)           /* of all rows, if any body has one: filter.h */     \
    X(27, exclusions, QuadsTable, uvec4, exclusions)     /* pairs of bodies that never collide: filter.h */   \
    X(27, gravities, QuadsTable, uvec4, gravities)       /* of each copy, if they differ, m/s^2: copies.h */  \
    X(27, bonds, QuadsTable, Bond, bonds)                /* between bodies: bond.h */

#define SCREE_TABLES(X)                                \
    X(0, parameters, ParametersTable, Parameters, one) \
    SCREE_WIDE_TABLES(X)                               \
    SCREE_WORD_TABLES(X)                               \
    SCREE_QUAD_TABLES(X)

// ---- buffers, in the order of their bindings
#define SCREE_BUFFERS(X)                               \
    X(0, parameters, ParametersTable, Parameters, one) \
    SCREE_STORAGE_BUFFERS(X)
// All but the parameters, which no stage writes.
#define SCREE_STORAGE_BUFFERS(X) \
    SCREE_WIDE_TABLES(X)         \
    SCREE_SHARED_BUFFERS(X)
// Of tables of words, and of quads.
#define SCREE_SHARED_BUFFERS(X)            \
    X(26, words, WordsTable, uint, shared) \
    X(27, quads, QuadsTable, uvec4, shared)

// ---- lasting tables: state of a row or contact that persists across steps. It moves with its body to other rows, ranks,
// copies and checkpoints, in this order. All code that moves it loops over these lists (compute/tables/lasting.h).
//
// Of rows: table, and how it travels between ranks.
//   alike: equal on all ranks; sent only where the world is shared out.
//   owned: sent by the owner when a body changes its owner or the world is gathered.
//   ghosts: as owned, and sent at the start of each step to ranks that hold the body as a ghost.
#define SCREE_LASTING_OF_ROWS(X) \
    X(properties, alike)         \
    X(poses, ghosts)             \
    X(velocities, ghosts)        \
    X(sleep_states, ghosts)      \
    X(strains, owned)            \
    X(masses, ghosts)
// Of contacts: table; NAME_before is that of the last step.
#define SCREE_LASTING_OF_CONTACTS(X) \
    X(contacts)                      \
    X(impulses)                      \
    X(impacts)

// ---- views: table, name of its earlier content
#define SCREE_VIEWS(X)          \
    X(cell_ends, cell_counts)   \
    X(cell_ends, cell_starts)   \
    X(pair_starts, pair_counts) \
    X(slot_ends, slot_counts)   \
    X(slot_ends, slot_starts)   \
    X(pair_type_starts, pair_type_counts)

// ---- aliased tables on a device: of those in one memory each is dead when the next one is written
#define SCREE_SHARES(X)                 /* table, the one whose memory it is in */         \
    X(contact_starts, pair_type_starts) /* after pairs are binned by type */               \
    X(carried, contact_starts)          /* after bodies know their contacts */             \
    X(contacts_to_solve, pairs_by_type) /* after the narrowphase */                        \
    X(neighbours_quiet, contact_slots)  /* after contacts are prepared */                  \
    X(slot_sides, manifold_places)      /* after bodies wake */                            \
    X(contact_pairs, cell_ends)         /* after the broadphase */                         \
    X(impact_debts, contact_pairs)      /* after contacts are prepared */                  \
    X(cell_entries, contacts)           /* before contacts are made */                     \
    X(candidates, impulses)             /* before the narrowphase */                       \
    X(manifolds, impulses)              /* before impulses are taken from the last step */ \
    X(constraints, contacts_before)     /* after that */                                   \
    X(slots, impulses_before)           /* likewise */

#endif
