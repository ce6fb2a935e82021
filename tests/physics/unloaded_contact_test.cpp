// Unloaded contacts (contact_solver.h): what SIMD lanes leave out of a pass changes nothing.
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <glm/geometric.hpp>

#include "shaders/physics/contact/contact_pass.h"
#include "shaders/physics/contact/contact_preparation.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

Parameters parameters_of(bool weight) {
    Parameters p{};
    p.h = 1.0f / 480;
    p.dt = 1.0f / 60;
    p.inverse_h = 480;
    p.gravity = vec3(0, weight ? -9.81f : 0.0f, 0);
    p.bias_rate = 30;
    p.mass_scale = 0.9f;
    p.impulse_scale = 0.1f;
    p.push_speed = 3;
    p.inverse_relaxation = 1 / 1.5f;
    p.restitution_threshold = 0.1f;
    p.max_spin = 100;
    return p;
}

struct Meeting {
    Constraint c;
    Impulse impulse;
    VelocityPair v;
    Mass a, b;
};
Meeting random_meeting(tests::Noise& noise) {
    Meeting made;
    const auto one_in = [&](int n) { return noise() > 1 - 2.0f / static_cast<float>(n); };
    const vec3 offset = noise.vector() + vec3(0, 2, 0);
    Contact contact{};
    contact.count = static_cast<uint>(2.5f + 1.9f * noise());
    contact.normal = unit3(noise.vector(), vec3(0, 1, 0));
    contact.center_offset = offset;
    made.c = idle_constraint(contact);
    made.c.friction = 0.5f + 0.5f * noise();
    made.c.restitution = one_in(3) ? 0.5f + 0.5f * noise() : 0.0f;
    made.c.rolling_resistance = one_in(3) ? 0.05f : 0.0f;
    made.c.twist_arm = one_in(2) ? 0.2f : 0.0f;
    made.c.slide_limit = one_in(8) ? 0.0f : 0.3f;
    if (one_in(2)) made.c.flags |= CONSTRAINT_ON_B;
    made.c.points_u = vec4{noise(), noise(), noise(), noise()};
    made.c.points_v = vec4{noise(), noise(), noise(), noise()};
    made.c.centre = noise.vector();
    made.impulse = no_impulse(offset);
    made.impulse.separation = vec4(0.006f) + 0.01f * vec4{noise(), noise(), noise(), noise()};
    if (one_in(4)) {  // two round bodies, moved since the constraint was made
        made.c.flags = 1 | CONSTRAINT_ROUND;
        made.c.radius_a = 0.2f;
        made.c.radius_b = 0.4f;
        made.c.points_u = vec4(0.1f * noise.vector(), 0.0f);
        const vec3 way = unit3(contact.normal + 0.5f * noise.vector(), contact.normal);
        made.c.centre = round_centre_of_a(made.c) + way * (0.606f + 0.01f * noise()) - offset;
        made.impulse.separation.x = round_gap(made.c, offset);
    }
    if (one_in(4)) made.c.flags |= CONSTRAINT_ROLLS_ONLY;
    if (one_in(4)) made.c.static_friction = 1;
    if (one_in(4)) made.c.tyre_slip = 0.1f;
    if (one_in(4)) {
        made.c.drive1 = noise();
        made.c.drive2 = noise();
    }
    made.impulse.slide_distance = 0.1f + 0.1f * noise();
    const float speed = one_in(2) ? 0.01f : 5.0f;
    made.v.a.linear = speed * noise.vector();
    made.v.a.angular = speed * noise.vector();
    made.v.b.linear = speed * noise.vector();
    made.v.b.angular = speed * noise.vector();
    for (Mass* mass : {&made.a, &made.b}) {
        *mass = {};
        if (mass == &made.a && one_in(4)) continue;  // a body that does not move
        mass->inverse_mass = 1.1f + noise();
        mass->xx = mass->yy = mass->zz = 5.1f + 5 * noise();
    }
    made.a.split = 2 + noise();
    made.b.split = 2 + noise();
    return made;
}

template <class Record>
bool same_bits(const Record& a, const Record& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
// Zeros of either sign: what a pass adds to -0 may be +0, and the difference is +0 all the same.
bool same_values(const VelocityPair& a, const VelocityPair& b) {
    return a.a.linear == b.a.linear && a.a.angular == b.a.angular && a.b.linear == b.b.linear && a.b.angular == b.b.angular;
}
bool is_zero(const VelocityPair& share) {
    const vec3 zero(0);
    return same_bits(share.a.linear, zero) && same_bits(share.a.angular, zero) && same_bits(share.b.linear, zero) &&
           same_bits(share.b.angular, zero);
}

// Contacts by their fate, with one of round bodies or not.
struct Tally {
    std::array<int, 2> kept{}, loaded{}, doubted{};
    static void add(const Constraint& c, std::array<int, 2>& of) { ++of[is_of_round_bodies(c)]; }
    void check() const {
        for (const std::size_t round : {0u, 1u}) {
            CAPTURE(round, kept[round], loaded[round], doubted[round]);
            CHECK(kept[round] > 1000);
            CHECK(loaded[round] > 1000);
            CHECK(doubted[round] < (kept[round] + loaded[round]) / 4);  // those that penetrate and part, or are gone
        }
    }
};

}  // namespace

TEST_CASE("an unloaded contact that nothing may load changes nothing in the biased pass", "[unloaded]") {
    tests::Noise noise(5);
    Tally tally;
    for (int i = 0; i < 40000; ++i) {
        const Parameters p = parameters_of(i % 4 != 0);
        const Meeting m = random_meeting(noise);
        const BiasedOutcome after = biased_pass(m.c, m.impulse, m.v, {m.a, m.b, m.v, 1}, no_impact_context(), p);
        const bool stays = same_bits(after.impulse, m.impulse) && same_values(after.velocity, m.v);
        if (may_load_biased(m.c, m.impulse, m.v, p)) {
            tally.add(m.c, stays ? tally.doubted : tally.loaded);
            continue;
        }
        INFO("contact " << i);
        REQUIRE(stays);
        REQUIRE(is_zero(after.share));
        REQUIRE(after.impact_weight == 0);
        REQUIRE(after.debt == 0);
        tally.add(m.c, tally.kept);
    }
    tally.check();
}

TEST_CASE("an unloaded contact that nothing may load changes in the relax pass by the motion alone", "[unloaded]") {
    tests::Noise noise(6);
    Tally tally;
    for (int i = 0; i < 40000; ++i) {
        const Parameters p = parameters_of(i % 4 != 0);
        const Meeting m = random_meeting(noise);
        const RelaxOutcome after = relax_pass(m.c, m.impulse, m.v, {m.a, m.b, m.v, 1}, no_impact_context(), i % 8 == 0, p);
        const Impulse moved = after_motion(m.c, m.impulse, m.v, p);
        const bool stays = same_bits(after.impulse, moved) && same_values(after.velocity, m.v) && after.counts == 0;
        if (may_load_relaxed(m.c, moved, m.v, p)) {
            tally.add(m.c, stays ? tally.doubted : tally.loaded);
            continue;
        }
        INFO("contact " << i);
        REQUIRE(stays);
        REQUIRE(is_zero(after.share));
        tally.add(m.c, tally.kept);
    }
    tally.check();
}
