// Checks that an output file can be written, before the work.
#pragma once

#include <initializer_list>
#include <string>

namespace scree::demos {

// Throws UsageError, naming the option, unless the file `name` can be created; "" and "-" (standard output) are
// valid.
void require_writable_file(const char* option, const std::string& name);

// Throws UsageError if two options name one file: the later output would replace the other.
struct NamedOutput {
    const char* option;
    std::string name;
};
void require_distinct(std::initializer_list<NamedOutput> outputs);

}  // namespace scree::demos
