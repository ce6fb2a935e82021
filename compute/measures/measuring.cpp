// Measures of granular media: stress after Love and Weber, fabric, coordination after Thornton, temperature, flow.
//
// Stress: the mean over a region of the stress that momentum balance gives for forces along branches (Goldhirsch, Granular Matter
// 12, 2010, with the region's own indicator in place of a smooth one): (1/V) sum f l, of each branch the part within. Without a
// cut branch that is Love's and Weber's. A branch goes from one centre to the contact point and from there to the other centre;
// at a wall it ends. Coordination without rattlers: Thornton, Geotechnique 50, 2000, (2 N_c - N_1) / (N - N_0 - N_1), with walls
// as neighbours.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "compute/measures.h"
#include "compute/measures/fixed_sum.h"
#include "compute/measures/places.h"
#include "compute/measures/solid.h"
#include "compute/scene/portable_math.h"
#include "compute/tables/state.h"
#include "compute/world.h"

namespace scree {

namespace {

using glm::dmat3;
using glm::dvec3;

double length_of(dvec3 v) {
    return std::sqrt(glm::dot(v, v));
}

struct Grain {
    std::size_t body = 0;
    dvec3 position{0}, velocity{0};
    double mass = 0, volume = 0;  // kg, m^3
    std::vector<Solid> solids{};
};

// A contact that presses.
struct Touch {
    std::size_t a = 0, b = 0;
    dvec3 normal{0}, middle{0};
    double force = 0;  // normal, N
    struct Point {
        dvec3 position{0}, force{0};  // on b
    };
    std::array<Point, 4> points{};
    std::uint32_t count = 0;
};

// Units that make every term at most 1, powers of two: what they divide stays exact.
struct Units {
    double force = 1, branch = 1, mass = 1, speed = 1, way = 1, volume = 1, diameter = 1;
};

constexpr std::size_t no_grain = static_cast<std::size_t>(-1);

// All that is read of a world at a moment.
struct Scan {
    std::vector<Grain> grains;
    std::vector<std::size_t> grain_of;  // by body
    std::vector<BodyState> states;
    std::vector<Touch> touches;
    std::vector<std::uint32_t> neighbours, bearing;  // by grain: all, and those that are no rattlers
    std::vector<std::uint8_t> rattler;
    Units units;

    Scan(const World& world, std::size_t copy);
    const Grain* grain(std::size_t body) const { return grain_of[body] == no_grain ? nullptr : &grains[grain_of[body]]; }

private:
    void take_grains(const World& world, std::size_t first, std::size_t last);
    void take_touches(const World& world, std::size_t first, std::size_t last);
    void count_neighbours();
    void choose_units();
};

Touch touch_of(const ContactState& contact) {
    Touch touch{contact.a, contact.b, dvec3(contact.normal)};
    touch.count = contact.count;
    for (std::uint32_t k = 0; k < contact.count; ++k) touch.force += double{contact.points[k].force};
    if (!(touch.force > 0)) return touch;
    for (std::uint32_t k = 0; k < contact.count; ++k) {
        const ContactState::Point& point = contact.points[k];
        // Friction acts on the patch as a whole: each point has as much of it as of the normal force.
        const double share = double{point.force} / touch.force;
        touch.points[k] = {dvec3(point.position), touch.normal * double{point.force} + dvec3(contact.friction) * share};
        touch.middle += dvec3(point.position) * share;
    }
    return touch;
}

void Scan::take_grains(const World& world, std::size_t first, std::size_t last) {
    const Scene& scene = world.scene();
    const State& state = world.state();
    states = world.bodies();
    grain_of.assign(scene.bodies.size(), no_grain);
    for (std::size_t i = first; i < last; ++i) {
        const Body& body = scene.bodies[i];
        const BodyState& now = states[i];
        if (body.motion != Motion::dynamic || body.role != Role::solid || !now.exists || now.quarantined) continue;
        Grain grain{i, dvec3(now.position), dvec3(now.velocity)};
        grain.solids = solids_of(body, grain.position, now.orientation);
        if (grain.solids.empty()) continue;
        for (const Solid& solid : grain.solids) grain.volume += solid.volume;
        const double inverse = double{state.properties[state.row_of(i)].inverse_mass};
        grain.mass = inverse > 0 ? 1 / inverse : 0;
        grain_of[i] = grains.size();
        grains.push_back(std::move(grain));
    }
}

void Scan::take_touches(const World& world, std::size_t first, std::size_t last) {
    for (const ContactState& contact : world.contacts()) {
        if (contact.a < first || contact.a >= last) continue;
        if (grain_of[contact.a] == no_grain && grain_of[contact.b] == no_grain) continue;
        Touch touch = touch_of(contact);
        if (touch.force > 0) touches.push_back(touch);
    }
}

void Scan::count_neighbours() {
    // Contacts of two bodies follow each other.
    const auto for_each_pair = [&](const auto& take) {
        for (std::size_t i = 0; i < touches.size(); ++i) {
            const Touch& one = touches[i];
            if (i > 0 && touches[i - 1].a == one.a && touches[i - 1].b == one.b) continue;
            take(grain_of[one.a], grain_of[one.b]);
        }
    };
    neighbours.assign(grains.size(), 0);
    for_each_pair([&](std::size_t a, std::size_t b) {
        if (a != no_grain) ++neighbours[a];
        if (b != no_grain) ++neighbours[b];
    });
    rattler.assign(grains.size(), 0);
    for (std::size_t i = 0; i < grains.size(); ++i) rattler[i] = neighbours[i] < 2;
    bearing.assign(grains.size(), 0);
    for_each_pair([&](std::size_t a, std::size_t b) {
        const auto bears = [&](std::size_t grain) { return grain == no_grain || !rattler[grain]; };
        if (a != no_grain && bears(b)) ++bearing[a];
        if (b != no_grain && bears(a)) ++bearing[b];
    });
}

double diameter_of(const Grain& grain) {
    return portable::cbrt(6 * grain.volume / std::numbers::pi);
}

void Scan::choose_units() {
    double force = 0, branch = 0, mass = 0, speed = 0, volume = 0, diameter = 0;
    for (const Touch& touch : touches)
        for (std::uint32_t k = 0; k < touch.count; ++k) {
            force = std::max({force, length_of(touch.points[k].force), touch.force});
            for (const std::size_t body : {touch.a, touch.b})
                if (const Grain* one = grain(body))
                    branch = std::max(branch, length_of(touch.points[k].position - one->position));
        }
    for (const Grain& one : grains) {
        mass = std::max(mass, one.mass);
        speed = std::max(speed, length_of(one.velocity));
        volume = std::max(volume, one.volume);
        diameter = std::max(diameter, diameter_of(one));
    }
    units = {power_above(force),  power_above(branch),  power_above(mass), power_above(speed), 1,
             power_above(volume), power_above(diameter)};
}

Scan::Scan(const World& world, std::size_t copy) {
    const bool several = world.copies() > 1;
    const std::size_t count = world.bodies_of_copy();
    const std::size_t first = several ? copy * count : 0, last = several ? first + count : world.scene().bodies.size();
    take_grains(world, first, last);
    take_touches(world, first, last);
    count_neighbours();
    choose_units();
}

// Of a cell: what is added up.
struct CellSums {
    std::array<FixedSum, 9> stress;  // f l
    std::array<FixedSum, 6> fabric;  // n n: xx yy zz xy yz zx
    std::array<FixedSum, 6> motion;  // m v v
    std::array<FixedSum, 3> momentum;
    FixedSum solid, mass, force;
    double force_max = 0;
    std::uint64_t bodies = 0, rattlers = 0, neighbours = 0, bearing = 0, contacts = 0;

    void add(const Grain& grain, std::uint32_t all, std::uint32_t bears, bool rattles, const Units& units) {
        ++bodies;
        neighbours += all;
        rattlers += rattles;
        if (!rattles) bearing += bears;
        const double m = grain.mass / units.mass;
        const dvec3 v = grain.velocity / units.speed;
        mass.add(m);
        for (int k = 0; k < 3; ++k) {
            momentum[static_cast<std::size_t>(k)].add(m * v[k]);
            motion[static_cast<std::size_t>(k)].add(m * v[k] * v[k]);
            motion[static_cast<std::size_t>(k) + 3].add(m * v[k] * v[(k + 1) % 3]);
        }
    }
    void add(const Touch& touch, const Units& units) {
        ++contacts;
        force.add(touch.force / units.force);
        force_max = std::max(force_max, touch.force);
        for (int k = 0; k < 3; ++k) {
            fabric[static_cast<std::size_t>(k)].add(touch.normal[k] * touch.normal[k]);
            fabric[static_cast<std::size_t>(k) + 3].add(touch.normal[k] * touch.normal[(k + 1) % 3]);
        }
    }
    void add_branch(dvec3 f, dvec3 branch, double share, const Units& units) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                stress[static_cast<std::size_t>(3 * i + j)].add(f[i] / units.force * (branch[j] / units.branch) * share);
    }
    void tell(CellMeasures& told, double volume, const Units& units) const;
};

Tensor symmetric(const std::array<double, 6>& of) {  // xx yy zz xy yz zx
    return {of[0], of[3], of[5], of[3], of[1], of[4], of[5], of[4], of[2]};
}

void CellSums::tell(CellMeasures& told, double volume, const Units& units) const {
    told.volume = volume;
    told.solid_volume = solid.value() * units.volume;
    told.bodies = bodies;
    told.rattlers = rattlers;
    told.contacts = contacts;
    told.mass = mass.value() * units.mass;
    told.force_max = force_max;
    if (bodies > 0) told.coordination = static_cast<double>(neighbours) / static_cast<double>(bodies);
    if (bodies > rattlers)
        told.coordination_without_rattlers = static_cast<double>(bearing) / static_cast<double>(bodies - rattlers);
    std::array<double, 6> spread{};  // of m dv dv, J
    if (told.mass > 0) {
        for (std::size_t k = 0; k < 3; ++k)
            told.velocity[static_cast<int>(k)] = momentum[k].value() * units.mass * units.speed / told.mass;
        const double energy = units.mass * units.speed * units.speed;
        for (std::size_t k = 0; k < 6; ++k) {
            const int i = static_cast<int>(k % 3), j = k < 3 ? i : (i + 1) % 3;
            spread[k] = motion[k].value() * energy - told.mass * told.velocity[i] * told.velocity[j];
        }
        told.temperature = std::max(0.0, spread[0] + spread[1] + spread[2]) / (3 * told.mass);
    }
    if (contacts > 0) {
        std::array<double, 6> mean{};
        for (std::size_t k = 0; k < 6; ++k) mean[k] = fabric[k].value() / static_cast<double>(contacts);
        told.fabric = symmetric(mean);
        told.force_mean = force.value() * units.force / static_cast<double>(contacts);
    }
    if (!(volume > 0)) return;
    told.solid_fraction = told.solid_volume / volume;
    told.kinetic_stress = symmetric(spread);
    for (std::size_t k = 0; k < 9; ++k) {
        told.kinetic_stress[k] /= volume;
        told.stress[k] = stress[k].value() * units.force * units.branch / volume + told.kinetic_stress[k];
    }
    told.pressure = (told.stress[0] + told.stress[4] + told.stress[8]) / 3;
}

// The branches of a contact: from the centre of a grain to the point, and from there to the other one's.
template <class Take>
void for_each_branch(const Scan& scan, const Touch& touch, const Take& take) {
    for (std::uint32_t k = 0; k < touch.count; ++k) {
        const Touch::Point& point = touch.points[k];
        if (const Grain* a = scan.grain(touch.a)) take(point.force, a->position, point.position);
        if (const Grain* b = scan.grain(touch.b)) take(point.force, point.position, b->position);
    }
}

// Moments of motion and force in a region, about its middle.
struct RegionSums {
    CellSums cell;
    std::array<FixedSum, 3> first;   // m x
    std::array<FixedSum, 9> second;  // m x x
    std::array<FixedSum, 9> cross;   // m v x
    FixedSum diameter, volume;       // of the grains, also of what is outside
    std::vector<double> forces;
};

dmat3 matrix_of(const std::array<FixedSum, 9>& sums, double unit) {  // rows are the first index
    dmat3 made;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) made[j][i] = sums[static_cast<std::size_t>(3 * i + j)].value() * unit;
    return made;
}

// sqrt(2 D:D) of the gradient with the least squares; 0 where the grains do not span a space.
double shear_rate_of(const RegionSums& sums, const RegionMeasures& told, const Units& units) {
    if (told.bodies < 4 || !(told.mass > 0)) return 0;
    dvec3 mean;
    for (int k = 0; k < 3; ++k) mean[k] = sums.first[static_cast<std::size_t>(k)].value() * units.mass * units.way / told.mass;
    const dmat3 spread = matrix_of(sums.second, units.mass * units.way * units.way) - told.mass * glm::outerProduct(mean, mean);
    const dmat3 cross =
        matrix_of(sums.cross, units.mass * units.speed * units.way) - told.mass * glm::outerProduct(told.velocity, mean);
    const double size = (spread[0][0] + spread[1][1] + spread[2][2]) / 3;
    if (!(glm::determinant(spread) > 1e-9 * size * size * size)) return 0;
    const dmat3 gradient = cross * glm::inverse(spread);
    dmat3 rate = 0.5 * (gradient + glm::transpose(gradient));
    const double third = (rate[0][0] + rate[1][1] + rate[2][2]) / 3;
    double squares = 0;
    for (int i = 0; i < 3; ++i) {
        rate[i][i] -= third;
        squares += glm::dot(rate[i], rate[i]);
    }
    return std::sqrt(2 * squares);
}

ForceDistribution distribution_of(const std::vector<double>& forces, double mean, double unit) {
    ForceDistribution told;
    if (forces.empty() || !(mean > 0)) return told;
    std::array<FixedSum, 3> moments;
    for (const double force : forces) {
        const double off = (force - mean) / unit;
        moments[0].add(off * off);
        moments[1].add(off * off * off);
        moments[2].add(off * off * off * off);
        const double bin = std::floor(4 * force / mean);
        ++told.counts[static_cast<std::size_t>(std::min(bin, double{force_bins - 1}))];
    }
    const auto count = static_cast<double>(forces.size());
    const double variance = moments[0].value() / count;
    told.deviation = std::sqrt(variance) * unit;
    if (!(variance > 1e-24)) return told;
    told.skewness = moments[1].value() / count / (variance * std::sqrt(variance));
    told.kurtosis = moments[2].value() / count / (variance * variance);
    return told;
}

RegionMeasures measures_of(const Scan& scan, const MeasureShape& shape, const std::string& name) {
    const Span around = bounds_of(shape);
    const dvec3 middle = 0.5 * (around.lower + around.upper);
    Units units = scan.units;
    units.way = power_above(length_of(around.upper - around.lower));
    RegionSums sums;
    for (std::size_t i = 0; i < scan.grains.size(); ++i) {
        const Grain& grain = scan.grains[i];
        for (const Solid& solid : grain.solids) sums.cell.solid.add(volume_within(solid, shape) / units.volume);
        if (!holds(shape, grain.position)) continue;
        sums.cell.add(grain, scan.neighbours[i], scan.bearing[i], scan.rattler[i] != 0, units);
        sums.diameter.add(diameter_of(grain) / units.diameter);
        sums.volume.add(grain.volume / units.volume);
        const double m = grain.mass / units.mass;
        const dvec3 x = (grain.position - middle) / units.way, v = grain.velocity / units.speed;
        for (int k = 0; k < 3; ++k) sums.first[static_cast<std::size_t>(k)].add(m * x[k]);
        for (int p = 0; p < 3; ++p)
            for (int q = 0; q < 3; ++q) {
                sums.second[static_cast<std::size_t>(3 * p + q)].add(m * x[p] * x[q]);
                sums.cross[static_cast<std::size_t>(3 * p + q)].add(m * v[p] * x[q]);
            }
    }
    for (const Touch& touch : scan.touches) {
        for_each_branch(scan, touch, [&](dvec3 force, dvec3 from, dvec3 to) {
            const double share = share_of(shape, from, to);
            if (share > 0) sums.cell.add_branch(force, to - from, share, units);
        });
        if (!holds(shape, touch.middle)) continue;
        sums.cell.add(touch, units);
        sums.forces.push_back(touch.force);
    }
    RegionMeasures told;
    told.name = name;
    sums.cell.tell(told, volume_of(shape), units);
    told.forces = distribution_of(sums.forces, told.force_mean, units.force);
    if (told.bodies == 0) return told;
    told.diameter = sums.diameter.value() * units.diameter / static_cast<double>(told.bodies);
    told.shear_rate = shear_rate_of(sums, told, units);
    const double grains = sums.volume.value() * units.volume;
    if (told.pressure > 0 && grains > 0)
        told.inertial_number = told.shear_rate * told.diameter * std::sqrt(told.mass / grains / told.pressure);
    return told;
}

RegionMeasures measures_of_all(const Scan& scan) {
    if (scan.grains.empty()) {
        RegionMeasures none;
        none.name = "all";
        return none;
    }
    constexpr double far = 1e30;
    Span around{dvec3(far), dvec3(-far)};
    for (const Grain& grain : scan.grains)
        for (const Solid& solid : grain.solids) {
            around.lower = glm::min(around.lower, solid.bounds.lower);
            around.upper = glm::max(around.upper, solid.bounds.upper);
        }
    // Outwards to floats, so that nothing sticks out.
    MeasureBox box;
    for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::nextafterf(static_cast<float>(around.lower[k]), -1e30f);
        box.upper[k] = std::nextafterf(static_cast<float>(around.upper[k]), 1e30f);
    }
    return measures_of(scan, box, "all");
}

std::vector<CellMeasures> measures_of(const Scan& scan, const Cells& cells) {
    std::vector<CellSums> sums(cells.size());
    for (std::size_t i = 0; i < scan.grains.size(); ++i) {
        const Grain& grain = scan.grains[i];
        for (const Solid& solid : grain.solids)
            cells.fill(solid, [&](std::size_t cell, double volume) { sums[cell].solid.add(volume / scan.units.volume); });
        if (const std::size_t cell = cells.at(grain.position); cell != Cells::none)
            sums[cell].add(grain, scan.neighbours[i], scan.bearing[i], scan.rattler[i] != 0, scan.units);
    }
    for (const Touch& touch : scan.touches) {
        for_each_branch(scan, touch, [&](dvec3 force, dvec3 from, dvec3 to) {
            cells.walk(from, to,
                       [&](std::size_t cell, double share) { sums[cell].add_branch(force, to - from, share, scan.units); });
        });
        if (const std::size_t cell = cells.at(touch.middle); cell != Cells::none) sums[cell].add(touch, scan.units);
    }
    std::vector<CellMeasures> told(cells.size());
    for (std::size_t i = 0; i < told.size(); ++i) sums[i].tell(told[i], cells.volume(), scan.units);
    return told;
}

GrainMeasures measures_of_grains(const Scan& scan) {
    GrainMeasures told;
    const std::size_t bodies = scan.grain_of.size();
    told.coordination.assign(bodies, 0);
    told.rattler.assign(bodies, 0);
    told.stress.assign(bodies, Tensor{});
    for (std::size_t i = 0; i < scan.grains.size(); ++i) {
        told.coordination[scan.grains[i].body] = scan.neighbours[i];
        told.rattler[scan.grains[i].body] = scan.rattler[i];
    }
    for (const Touch& touch : scan.touches) {  // in the order of bodies and parts
        for (std::uint32_t k = 0; k < touch.count; ++k) {
            const Touch::Point& point = touch.points[k];
            const auto add = [&](std::size_t body, double side) {
                const Grain* grain = scan.grain(body);
                if (!grain) return;
                const dvec3 branch = (point.position - grain->position) * (side / grain->volume);
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        told.stress[body][static_cast<std::size_t>(3 * i + j)] += point.force[i] * branch[j];
            };
            add(touch.a, 1);
            add(touch.b, -1);
        }
    }
    return told;
}

}  // namespace

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
    void cross(dvec3 from, dvec3 to, double mass);
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
    const State& state = world.state();
    before.resize(states.size());
    const bool several = world.copies() > 1;
    const std::size_t count = world.bodies_of_copy(), first = several ? copy * count : 0;
    for (std::size_t i = first; i < (several ? first + count : states.size()); ++i) {
        const BodyState& now = states[i];
        const bool grain =
            scene.bodies[i].motion == Motion::dynamic && scene.bodies[i].role == Role::solid && now.exists && !now.quarantined;
        const bool same = grain && before[i].there && before[i].generation == generations[i];
        const double inverse = double{state.properties[state.row_of(i)].inverse_mass};
        if (goes_on && same && inverse > 0) cross(before[i].position, dvec3(now.position), 1 / inverse);
        before[i] = {dvec3(now.position), generations[i], grain};
    }
}

void Measuring::Impl::cross(dvec3 from, dvec3 to, double mass) {
    for (std::size_t i = 0; i < crossed.size(); ++i) {
        const MeasureGate& gate = request.gates[i];
        const dvec3 u(gate.u), v(gate.v), centre(gate.centre), normal = glm::cross(u, v);
        const double a = glm::dot(normal, from - centre), b = glm::dot(normal, to - centre);
        if ((a < 0) == (b < 0)) continue;
        const dvec3 off = from + (to - from) * (a / (a - b)) - centre;
        if (std::abs(glm::dot(off, u)) > glm::dot(u, u) || std::abs(glm::dot(off, v)) > glm::dot(v, v)) continue;
        (a < 0 ? crossed[i].forward : crossed[i].backward).add(mass / mass_unit);
        ++(a < 0 ? crossed[i].bodies_forward : crossed[i].bodies_backward);
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
            told[i].torque += glm::cross(point.position - centre, force);
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
    told.all = measures_of_all(scan);
    for (std::size_t i = 0; i < in.request.regions.size(); ++i)
        told.regions.push_back(measures_of(scan, in.request.regions[i].shape, name_of_region(in.request, i)));
    if (in.request.grid) {
        const Cells cells(*in.request.grid);
        told.cells = cells.count();
        told.grid = measures_of(scan, cells);
    }
    told.gates = interior_->gates(world);
    told.bodies = in.loads(scan, world);
    told.grains = measures_of_grains(scan);
    return told;
}

Measures measure(const World& world, const MeasureRequest& request) {
    return Measuring(request, world).take(world);
}

}  // namespace scree
