// variants: collide_sphere_sphere -DKIND=0 -DCOLLIDE=collide_sphere_sphere
// variants: collide_sphere_capsule -DKIND=1 -DCOLLIDE=collide_sphere_capsule
// variants: collide_sphere_box -DKIND=2 -DCOLLIDE=collide_sphere_box
// variants: collide_sphere_plane -DKIND=3 -DCOLLIDE=collide_sphere_plane
// variants: collide_capsule_capsule -DKIND=4 -DCOLLIDE=collide_capsule_capsule
// variants: collide_capsule_box -DKIND=5 -DCOLLIDE=collide_capsule_box
// variants: collide_capsule_plane -DKIND=6 -DCOLLIDE=collide_capsule_plane
// variants: collide_box_box -DKIND=7 -DCOLLIDE=collide_box_box
// variants: collide_box_plane -DKIND=8 -DCOLLIDE=collide_box_plane
// variants: collide_plane_convex -DKIND=9 -DCOLLIDE=collide_plane_convex -DWITH_HULLS
// variants: collide_convex -DKIND=10 -DCOLLIDE=collide_convex -DWITH_HULLS
// variants: collide_hull_hull -DKIND=11 -DCOLLIDE=collide_convex -DWITH_HULLS -DONLY_HULLS
// variants: collide_sphere_triangle -DKIND=12 -DCOLLIDE=collide_sphere_triangle -DWITH_HULLS
// variants: collide_convex_triangle -DKIND=13 -DCOLLIDE=collide_convex_triangle -DWITH_HULLS
// Narrowphase: the manifolds of all pairs of one pair type.
#version 460
#extension GL_GOOGLE_include_directive : require

#if KIND == 9 || KIND == 10 || KIND == 13
#define MAY_BE_SMOOTH  // either may be an ellipsoid (rolling_contact.h)
#endif

#if KIND == 0
#include "shaders/physics/collide/collide_sphere_sphere.h"
#elif KIND == 1
#include "shaders/physics/collide/collide_sphere_capsule.h"
#elif KIND == 2
#include "shaders/physics/collide/collide_sphere_box.h"
#elif KIND == 3
#include "shaders/physics/collide/collide_sphere_plane.h"
#elif KIND == 4
#include "shaders/physics/collide/collide_capsule_capsule.h"
#elif KIND == 5
#include "shaders/physics/collide/collide_capsule_box.h"
#elif KIND == 6
#include "shaders/physics/collide/collide_capsule_plane.h"
#elif KIND == 7
#include "shaders/physics/collide/collide_box_box.h"
#elif KIND == 8
#include "shaders/physics/collide/collide_box_plane.h"
#elif KIND <= 11
#include "shaders/physics/collide/collide_convex.h"
#else
#include "shaders/physics/collide/collide_triangle.h"
#endif
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/manifold.h"
#include "shaders/physics/collide/rolling_contact.h"
#ifdef WITH_HULLS
#include "shaders/stages/lib/shape_data.glsl"
#define AND_HULLS , Hulls(0u)
#else
#include "shaders/stages/lib/stage.glsl"
#define AND_HULLS
#endif
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/images.glsl"

void main() {
    uint i = thread() + COUNTED.pair_type_first[KIND];
    if (i >= COUNTED.pair_type_first[KIND + 1]) return;
    uint pair = READ_WORD(pairs_by_type, i);
    uint a = READ(pairs, pair).a, b = READ(pairs, pair).b;
    BodyProperties ta = READ(properties, a), tb = READ(properties, b);
    Pose pa = READ(poses, a), pb = READ(poses, b);
    Velocity va = READ(velocities, a), vb = READ(velocities, b);
    if (PERIODIC) {
        Image image = image_met(ta, ta.owner, tb, tb.owner);
        pb = at_image(pb, image);
        vb = at_image(vb, image);
    }
    Margin margin = margin_of(ta, va, tb, vb, pb.position - pa.position, parameters_of(ta.owner));
#ifdef MAY_BE_SMOOTH
    float ahead = time_ahead(ta, va, tb, vb, PARAMETERS);
    if (ahead > 0.0f) {
        pa = pose_ahead(pa, va, ahead);
        pb = pose_ahead(pb, vb, ahead);
    }
#endif
    // Collision functions expect the shape of the lower id first.
    bool swap = ta.shape > tb.shape;
    BodyProperties first_traits = swap ? tb : ta;
    BodyProperties second_traits = swap ? ta : tb;
    Pose first = swap ? pb : pa;
    Pose second = swap ? pa : pb;
    ManifoldBuffer touch = COLLIDE(first_traits, first, second_traits, second, greatest_margin(margin) AND_HULLS);
    if (swap) touch = flipped(touch, second.position - first.position);
#ifdef MAY_BE_SMOOTH
    if (ahead > 0.0f) touch = brought_back(touch, ta, va, tb, vb, pb.position - pa.position, ahead);
#endif
    touch = within_margin(touch, margin);
    if (a >= PARAMETERS.first_part)
        touch = from_body(touch, READ(poses, a).position - READ(poses, READ(properties, a).owner).position);
    keep_manifold(pair, touch.manifold, touch.count);
}
