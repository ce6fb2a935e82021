// Measures of a region, a grid and single grains.
//
// Stress: the mean over a region of the stress that momentum balance gives for forces along branches (Goldhirsch, Granular Matter
// 12, 2010, with the region's own indicator in place of a smooth one): (1/V) sum f l, of each branch the part within. Without a
// cut branch that is Love's and Weber's. A branch goes from one centre to the contact point and from there to the other centre;
// at a wall it ends. Coordination without rattlers: Thornton, Geotechnique 50, 2000, (2 N_c - N_1) / (N - N_0 - N_1), with walls
// as neighbours.
#include "compute/measures/sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compute/measures/fixed_sum.h"

namespace scree::granular {

using glm::dmat3;
using glm::dvec3;

namespace {

// Of a cell: what is added up.
struct CellSums {
    std::array<FixedSum, 9> stress;  // f l
    std::array<FixedSum, 6> fabric;  // n n: xx yy zz xy yz zx
    std::array<FixedSum, 6> motion;  // m v v
    std::array<FixedSum, 3> momentum;
    FixedSum solid, mass, force;
    double force_max = 0;
    std::uint64_t bodies = 0, rattlers = 0, neighbours = 0, bearing = 0, contacts = 0;

    void add(const Grain& grain, std::uint32_t all, bool rattles, const Units& units) {
        ++bodies;
        neighbours += all;
        rattlers += rattles;
        if (!rattles) bearing += all;
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
        const auto centre_of = [&](const Grain& grain) { return scan.images.nearest_to(point.position, grain.position); };
        if (const Grain* a = scan.grain(touch.a)) take(point.force, centre_of(*a), point.position);
        if (const Grain* b = scan.grain(touch.b)) take(point.force, point.position, centre_of(*b));
    }
}

// Calls take(solid) for a solid and its images in a region.
template <class Take>
void for_each_image(const Images& images, const Solid& solid, const Span& region, const Take& take) {
    images.for_each(solid.bounds, region, [&](dvec3 shift) { shift == dvec3(0) ? take(solid) : take(moved(solid, shift)); });
}

Span span_between(dvec3 from, dvec3 to) {
    return {glm::min(from, to), glm::max(from, to)};
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

}  // namespace

RegionMeasures measures_of(const Scan& scan, const MeasureShape& shape, const std::string& name) {
    const Span around = bounds_of(shape);
    const dvec3 middle = 0.5 * (around.lower + around.upper);
    Units units = scan.units;
    units.way = power_above(length_of(around.upper - around.lower));
    RegionSums sums;
    for (std::size_t i = 0; i < scan.grains.size(); ++i) {
        const Grain& grain = scan.grains[i];
        for (const Solid& solid : grain.solids)
            for_each_image(scan.images, solid, around,
                           [&](const Solid& one) { sums.cell.solid.add(volume_within(one, shape) / units.volume); });
        scan.images.for_each({grain.position, grain.position}, around, [&](dvec3 shift) {
            const dvec3 position = grain.position + shift;
            if (!holds(shape, position)) return;
            sums.cell.add(grain, scan.neighbours[i], scan.rattler[i] != 0, units);
            sums.diameter.add(diameter_of(grain) / units.diameter);
            sums.volume.add(grain.volume / units.volume);
            const double m = grain.mass / units.mass;
            const dvec3 x = (position - middle) / units.way, v = grain.velocity / units.speed;
            for (int k = 0; k < 3; ++k) sums.first[static_cast<std::size_t>(k)].add(m * x[k]);
            for (int p = 0; p < 3; ++p)
                for (int q = 0; q < 3; ++q) {
                    sums.second[static_cast<std::size_t>(3 * p + q)].add(m * x[p] * x[q]);
                    sums.cross[static_cast<std::size_t>(3 * p + q)].add(m * v[p] * x[q]);
                }
        });
    }
    for (const Touch& touch : scan.touches) {
        for_each_branch(scan, touch, [&](dvec3 force, dvec3 from, dvec3 to) {
            scan.images.for_each(span_between(from, to), around, [&](dvec3 shift) {
                const double share = share_of(shape, from + shift, to + shift);
                if (share > 0) sums.cell.add_branch(force, to - from, share, units);
            });
        });
        scan.images.for_each({touch.middle, touch.middle}, around, [&](dvec3 shift) {
            if (!holds(shape, touch.middle + shift)) return;
            sums.cell.add(touch, units);
            sums.forces.push_back(touch.force);
        });
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
    around = scan.images.cell_or(around);
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
    const Span around = cells.bounds();
    for (std::size_t i = 0; i < scan.grains.size(); ++i) {
        const Grain& grain = scan.grains[i];
        for (const Solid& solid : grain.solids)
            for_each_image(scan.images, solid, around, [&](const Solid& one) {
                cells.fill(one, [&](std::size_t cell, double volume) { sums[cell].solid.add(volume / scan.units.volume); });
            });
        scan.images.for_each({grain.position, grain.position}, around, [&](dvec3 shift) {
            if (const std::size_t cell = cells.at(grain.position + shift); cell != Cells::none)
                sums[cell].add(grain, scan.neighbours[i], scan.rattler[i] != 0, scan.units);
        });
    }
    for (const Touch& touch : scan.touches) {
        for_each_branch(scan, touch, [&](dvec3 force, dvec3 from, dvec3 to) {
            scan.images.for_each(span_between(from, to), around, [&](dvec3 shift) {
                cells.walk(from + shift, to + shift,
                           [&](std::size_t cell, double share) { sums[cell].add_branch(force, to - from, share, scan.units); });
            });
        });
        scan.images.for_each({touch.middle, touch.middle}, around, [&](dvec3 shift) {
            if (const std::size_t cell = cells.at(touch.middle + shift); cell != Cells::none) sums[cell].add(touch, scan.units);
        });
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
                const dvec3 branch = scan.images.nearest(point.position - grain->position) * (side / grain->volume);
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

}  // namespace scree::granular
