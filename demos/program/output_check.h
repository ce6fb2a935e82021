// Whether a file can be written, known before the work that fills it.
#pragma once

#include <string>

namespace scree::demos {

// Throws UsageError, naming the option, unless `name` can become a file; "" and "-" (the standard output) always can.
void require_writable_file(const char* option, const std::string& name);

}  // namespace scree::demos
