// Checks that an output file can be written, before the work.
#pragma once

#include <string>

namespace scree::demos {

// Throws UsageError, naming the option, unless the file `name` can be created; "" and "-" (standard output) are
// valid.
void require_writable_file(const char* option, const std::string& name);

}  // namespace scree::demos
