// Measures as columns of numbers.
#include "demos/film/measure_columns.h"

#include <fmt/format.h>

namespace scree::demos {

namespace {

template <class Of>
void put(const Of& value, double* to) {
    if constexpr (requires { value.size(); }) {
        for (std::size_t k = 0; k < value.size(); ++k) to[k] = static_cast<double>(value[k]);
    } else if constexpr (requires { Of::length(); }) {
        for (int k = 0; k < Of::length(); ++k) to[k] = value[k];
    } else {
        *to = static_cast<double>(value);
    }
}

// One list for cells and for regions, which have all that cells have.
template <class Of>
std::vector<MeasureColumn<Of>> columns_of_cells() {
    return {{"volume", 1, [](const Of& of, double* to) { put(of.volume, to); }},
            {"solid_volume", 1, [](const Of& of, double* to) { put(of.solid_volume, to); }},
            {"solid_fraction", 1, [](const Of& of, double* to) { put(of.solid_fraction, to); }},
            {"bodies", 1, [](const Of& of, double* to) { put(of.bodies, to); }},
            {"rattlers", 1, [](const Of& of, double* to) { put(of.rattlers, to); }},
            {"coordination", 1, [](const Of& of, double* to) { put(of.coordination, to); }},
            {"coordination_without_rattlers", 1, [](const Of& of, double* to) { put(of.coordination_without_rattlers, to); }},
            {"mass", 1, [](const Of& of, double* to) { put(of.mass, to); }},
            {"velocity", 3, [](const Of& of, double* to) { put(of.velocity, to); }},
            {"temperature", 1, [](const Of& of, double* to) { put(of.temperature, to); }},
            {"stress", 9, [](const Of& of, double* to) { put(of.stress, to); }},
            {"kinetic_stress", 9, [](const Of& of, double* to) { put(of.kinetic_stress, to); }},
            {"pressure", 1, [](const Of& of, double* to) { put(of.pressure, to); }},
            {"contacts", 1, [](const Of& of, double* to) { put(of.contacts, to); }},
            {"fabric", 9, [](const Of& of, double* to) { put(of.fabric, to); }},
            {"force_mean", 1, [](const Of& of, double* to) { put(of.force_mean, to); }},
            {"force_max", 1, [](const Of& of, double* to) { put(of.force_max, to); }}};
}

}  // namespace

const std::vector<MeasureColumn<CellMeasures>>& cell_columns() {
    static const auto columns = columns_of_cells<CellMeasures>();
    return columns;
}

const std::vector<MeasureColumn<RegionMeasures>>& region_columns() {
    using Of = RegionMeasures;
    static const auto columns = [] {
        std::vector<MeasureColumn<Of>> made = columns_of_cells<Of>();
        made.insert(made.end(), {{"force_deviation", 1, [](const Of& of, double* to) { put(of.forces.deviation, to); }},
                                 {"force_skewness", 1, [](const Of& of, double* to) { put(of.forces.skewness, to); }},
                                 {"force_kurtosis", 1, [](const Of& of, double* to) { put(of.forces.kurtosis, to); }},
                                 {"diameter", 1, [](const Of& of, double* to) { put(of.diameter, to); }},
                                 {"shear_rate", 1, [](const Of& of, double* to) { put(of.shear_rate, to); }},
                                 {"inertial_number", 1, [](const Of& of, double* to) { put(of.inertial_number, to); }},
                                 {"force_counts", force_bins, [](const Of& of, double* to) { put(of.forces.counts, to); }}});
        return made;
    }();
    return columns;
}

const std::vector<MeasureColumn<GateMeasures>>& gate_columns() {
    using Of = GateMeasures;
    static const std::vector<MeasureColumn<Of>> columns{
        {"mass_flow", 1, [](const Of& of, double* to) { put(of.mass_flow, to); }},
        {"forward", 1, [](const Of& of, double* to) { put(of.forward, to); }},
        {"backward", 1, [](const Of& of, double* to) { put(of.backward, to); }},
        {"bodies_forward", 1, [](const Of& of, double* to) { put(of.bodies_forward, to); }},
        {"bodies_backward", 1, [](const Of& of, double* to) { put(of.bodies_backward, to); }},
        {"seconds", 1, [](const Of& of, double* to) { put(of.seconds, to); }}};
    return columns;
}

const std::vector<MeasureColumn<BodyLoad>>& load_columns() {
    using Of = BodyLoad;
    static const std::vector<MeasureColumn<Of>> columns{{"force", 3, [](const Of& of, double* to) { put(of.force, to); }},
                                                        {"torque", 3, [](const Of& of, double* to) { put(of.torque, to); }}};
    return columns;
}

std::string part_name(const std::string& name, std::size_t width, std::size_t part) {
    constexpr const char* axes = "xyz";
    if (width == 1) return name;
    if (width == 3) return name + "_" + axes[part];
    if (width == 9) return name + "_" + axes[part / 3] + axes[part % 3];
    return name + "_" + std::to_string(part);
}

std::vector<RegionMeasures> regions_with_all(const Measures& measures) {
    std::vector<RegionMeasures> all{measures.all};
    all.insert(all.end(), measures.regions.begin(), measures.regions.end());
    return all;
}

std::string remark_on(const RegionMeasures& all) {
    if (all.bodies == 0) return "no grains";
    if (!(all.pressure > 0)) return fmt::format("{} grains that do not press on each other: no inertial number", all.bodies);
    const double number = all.inertial_number;
    const char* regime = number < 1e-3 ? "quasi-static" : number < 0.1 ? "a dense flow" : "collisional";
    return fmt::format("inertial number {:.3g} ({}); contacts are rigid: their stiffness number is infinite, there are no waves",
                       number, regime);
}

}  // namespace scree::demos
