// A board of eight parts, whose seams lie in its surface.
#pragma once

#include "compute/scene.h"

namespace scree::tests {

enum class Seams { flush, overlapping, askew };
// Of length 2 along x: boxes, boxes that overlap, or hulls whose ends are cut askew.
inline Compound board(Seams seams, float half_height, float half_width) {
    Compound made;
    for (int k = 0; k < 8; ++k) {
        const float from = -1 + 0.25f * static_cast<float>(k), to = from + 0.25f;
        if (seams != Seams::askew) {
            const float half = seams == Seams::flush ? 0.125f : 0.14f;
            made.parts.push_back({.shape = Box{{half, half_height, half_width}}, .position = {0.5f * (from + to), 0, 0}});
            continue;
        }
        const auto slant = [](int seam) { return seam == 0 || seam == 8 ? 0.0f : seam % 2 == 0 ? 0.05f : -0.05f; };
        Hull hull;
        for (const float y : {-half_height, half_height})
            for (const float z : {-1.0f, 1.0f}) {
                hull.points.emplace_back(from + slant(k) * z, y, z * half_width);
                hull.points.emplace_back(to + slant(k + 1) * z, y, z * half_width);
            }
        made.parts.push_back({.shape = hull});
    }
    return made;
}

}  // namespace scree::tests
