// How far the hulls of parts are from the solid that they stand for.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compute/scene/meshes/convex_hull.h"
#include "compute/scene/meshes/decomposition_solid.h"
#include "compute/scene/meshes/distance_grid.h"
#include "compute/scene/meshes/solid_pieces.h"

namespace scree::decomposition {

// Counts what is done, and ends it beyond a limit.
struct TooMuch {};
constexpr std::uint64_t unlimited_effort = ~std::uint64_t{0};
class Effort {
public:
    explicit Effort(const std::function<void(double)>& tell) : tell_(tell) {}
    void limit(std::uint64_t more) { most_ = more, spent_ = 0; }
    void spend(std::uint64_t distances) {
        spent_ += distances;
        if (spent_ > most_) throw TooMuch{};
        if (tell_) tell_(share_);
    }
    void reach(double share) { share_ = share; }

private:
    std::uint64_t most_ = unlimited_effort, spent_ = 0;
    const std::function<void(double)>& tell_;
    double share_ = 0;  // of all that is to be done
};

struct Error {
    double most = 0;
    dvec3 at{0};
    bool within = false;  // of the surface's depth, not of what lies outside the solid
};

// Measures hulls against the solid.
class Judge {
public:
    Judge(const Solid& solid, double error, Effort& effort);

    // Stops beyond `enough`.
    Error of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough) const;
    // Of all hulls together: also how far the surface lies outside of all.
    double of_all(const std::vector<ConvexHull>& hulls, const std::vector<std::vector<dvec3>>& points) const;
    CuttingPlane surface_near(const dvec3& at) const;

private:
    struct Sample {
        dvec3 at, normal;
    };

    Error of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough, std::uint64_t& looked_at) const;
    double exact(const dvec3& p) const;

    const Solid& solid_;
    Effort& effort_;
    DistanceGrid grid_;
    double spacing_, owed_ = 0;
    std::vector<Sample> surface_;
};

}  // namespace scree::decomposition
