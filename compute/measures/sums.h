// Measures of what was read of a world: in a region, of all grains, on a grid, per body.
#pragma once

#include <string>
#include <vector>

#include "compute/measures.h"
#include "compute/measures/places.h"
#include "compute/measures/scan.h"

namespace scree::granular {

RegionMeasures measures_of(const Scan& scan, const MeasureShape& shape, const std::string& name);
RegionMeasures measures_of_all(const Scan& scan);
std::vector<CellMeasures> measures_of(const Scan& scan, const Cells& cells);
GrainMeasures measures_of_grains(const Scan& scan);

}  // namespace scree::granular
