// What is generated from the layout of records.
#pragma once

#include <string>
#include <vector>

#include "host/tools/record_layout.h"

namespace scree::host {

// GLSL: for each record a macro SCREE_READER_RECORD(table, TEXEL) that defines `RECORD read_table(uint i)`, which puts record i
// together from texels, TEXEL(table, k) being texel k of the table as uvec4. Texels have 16 bytes; those of a shorter record have
// as many as it has. A record that is no number of texels long has no reader.
std::string readers_of(const std::vector<Record>& records, const std::string& source);

// C++: SCREE_RECORDS(RECORD, MEMBER) expands RECORD(name, bytes) for each record and MEMBER(record, name, offset) for each
// member.
std::string layouts_of(const std::vector<Record>& records, const std::string& source);

}  // namespace scree::host
