// Measuring a world: what is asked, gates from step to step, and loads.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "compute/measures.h"
#include "compute/measures/fixed_sum.h"
#include "compute/measures/images.h"
#include "compute/measures/places.h"
#include "compute/measures/scan.h"
#include "compute/measures/sums.h"
#include "compute/tables/state.h"
#include "compute/world.h"

namespace scree {

using glm::dvec3;
using granular::Scan;
using granular::Touch;

struct Measuring::Impl {
    MeasureRequest request;
    std::size_t copy = 0;

    // Gates: where grains were, and what has crossed since the last take().
    struct Before {
        dvec3 position{0};
        std::uint32_t generation = 0;
        bool there = false;
    };
    std::vector<Before> before;
    std::vector<std::uint32_t> generations;
    std::optional<std::uint64_t> arrangements;
    struct Crossed {
        FixedSum forward, backward;  // of masses by mass_unit
        std::uint64_t bodies_forward = 0, bodies_backward = 0;
    };
    static constexpr double mass_unit = 0x1p50;  // kg, the greatest there is
    std::vector<Crossed> crossed;
    std::uint64_t since = 0;      // steps
    std::uint64_t looked_at = 0;  // steps

    void look(const World& world);
    void cross(const Images& images, dvec3 from, dvec3 to, double mass);
    std::vector<GateMeasures> gates(const World& world);
    std::vector<BodyLoad> loads(const Scan& scan, const World& world) const;
};

void Measuring::Impl::look(const World& world) {
    const Scene& scene = world.scene();
    if (arrangements != world.arrangements()) {
        arrangements = world.arrangements();
        generations.assign(scene.bodies.size(), 0);
        for (std::size_t i = 0; i < generations.size(); ++i) {
            try {
                generations[i] = world.handle_of(i).generation;
            } catch (const std::out_of_range&) {  // removed
            }
        }
    }
    // After a return to an earlier state nothing has crossed.
    const bool goes_on = world.steps() > looked_at;
    looked_at = world.steps();
    const std::vector<BodyState> states = world.bodies();
    const std::vector<std::uint8_t> is_grain = granular::grains_among(world, states);
    const State& state = world.state();
    const Images images(scene.periodic);
    before.resize(states.size());
    const bool several = world.copies() > 1;
    const std::size_t count = world.bodies_of_copy(), first = several ? copy * count : 0;
    for (std::size_t i = first; i < (several ? first + count : states.size()); ++i) {
        const BodyState& now = states[i];
        const bool grain = is_grain[i] != 0;
        const bool same = grain && before[i].there && before[i].generation == generations[i];
        const double inverse = double{state.properties[state.row_of(i)].inverse_mass};
        if (goes_on && same && inverse > 0) {
            const dvec3 from = before[i].position, to = from + images.nearest(dvec3(now.position) - from);
            cross(images, from, to, 1 / inverse);
        }
        before[i] = {dvec3(now.position), generations[i], grain};
    }
}

void Measuring::Impl::cross(const Images& images, dvec3 from, dvec3 to, double mass) {
    for (std::size_t i = 0; i < crossed.size(); ++i) {
        const MeasureGate& gate = request.gates[i];
        const dvec3 u(gate.u), v(gate.v), centre(gate.centre), normal = glm::cross(u, v);
        const dvec3 reach = glm::abs(u) + glm::abs(v);
        images.for_each({glm::min(from, to), glm::max(from, to)}, {centre - reach, centre + reach}, [&](dvec3 shift) {
            const double a = glm::dot(normal, from + shift - centre), b = glm::dot(normal, to + shift - centre);
            if ((a < 0) == (b < 0)) return;
            const dvec3 off = from + shift + (to - from) * (a / (a - b)) - centre;
            if (std::abs(glm::dot(off, u)) > glm::dot(u, u) || std::abs(glm::dot(off, v)) > glm::dot(v, v)) return;
            (a < 0 ? crossed[i].forward : crossed[i].backward).add(mass / mass_unit);
            ++(a < 0 ? crossed[i].bodies_forward : crossed[i].bodies_backward);
        });
    }
}

std::vector<GateMeasures> Measuring::Impl::gates(const World& world) {
    std::vector<GateMeasures> told;
    for (std::size_t i = 0; i < crossed.size(); ++i) {
        GateMeasures& one = told.emplace_back();
        one.name = name_of_gate(request, i);
        one.seconds = static_cast<double>(world.steps() - std::min(since, world.steps())) / double{world.settings().rate};
        one.forward = crossed[i].forward.value() * mass_unit;
        one.backward = crossed[i].backward.value() * mass_unit;
        one.bodies_forward = crossed[i].bodies_forward;
        one.bodies_backward = crossed[i].bodies_backward;
        if (one.seconds > 0) one.mass_flow = (one.forward - one.backward) / one.seconds;
        crossed[i] = {};
    }
    since = world.steps();
    return told;
}

std::vector<BodyLoad> Measuring::Impl::loads(const Scan& scan, const World& world) const {
    const Scene& scene = world.scene();
    const std::size_t first = world.copies() > 1 ? copy * world.bodies_of_copy() : 0;
    std::vector<BodyLoad> told;
    std::map<std::size_t, std::vector<std::size_t>> asked;  // by body
    for (std::size_t i = 0; i < request.bodies.size(); ++i) {
        asked[first + request.bodies[i].body].push_back(i);
        told.push_back({name_of_load(request, i, scene), request.bodies[i].body});
    }
    const auto add = [&](std::size_t body, const Touch::Point& point, double side) {
        const auto found = asked.find(body);
        if (found == asked.end()) return;
        for (const std::size_t i : found->second) {
            const std::optional<vec3>& about = request.bodies[i].about;
            const dvec3 centre = about ? dvec3(*about) : dvec3(scan.states[body].position), force = side * point.force;
            told[i].force += force;
            told[i].torque += glm::cross(scan.images.nearest(point.position - centre), force);
        }
    };
    for (const Touch& touch : scan.touches)
        for (std::uint32_t k = 0; k < touch.count; ++k) {
            add(touch.a, touch.points[k], -1);
            add(touch.b, touch.points[k], 1);
        }
    return told;
}

Measuring::Measuring(const MeasureRequest& request, const World& world, std::size_t copy) : interior_(std::make_unique<Impl>()) {
    if (copy >= world.copies()) throw std::out_of_range("there is no copy " + std::to_string(copy));
    check_measures(request, world.scene());
    interior_->request = request;
    interior_->copy = copy;
    interior_->crossed.resize(request.gates.size());
    interior_->since = world.steps();
    after_step(world);
}
Measuring::~Measuring() = default;
Measuring::Measuring(Measuring&&) noexcept = default;
Measuring& Measuring::operator=(Measuring&&) noexcept = default;

bool Measuring::watches_steps() const {
    return !interior_->crossed.empty();
}
const MeasureRequest& Measuring::request() const {
    return interior_->request;
}
void Measuring::after_step(const World& world) {
    if (watches_steps()) interior_->look(world);
}

Measures Measuring::take(const World& world) {
    const Impl& in = *interior_;
    const Scan scan(world, in.copy);
    Measures told;
    told.step = world.steps();
    told.time = world.time();
    told.all = granular::measures_of_all(scan);
    for (std::size_t i = 0; i < in.request.regions.size(); ++i)
        told.regions.push_back(granular::measures_of(scan, in.request.regions[i].shape, name_of_region(in.request, i)));
    if (in.request.grid) {
        const Cells cells(*in.request.grid);
        told.cells = cells.count();
        told.grid = granular::measures_of(scan, cells);
    }
    told.gates = interior_->gates(world);
    told.bodies = in.loads(scan, world);
    told.grains = granular::measures_of_grains(scan);
    return told;
}

Measures measure(const World& world, const MeasureRequest& request) {
    return Measuring(request, world).take(world);
}

}  // namespace scree
