// A USD file as the input of a run whose motion is to lie over it: its units, and where its bodies' prims are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compute/scene_file/import/import_options.h"
#include "compute/scene_file/import/solid_mass.h"

namespace scree::imports {

struct UsdBodyPrim {
    std::string path;                    // also the name of the body
    glm::dmat4 stretch{1};               // what the prim's transform has beside place and turn, m
    Placed placed;                       // of the prim at the start, in the scene
    glm::dmat4 above{1};                 // of what lies above it, at the start, in the scene
    std::size_t carrier = no_carrier;    // of the bodies, above which it lies
    bool resets = false;                 // its transform leaves out what lies above
    std::vector<std::string> instances;  // prims above it, or itself, that must cease to be instances
    std::string instancer;               // of the root of a point instancer's prototype
    std::size_t instance = 0;
    glm::dmat4 within{1};  // of the prototype's root

    static constexpr std::size_t no_carrier = static_cast<std::size_t>(-1);
};
struct UsdInstancer {
    std::string path;
    std::vector<double> positions, orientations;  // three and four of each
};
struct UsdInput {
    std::string default_prim, up_axis;
    double meters = 0.01, kilograms = 1, time_codes = 24, start = 0;  // time codes a second; that of the start
    std::vector<UsdBodyPrim> bodies;
    std::vector<UsdInstancer> instancers;
};
// Throws ImportError.
UsdInput usd_input(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace scree::imports
