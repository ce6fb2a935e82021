// Measures as columns of numbers, for tables, arrays and files of other programs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compute/measures.h"

namespace scree::demos {

template <class Of>
struct MeasureColumn {
    const char* name;
    std::size_t width;  // 1, 3: x y z, 9: a tensor, row by row, or more
    void (*take)(const Of& of, double* to);
};
const std::vector<MeasureColumn<CellMeasures>>& cell_columns();
// The former, and what only regions have.
const std::vector<MeasureColumn<RegionMeasures>>& region_columns();
const std::vector<MeasureColumn<GateMeasures>>& gate_columns();
const std::vector<MeasureColumn<BodyLoad>>& load_columns();

// "stress" of width 9 is stress_xx, stress_xy and so on.
std::string part_name(const std::string& name, std::size_t width, std::size_t part);

template <class Of>
std::vector<double> values_of(const MeasureColumn<Of>& column, const std::vector<Of>& all) {
    std::vector<double> values(column.width * all.size());
    for (std::size_t i = 0; i < all.size(); ++i) column.take(all[i], values.data() + i * column.width);
    return values;
}
// All of the grains, then the regions.
std::vector<RegionMeasures> regions_with_all(const Measures& measures);

// What a summary says of them: the inertial number, and what it means for rigid contacts.
std::string remark_on(const RegionMeasures& all);

}  // namespace scree::demos
