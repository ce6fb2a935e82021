// Edits of a world on several ranks that once were taken for others.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/world/heaps.h"
#include "tests/world/on_ranks.h"

using namespace scree;
using tests::Lines;

namespace {

std::string line_of_contacts(const World& world) {
    const Statistics found = world.statistics();
    return fmt::format("{} contacts, {} points, {:a} deep, {}", world.contacts().size(), found.points, found.penetration_max,
                       hash_text(world.state_hash()));
}

}  // namespace

TEST_CASE("a world on ranks keeps the contacts of all of them when all bodies are set", "[world][ranks]") {
    const Scene scene = tests::packed(60);
    const tests::TellingScript script = [&](World& world) {
        Lines lines;
        world.step(20);
        std::vector<BodyChange> changes;
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            changes.push_back({.body = body});
            if (scene.bodies[body].motion == Motion::dynamic) changes.back().angular_velocity = vec3(0, 0.1f, 0);
        }
        world.set_bodies(changes);
        lines.push_back(line_of_contacts(world));
        world.step(20);
        lines.push_back(line_of_contacts(world));
        return lines;
    };
    const Lines expected = tests::told_by_one(scene, script);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, scene, script), expected);
}

// Under the address sanitizer a look at the presence of rows that are no more ends the test; otherwise nothing shows it.
TEST_CASE("ghosts of bodies that a restore takes away are forgotten", "[world][ranks]") {
    const Scene scene = tests::packed(40);
    const tests::TellingScript script = [&](World& world) {
        Lines lines;
        world.step(3);
        const std::vector<std::byte> mark = world.save();
        std::vector<Body> more;  // in the midst of the others: ghosts
        for (std::size_t k = 1; k < 40; ++k) {
            more.push_back(scene.bodies[k]);
            more.back().position.y += 1.5f;
        }
        world.add_bodies(more);
        world.step(3);
        lines.push_back(line_of_contacts(world));
        world.restore(mark);
        world.step(3);
        lines.push_back(line_of_contacts(world));
        return lines;
    };
    const Lines expected = tests::told_by_one(scene, script);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, scene, script), expected);
}
