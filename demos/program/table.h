// Tables of text in aligned columns, and the same as CSV.
#pragma once

#include <string>
#include <vector>

#include "demos/suite/promise.h"

namespace scree::demos {

using Cells = std::vector<std::string>;

// The first row is the heading. Columns that hold numbers below it stand to the right.
std::string table(const std::vector<Cells>& rows);
std::string markdown(const std::vector<Cells>& rows);
std::string csv(const std::vector<Cells>& rows);  // RFC 4180

// A promise's rows, "pass" or "MISS" at their end; `before` goes in front of each.
Cells verdict_heading(Cells before = {});
Cells verdict(const Row& row, Cells before = {});

}  // namespace scree::demos
