// Files of decompositions made before, in the user's cache or the folder that SCREE_CACHE names.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "compute/scene/meshes/decomposition.h"

namespace scree {

// Empty: none. SCREE_CACHE=off, or no such folder is known.
std::filesystem::path decomposition_folder();

// A file is taken if its checksum, its mesh and its numbers are right, and is otherwise as good as missing.
bool take_from_cache(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted,
                     ConvexParts& made);
// Written whole or not at all. A folder that cannot be written is left alone: of the one that SCREE_CACHE names
// unusable_cache() tells.
void put_in_cache(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted,
                  const ConvexParts& made);

// Why the folder that SCREE_CACHE names keeps nothing, the first time it is asked after a file could not be put there; else
// empty.
std::string unusable_cache();

}  // namespace scree
