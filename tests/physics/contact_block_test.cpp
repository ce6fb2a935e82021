// Blocks of contacts: which contacts share one, how they are linked, and how their points share the stiffness of four.
#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "shaders/physics/contact/contact_block.h"

using namespace scree::physics;

namespace {

BodyProperties row(bool of_part, float restitution = 0) {
    BodyProperties properties{};
    properties.shape = SHAPE_BOX;
    properties.size = vec3(0.5f);
    properties.motion = MOTION_DYNAMIC | (of_part ? MOTION_OF_PART : 0u);
    properties.restitution = restitution;
    properties.shape_data = 0;
    return properties;
}

// A contact with `bearing` points that press, and others that are apart.
BlockLoad with_points(BlockLoad load, uint points, uint bearing, float impulse) {
    Constraint c{};
    c.flags = points;
    Impulse of_contact{};
    of_contact.separation = vec4(0.001f);
    for (uint k = 0; k < bearing; ++k) of_contact.normal[static_cast<int>(k)] = impulse;
    of_contact.normal_sum = static_cast<float>(bearing) * impulse;
    return with_contact(load, c, of_contact);
}

}  // namespace

TEST_CASE("contacts of parts share a block, those of whole bodies and elastic ones do not") {
    const Parameters none{};
    CHECK(shares_block(row(true), row(false), none));
    CHECK(shares_block(row(false), row(true), none));
    CHECK_FALSE(shares_block(row(false), row(false), none));
    CHECK_FALSE(shares_block(row(true, 0.3f), row(true), none));
    Parameters elastic{};
    elastic.least_restitution = 0.1f;
    CHECK_FALSE(shares_block(row(true), row(true), elastic));
}

TEST_CASE("up to four points have their whole stiffness, and more share that of four") {
    BlockLoad load = with_points(no_load(), 4, 4, 1);
    CHECK(part_of_stiffness(load) == 1.0f);
    load = with_points(load, 4, 0, 1);  // those that are apart do not count
    CHECK(part_of_stiffness(load) == 1.0f);
    for (int more = 0; more < 3; ++more) load = with_points(load, 4, 4, 2);
    CHECK(load.points == 16);
    CHECK(load.normal_sum == 4 + 3 * 8);
    CHECK(part_of_stiffness(load) == Approx(0.25f));
}

TEST_CASE("the contacts of a block are gone through from either end") {
    const std::vector<uint> numbers{8, 3, 21, 5};
    std::map<uint, Constraint> constraints;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        constraints[numbers[k]] = linked(Constraint{}, k == 0 ? 0 : numbers[k - 1], k + 1 == numbers.size() ? 0 : numbers[k + 1]);
    const auto walk = [&](uint here) {
        std::vector<uint> found;
        for (uint before = 0; here != 0 && found.size() < 9;) {
            found.push_back(here);
            const uint next = next_of_block(constraints[here], before);
            before = here;
            here = next;
        }
        return found;
    };
    CHECK(walk(8) == numbers);
    CHECK(walk(5) == std::vector<uint>(numbers.rbegin(), numbers.rend()));
    CHECK_FALSE(follows_in_block(constraints[8]));
    CHECK(follows_in_block(constraints[5]));
    CHECK_FALSE(leads_in_block(constraints[5]));
    CHECK(leads_in_block(constraints[8]));
}
