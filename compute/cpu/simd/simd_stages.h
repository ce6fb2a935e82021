// SIMD versions of the stages that take most of a step: one body, pair or contact per lane.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compute/tables/table_words.h"

namespace scree::reference {

// The tables, and what else lanes take. Of the tables, `manifolds` has one of each pair. Null are `constraints` where only the
// passes of lanes read them, in `groups`; `impacts` if no contact has restitution; and `carried` (the normal impulse of each
// contact in the step, N s) if no body may break.
struct WideTables : TableWords {
    const std::uint32_t* items;  // indices of the pairs, contacts or bodies to process
    // BoxPairs: of separate_boxes for each of `items`, of collide_boxes those at `places`.
    std::uint32_t* out = nullptr;
    const std::uint32_t* places = nullptr;
    std::uint8_t* marks = nullptr;         // one for each of `items`, of bound and finish
    std::uint32_t* groups = nullptr;       // constraints and impulses of the contacts in `items`, one per lane
    std::uint8_t* unloaded = nullptr;      // of each group in `groups`: whether it is unloaded and its slots are zero
    std::uint32_t* body_groups = nullptr;  // of the bodies in `items`: words_of_body for each, one body per lane
    bool plain = false;                    // no contact bounces or rolls, none has a tyre or a surface of its own
    bool watched = false;                  // tables are read after every stage: impulses not after the last alone, impacts always
    bool sums_impacts = true;              // BodyForces.impact_weight is written: some body may be in an impact, or `watched`
    bool warm_starts = false;              // preparation warm-starts contacts from the last step, and is that of all contacts
    bool prefetches = false;  // contacts are so many that `groups`, and it is assumed bodies, do not fit into the second cache
    bool periodic = false;    // there is a periodic cell
    bool first = false;       // the first substep of a step
    bool last = false;        // the last one
};

constexpr std::size_t words_of_body = 13;  // in body_groups

// The stages for items [first, last), bit-identical to the plain loops of compute/cpu; `first` of a stage of contacts, and of
// begin and move, is a multiple of the lanes. Preparation transposes constraints and impulses into `groups`, where the passes of
// the step's substeps keep them; the last pass transposes the impulses back.
struct WideStages {
    int lanes;
    // Bodies that are in the scene and sound: swept bounds, without copies and without the mark of inactive ones, and masses at
    // the present orientation (compute_bounds). Marks: 1 if contacts of the body are to be predicted.
    void (*bound)(const WideTables&, std::size_t first, std::size_t last);
    // Pairs whose contacts of the last step may persist: makes those persistent that do (match_pairs), with their manifolds
    // (collide_persistent).
    void (*keep)(const WideTables&, std::size_t first, std::size_t last);
    // Pairs of a type up to PAIR_BOX_PLANE, but for those of boxes: their manifolds (collide), those of parts relative to the
    // part.
    void (*collide)(const WideTables&, std::uint32_t pair_type, std::size_t first, std::size_t last);
    // Pairs of boxes: their separating axes and margins (collide).
    void (*separate_boxes)(const WideTables&, std::size_t first, std::size_t last);
    // Pairs of boxes that are not apart: their manifolds (collide), those of parts relative to the part.
    void (*collide_boxes)(const WideTables&, std::size_t first, std::size_t last);
    // Constraints of contacts that have none yet (point count 0) and the first warm start (prepare_contacts). With
    // `warm_starts` of all contacts, and what they take from the last step (warm_start_contacts).
    void (*prepare)(const WideTables&, std::size_t first, std::size_t last);
    // Contacts whose bodies may attract each other: adds that to the slots (apply_cohesion).
    void (*attract)(const WideTables&, std::size_t first, std::size_t last);
    void (*begin)(const WideTables&, std::size_t first, std::size_t last);
    void (*solve)(const WideTables&, std::size_t first, std::size_t last);
    void (*move)(const WideTables&, std::size_t first, std::size_t last);
    void (*relax)(const WideTables&, std::size_t first, std::size_t last);
    // Movable bodies: the velocity after the last substep (end_step). Marks: bits of BodyEnd.
    void (*finish)(const WideTables&, std::size_t first, std::size_t last);
};

// Marks of bodies at the end of a step.
enum BodyEnd : unsigned { carries_contacts = 1, is_unsound = 2, is_spin_limited = 4, was_fast = 8 };

// The SIMD stages of this processor with at most `most` lanes; null if there are none.
const WideStages* wide_stages(int most);

// compute/cpu/simd/simd_stages.cpp compiled for baseline vectors, AVX2, and AVX-512.
extern const WideStages wide_stages_4, wide_stages_8, wide_stages_16;

}  // namespace scree::reference
