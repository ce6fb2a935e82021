// Stages over pairs, one per lane: which contacts persist, and the narrowphase of spheres, capsules, boxes and planes. For
// compute/cpu/simd/simd_stages.cpp.
#pragma once

#include "compute/cpu/simd/lane_items.h"

LAWS_BEGIN

namespace {

// A group of pairs whose contacts of the last step may persist.
struct PairGroup {
    Indices pairs;
    Bool live;
    Pair pair;
    Contact contact;  // of the last step

    SCREE_INLINE PairGroup(const WideTables& tables, std::size_t first, std::size_t last)
        : pairs(listed(tables.items, first, last)),
          live(living(first, last)),
          pair(gather<Pair>(tables.pairs, pairs)),
          contact(gather<Contact>(tables.contacts_before, Indices(pair.previous))) {}
};

// Prefetches what is read of the next group of pairs that may persist; of parts it is their own rows, not their bodies'.
SCREE_INLINE void prefetch_pairs(const WideTables& tables, std::size_t first, std::size_t last) {
    if (last < first + lanes) return;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const PairWords words(tables, tables.items[first + lane]);
        prefetch<Contact>(tables.contacts_before, words.previous);
        for (const std::uint32_t row : words.rows) {
            prefetch<BodyProperties>(tables.properties, row);
            prefetch<Pose>(tables.poses, row);
            prefetch<Velocity>(tables.velocities, row);
        }
    }
}

void keep(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    if (tables.periodic) broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        prefetch_pairs(tables, first + lanes, last);
        const PairGroup group(tables, first, last);
        const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(group.pair.a));
        const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(group.pair.b));
        const Indices a(body_of(group.pair.a, ta)), b(body_of(group.pair.b, tb));
        const Pose pose_a = gather<Pose>(tables.poses, a);
        Pose pose_b = gather<Pose>(tables.poses, b);
        Velocity velocity_b = gather<Velocity>(tables.velocities, b);
        if (tables.periodic) {
            const Image image = image_of_b(ta, tb, pose_b.position - pose_a.position, p);
            pose_b = at_image(pose_b, image);
            velocity_b = at_image(velocity_b, image);
        }
        const Bool keeps = group.live && is_persistent(group.contact, ta, pose_a, gather<Velocity>(tables.velocities, a), tb,
                                                       pose_b, velocity_b);
        if (none(keeps)) continue;
        scatter(tables.manifolds, group.pairs.only(keeps), persistent_manifold(group.contact, pose_a, pose_b));
        constexpr std::size_t words = sizeof(Pair) / sizeof(Words), at = offsetof(Pair, pair_type) / sizeof(Words);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (keeps.v[lane] == 0) continue;
            tables.pairs[words * group.pairs.of[lane] + at] = PAIR_PERSISTENT.v[lane];
            tables.point_counts[group.pairs.of[lane]] = group.contact.count.v[lane];
        }
    }
}

// A group of pairs whose bodies, or parts, the narrowphase compares.
struct TouchingGroup {
    Indices pairs;
    Bool live;
    std::size_t count;
    Pair pair;
    BodyProperties ta, tb;
    Pose pose_a, pose_b;  // of B as A meets it
    Image image;          // of B, in scenes with a periodic cell

    SCREE_INLINE TouchingGroup(const WideTables& tables, std::size_t first, std::size_t last)
        : pairs(listed(tables.items, first, last)),
          live(living(first, last)),
          count(last - first < lanes ? last - first : lanes),
          pair(gather<Pair>(tables.pairs, pairs)),
          ta(gather<BodyProperties>(tables.properties, Indices(pair.a))),
          tb(gather<BodyProperties>(tables.properties, Indices(pair.b))),
          pose_a(gather<Pose>(tables.poses, Indices(pair.a))),
          pose_b(gather<Pose>(tables.poses, Indices(pair.b))) {
        if (!tables.periodic) return;
        Parameters p;
        broadcast(tables.parameters, p);
        image = image_met(tables, ta, Indices(body_of(pair.a, ta)), tb, Indices(body_of(pair.b, tb)), p);
        pose_b = at_image(pose_b, image);
    }

    SCREE_INLINE Margin margin(const WideTables& tables, const Parameters& p) const {
        Velocity velocity_b = gather<Velocity>(tables.velocities, Indices(pair.b));
        if (tables.periodic) velocity_b = at_image(velocity_b, image);
        return margin_of(ta, gather<Velocity>(tables.velocities, Indices(pair.a)), tb, velocity_b,
                         pose_b.position - pose_a.position, p);
    }
    SCREE_INLINE void keep(const WideTables& tables, const ManifoldBuffer& touch) const {
        scatter(tables.manifolds, pairs.only(live), touch.manifold);
        for (std::size_t lane = 0; lane < count; ++lane) tables.point_counts[pairs.of[lane]] = touch.count.v[lane];
    }
};

using CollisionLaw = ManifoldBuffer(BodyProperties, Pose, BodyProperties, Pose, Float);
template <CollisionLaw law>
SCREE_INLINE void collide_by(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        const Margin margin = group.margin(tables, p);
        const Bool swaps = group.ta.shape > group.tb.shape;  // laws expect the shape of the lower id first
        const Pose front = choose_record(swaps, group.pose_b, group.pose_a),
                   back = choose_record(swaps, group.pose_a, group.pose_b);
        const ManifoldBuffer touch = law(choose_record(swaps, group.tb, group.ta), front,
                                         choose_record(swaps, group.ta, group.tb), back, greatest_margin(margin));
        group.keep(tables, within_margin(flipped(swaps, touch, back.position - front.position), margin));
    }
}
void collide(const WideTables& tables, std::uint32_t pair_type, std::size_t first, std::size_t last) {
    switch (pair_type) {
        case 0:
            return collide_by<collide_sphere_sphere>(tables, first, last);
        case 1:
            return collide_by<collide_sphere_capsule>(tables, first, last);
        case 2:
            return collide_by<collide_sphere_box>(tables, first, last);
        case 3:
            return collide_by<collide_sphere_plane>(tables, first, last);
        case 4:
            return collide_by<collide_capsule_capsule>(tables, first, last);
        case 5:
            return collide_by<collide_capsule_box>(tables, first, last);
        case 6:
            return collide_by<collide_capsule_plane>(tables, first, last);
        default:
            return collide_by<collide_box_plane>(tables, first, last);
    }
}

void separate_boxes(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        BoxPair found;
        found.margin = group.margin(tables, p);
        found.axes = box_axes(group.ta, group.pose_a, group.tb, group.pose_b, greatest_margin(found.margin));
        const Uint places = Uint(lane_numbers()) + Uint(static_cast<std::uint32_t>(first));
        scatter(tables.out, Indices(places).only(group.live), found);
    }
}

void collide_boxes(const WideTables& tables, std::size_t first, std::size_t last) {
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        const BoxPair found = gather<BoxPair>(tables.out, Indices(listed(tables.places, first, last)));
        const ManifoldBuffer touch =
            manifold_of_boxes(group.ta, group.pose_a, group.tb, group.pose_b, found.axes, greatest_margin(found.margin));
        group.keep(tables, within_margin(touch, found.margin));
    }
}

}  // namespace

LAWS_END
