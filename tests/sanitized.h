// Whether the tests and the program are built with a sanitizer: then they are slower, and memory has no limits to hold.
#pragma once

namespace scree::tests {

#ifdef SCREE_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// How much longer work may take than in a release build.
inline constexpr double slowness = sanitized ? 20 : 1;

}  // namespace scree::tests
