// Code generation from record layouts.
#pragma once

#include <string>
#include <vector>

#include "host/tools/record_layout.h"

namespace scree::host {

// GLSL: for each record a macro SCREE_READER_RECORD(table, TEXEL) that defines `RECORD read_table(uint i)`, which
// assembles record i from texels, where TEXEL(table, k) is texel k of the table as uvec4. A texel has 16 bytes, or
// the record's size if that is smaller. Records whose size is no multiple of a texel have no reader.
std::string readers_of(const std::vector<Record>& records, const std::string& source);

// C++: SCREE_RECORDS(RECORD, MEMBER) expands RECORD(name, bytes) for each record and MEMBER(record, name, offset) for each
// member.
std::string layouts_of(const std::vector<Record>& records, const std::string& source);

}  // namespace scree::host
