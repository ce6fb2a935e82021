// Checking the description of grains: ranges, the sieve curve, shapes, and what excludes one another.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compute/grains.h"
#include "compute/scene/grains/grain_shapes.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/grains.h"

namespace scree {

namespace {

constexpr std::size_t most_forms = 10000;

void check_region(const Examination& at, const GrainRegion& region) {
    const auto* box = std::get_if<GrainBox>(&region);
    for (int i = 0; box && i < 3; ++i)
        if (!(box->low[i] < box->high[i])) at.refuse("/region/box/upper", "must be above lower along each axis");
}

void check_curve(const Examination& at, const std::vector<SievePoint>& sieve) {
    if (sieve.size() < 2) at.refuse("/sieve", "a curve has at least 2 points; for grains of one size give \"size\"");
    if (sieve.size() > 100) at.refuse("/sieve", "a curve has at most 100 points");
    for (std::size_t i = 1; i < sieve.size(); ++i) {
        const std::string point = "/sieve/" + std::to_string(i);
        if (!(sieve[i].size > 1.0001f * sieve[i - 1].size)) at.refuse(point + "/size", "must be above that of the point before");
        if (sieve[i].passing < sieve[i - 1].passing) at.refuse(point + "/passing", "must not be below that of the point before");
    }
    if (sieve.front().passing != 0) at.refuse("/sieve/0/passing", "must be 0: it is the size of the smallest grains");
    if (sieve.back().passing != 100)
        at.refuse("/sieve/" + std::to_string(sieve.size() - 1) + "/passing", "must be 100: it is the size of the largest grains");
}

void check_shapes(const Examination& at, const std::vector<GrainShape>& shapes, std::size_t intervals) {
    if (shapes.size() > 32) at.refuse("/shapes", "at most 32 shapes");
    std::size_t forms = 0;
    for (const GrainShape& shape : shapes) {
        if (const auto* polyhedron = std::get_if<PolyhedronGrain>(&shape.form)) forms += polyhedron->variants;
        forms += std::holds_alternative<MeshGrain>(shape.form);
    }
    forms *= std::max<std::size_t>(intervals, 1) * hull_sizes;
    if (forms > most_forms)
        at.refuse("/shapes", "all variants in all intervals of the curve are " + std::to_string(forms) + " hulls, above " +
                                 std::to_string(most_forms) + "; have fewer variants");
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const auto* mesh = std::get_if<MeshGrain>(&shapes[i].form);
        if (!mesh) continue;
        const std::string form = "/shapes/" + std::to_string(i) + "/form/mesh";
        if (mesh->points.size() < 4)
            at.refuse(form,
                      mesh->file.empty() ? "needs a file, or at least 4 points" : "\"" + mesh->file + "\" has not been read");
        for (std::size_t k = 0; k < mesh->points.size(); ++k)
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(mesh->points[k][axis]) <= 1e5f))
                    at.refuse(form + "/points/" + std::to_string(k), "must be within 100000 m of 0");
    }
}

void check_description(const Examination& at, Grains grains) {
    schema::check_fields(at, grains);
    if (grains.sieve.empty() == (grains.size == 0))
        at.refuse("", "needs either \"sieve\", a curve, or \"size\", that of all grains");
    if (!grains.sieve.empty()) check_curve(at, grains.sieve);
    check_shapes(at, grains.shapes, grains.sieve.empty() ? 1 : grains.sieve.size() - 1);
    check_region(at, grains.region);
    if ((grains.mass > 0) + (grains.count > 0) + (grains.fill > 0) != 1)
        at.refuse("", "needs exactly one of \"mass\", \"count\" and \"fill\", above 0");
    if (grains.mass_rate > 0 && grains.count_rate > 0) at.refuse("/count_rate", "there is a mass_rate already; leave one out");
    if (grains.poured() && grains.fill > 0)
        at.refuse("/fill", "is of grains that are there at the start; poured ones have a mass or a count");
    if (!grains.poured() && grains.from > 0) at.refuse("/from", "is of poured grains");
}

}  // namespace

void check_grains(const Grains& grains, const std::string& place) {
    const Examination root;
    check_description(root.part(place), grains);
}

}  // namespace scree
