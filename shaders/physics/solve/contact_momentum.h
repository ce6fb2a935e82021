// Heavy-ball momentum on the normal impulses of contacts, from substep to substep.
//
// Static stiffness: a soft contact under a steady load gives way until the spring's bias balances the leak of its impulse
// (`impulse_scale` in contact_solver.h). So a column's sag is compliance, not lack of convergence: 7.3 mm for ten boxes at 480
// substeps a second, in proportion to the square of their number, of the substep, and to gravity, whatever the boxes' size.
// A smaller leak is stiffer, but in slow modes a contact answers as k (s + r) / (s + L), with the bias rate r and the leak L; it
// damps only while L > r, and by little; with half the leak (L < r) columns are no longer damped.
//
// Momentum (Polyak, Some methods of speeding up the convergence of iteration methods, 1964) starts each substep with the impulse
// extrapolated by `momentum` times its last change. For slow modes this divides both k and L by 1 - momentum: sag is
// unchanged, the margin between L and r grows, and a part of it pays for a smaller leak.
//
// Measured (8 substeps at 60 Hz, 20 s awake, without mass scaling; drift without and with both):
//   columns of 10, 20, 40   7.3, 29, 117 mm    4.4, 17.5, 70 mm
//   ten boxes, top x 100; x 300   142 mm; falls   82; 241 mm
//   ten boxes of 2 cm             fall            4.4 mm
//   pyramid of 465; wall of 520   48; 21 mm       31; 12 mm
//
// A body that rests on a patch much narrower than itself rocks slowly, and momentum feeds that: of 27 slabs on slender
// pillars 20 never came to rest, moving at up to 0.12 m/s (4 without momentum). So a point's momentum is scaled by its
// lever ratio, the part that rotation has in the point's inverse effective mass relative to that of translation: 3 at the
// corner of a cube, 0.03 under such a pillar. With that, as many come to rest as without momentum.
//
// Restart (O'Donoghue, Candes, Adaptive restart for accelerated gradient schemes, Found. Comput. Math. 15, 2015): after a blow
// the iteration converges in the more substeps the lighter the struck bodies are, and its impulses, kept from substep to substep,
// are a spring without damping: greatest when the heavy body has stopped, they throw it back while they fall. So a point that
// parts while the impulse of its contact falls begins the next substep with none. (Without, a box that fell upon boxes of a third
// to a hundredth of its mass left with half of its speed, though nothing was elastic. Of 120 columns of 1 to 4 light boxes or
// balls, hit by 1 to 100 times their mass at 1 to 10 m/s, the heavy body rose by 0.60 m in the mean, now by 0.090 m, and went no
// deeper. With a restart of points that part whether the impulse falls or not, it went 4 times as deep.)
#ifndef SCREE_PHYSICS_CONTACT_MOMENTUM_H
#define SCREE_PHYSICS_CONTACT_MOMENTUM_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/solve/jacobian.h"
#include "shaders/physics/solve/motion.h"

LAWS_BEGIN

CONSTANT float MOMENTUM = 0.5f;        // with 0.6 a column of 40 sways at 56 mm/s
CONSTANT float MOMENTUM_SPLIT = 4.0f;  // bodies split into more parts, as under a heap, get less
CONSTANT float LEAK_CUT = 0.8f;        // part of the momentum by which the leak is smaller; with 1 stacks creep on a turntable
// Restarts: a point that parts faster than what gravity adds to a speed in so many substeps, of a contact whose impulse falls by
// such a part of it, and by what would change the lighter body's velocity by more than gravity does in so many. With a part of 0
// or 0.02 the heavy bodies rose by 0.060 m, but columns of ten under 1,000 and 3,000 times the weight of one fell at 16 to 64
// substeps; with a threshold for the impulse in place of its fall, those under 300 times at 8.
CONSTANT float PARTING = 1.5f;
CONSTANT float FALLING = 5.0f;
CONSTANT float FALLING_PART = 0.04f;

// (r x n) . I^-1 (r x n) m of one body; 1 for a body that does not move.
LAW float lever_ratio(float inverse_effective_mass, float inverse_mass) {
    bool moves = inverse_mass > 0.0f;
    return choose(moves, (inverse_effective_mass - inverse_mass) * reciprocal(choose(moves, inverse_mass, 1.0f)), 1.0f);
}
// For a point of a contact between two split bodies; a contact of a single point does not rock.
// Without gravity nothing bears a load, and impulses have no momentum.
LAW float contact_momentum(JacobianRow row, uint points, Mass a, Mass b, Parameters parameters) {
    float lever = smaller(lever_ratio(row.inverse_effective_mass_a, a.inverse_mass),
                          lever_ratio(row.inverse_effective_mass_b, b.inverse_mass));
    float split = larger(a.split, b.split);
    float rocking = choose(points > 1u, smaller(1.0f, lever), 1.0f);
    rocking = choose(has_weight(parameters), rocking, 0.0f);
    return MOMENTUM * rocking * smaller(1.0f, MOMENTUM_SPLIT * reciprocal(split));
}

// After the relax pass: the impulses with which the next substep begins, by the momentum of each point. Impacts, new points
// and points that let go have none. `restarting`: 1 for a point that restarts if its own impulse falls, too, else 0.
LAW Impulse with_momentum(Impulse impulse, uint count, vec4 momentum, vec4 restarting) {
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < count;
        if (none(there)) break;
        float now = impulse.normal[k], before = impulse.solved_normal[k];
        bool lasts = there && impulse.impact[k] == 0.0f && now > 0.0f && before > 0.0f;
        impulse.solved_normal[k] = choose(there, now, before);
        bool restarts = restarting[k] > 0.0f && now < before;
        float next = choose(restarts, 0.0f, positive(flush_tiny(now + momentum[k] * (now - before))));
        impulse.normal[k] = choose(lasts, next, now);
    }
    return impulse;
}

LAWS_END

#endif
