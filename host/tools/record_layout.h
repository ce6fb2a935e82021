// std430 layouts of the records in a header that GLSL and C++ share, parsed from its text.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree::host {

// A header that does not parse as a list of records. The message names file, line and reason.
struct RecordError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RecordMember {
    std::string type;  // "uint", "vec3", or the name of a record
    std::string name;
    std::size_t count = 0;   // array length; 0: no array
    std::size_t offset = 0;  // bytes
    std::size_t stride = 0;  // array stride, bytes
};

struct Record {
    std::string name;
    std::vector<RecordMember> members;
    std::size_t bytes = 0;
    std::size_t alignment = 0;
};

// Adds the structs of `text`, whose members are scalars, vectors, earlier structs and arrays of these, laid out by std430.
// Throws RecordError for a struct whose std430 layout has implicit padding, which C++ would lay out differently.
// `path` is for messages.
void add_records(std::vector<Record>& records, const std::string& text, const std::string& path);

}  // namespace scree::host
