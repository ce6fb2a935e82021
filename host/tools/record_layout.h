// The records of a header that GLSL and C++ share, read from its text, and where both put their members.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree::host {

// A text that is no list of records as they are written here. The message names file, line and reason.
struct RecordError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RecordMember {
    std::string type;  // "uint", "vec3", the name of a record
    std::string name;
    std::size_t count = 0;   // of an array; 0: it is none
    std::size_t offset = 0;  // bytes
    std::size_t stride = 0;  // of an array's elements, bytes
};

struct Record {
    std::string name;
    std::vector<RecordMember> members;
    std::size_t bytes = 0;
    std::size_t alignment = 0;
};

// The structs of `text`, each of scalars, vectors, structs before it, and arrays of these, laid out by std430. Throws RecordError
// for one that C++ lays out otherwise, where every member follows the one before it at once. `path` is for messages.
std::vector<Record> records_of(const std::string& text, const std::string& path);

}  // namespace scree::host
