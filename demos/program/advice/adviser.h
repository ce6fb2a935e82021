// The adviser: says when a run shows that its settings do not suffice, and which option helps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/program/advice/burden.h"

namespace scree::demos {

struct Advice {
    std::string finding;  // what was measured
    std::string remedy;   // the options that help
};

// Looks at a world once a simulated second, and early in a run, before what cannot stand has fallen.
class Adviser {
public:
    // `commanded`: a script, events or a recording act on the world. `sees_contacts`: they are all here; who bears too much is
    // not looked for in a world on several ranks, which would bring them to each.
    Adviser(const World& world, bool commanded, bool sees_contacts = true);
    // The same for a world of a scene whose bodies come one after the other, which is not brought whole to a rank for it.
    Adviser(const World& world, const StreamedScene& scene, bool commanded, bool sees_contacts);

    void after_step(const World& world);
    int steps_to_next(const World& world) const;  // until the next look, at least 1
    // What is said at the end of a run; `last`: the world's statistics then.
    std::vector<Advice> advice(const World& world, const Statistics& last) const;

private:
    struct Sample {
        double time = 0;         // s
        double penetration = 0;  // m, greatest between bodies at rest
        double speed = 0;        // m/s, greatest
        std::size_t asleep = 0;
    };
    using VisitBody = std::function<void(const Body&)>;
    Adviser(const World& world, bool commanded, bool sees_contacts, const Scene& scene,
            const std::function<void(const VisitBody&)>& for_each_body);
    void look_at_burdens(const World& world);
    void look_at_energy(const World& world, const Statistics& statistics);
    Sample sample_of(const World& world, const Statistics& statistics) const;

    bool sees_contacts_ = true, has_springs_ = false;
    bool closed_ = false;                // nothing gives energy but gravity and springs, whose energy is counted
    double least_ = 0, moved_with_ = 0;  // energy, greatest kinetic energy, J
    double gained_ = 0, gained_at_ = 0;  // J, s
    double half_width_ = 0;              // m, median of the dynamic bodies' least half widths
    std::size_t dynamic_ = 0;
    std::uint64_t steps_between_ = 60;
    std::vector<Sample> samples_;
    std::vector<Burden> burdens_;   // at the last look
    std::optional<Burden> burden_;  // the greatest that lasted
};

}  // namespace scree::demos
