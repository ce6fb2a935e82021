// Tables as aligned text, Markdown and CSV.
#pragma once

#include <string>
#include <vector>

#include "demos/suite/promise.h"

namespace scree::demos {

using Cells = std::vector<std::string>;

// The first row is the heading. Numeric columns are right-aligned.
std::string table(const std::vector<Cells>& rows);
std::string markdown(const std::vector<Cells>& rows);
std::string csv(const std::vector<Cells>& rows);  // RFC 4180
std::string csv_text(const std::string& text);    // a cell: in quotes where it needs them

// The rows of a verdict, ending in "pass" or "MISS"; `before` is prepended.
Cells verdict_heading(Cells before = {});
Cells verdict(const Row& row, Cells before = {});

}  // namespace scree::demos
