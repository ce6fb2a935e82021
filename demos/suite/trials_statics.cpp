// Trials of statics with friction: masonry arches stand by their thickness alone, ropes round pegs by friction.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"
#include "demos/scenes/statics.h"
#include "demos/suite/analytic_checks.h"

namespace scree::demos {

namespace {

// Displacement of a keystone, of its arch's thickness.
struct Keystone {
    std::size_t body;
    double thickness;  // m
};
double greatest_part(const Trace& trace, const std::vector<Keystone>& keystones, bool least) {
    double found = least ? 1e9 : 0;
    for (const Keystone& one : keystones) {
        const glm::dvec3 way(trace.end.at(one.body).position - trace.start.at(one.body).position);
        const double part = glm::length(way) / one.thickness;
        found = least ? std::min(found, part) : std::max(found, part);
    }
    return found;
}

}  // namespace

// A semicircular arch stands from a thickness of 0.107 of its radius on (Milankovitch 1907; Heyman, The Stone Skeleton,
// 1966). Contacts give way by millimetres, so small arches need more substeps: of radius 0.5 m, 16.
DemoScene arches(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground(0.8f));
    std::vector<Keystone> standing, falling;
    float x = 0;
    for (const float radius : {5.0f, 2.0f}) {
        float z = 0;
        for (const int stones : {9, 15}) {
            for (const float thickness : {0.125f, 0.09f}) {
                const Indices arch = add_arch(scene, {radius, thickness, stones}, {x, 0, z});
                const Keystone keystone{arch[arch.size() / 2], static_cast<double>(thickness * radius)};
                (thickness > 0.107f ? standing : falling).push_back(keystone);
                z += 3 * radius;
            }
        }
        x += 8;
    }
    const vec3 low(-6, 0, -1), high(9, 6, 50);
    Promise promise(at_most("sinking of arches 0.125 of their radius thick", 0.035, "", "way of the keystone, of its thickness",
                            [standing](const Trace& trace) { return greatest_part(trace, standing, false); }),
                    at_least("fall of arches 0.09 of their radius thick", 6, "", "way of the keystone, of its thickness",
                             [falling](const Trace& trace) { return greatest_part(trace, falling, true); }));
    return awake({std::move(scene), view_of(low, high, 30, 20), low, high, 20, std::move(promise)});
}

// Euler and Eytelwein: a rope round half a peg slips where one end pulls e^(mu pi) times as much as the other. (The
// weights are 70 and more times a link's: at a friction of 0.3 such a rope needs 16 substeps.)
DemoScene capstan(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(peg());
    Indices holding;
    std::vector<std::size_t> running;
    float z = -1.5f;
    for (const float friction : {0.1f, 0.2f}) {
        for (const double part : {0.8, 1.2}) {
            const std::size_t weight =
                add_rope(scene, {friction, part * portable::exp(std::numbers::pi * static_cast<double>(friction)), z});
            part < 1 ? holding.push_back(weight) : running.push_back(weight);
            z += 0.6f;
        }
    }
    const vec3 low(-1, -2, -2), high(1, 1, 2);
    Promise promise(
        all_stay("weights of ropes at 0.8 of e^(mu pi)", holding, 0.0008),
        at_least(
            "least rise of weights of ropes at 1.2 of e^(mu pi)", 0.3, "m", "from start to end", [running](const Trace& trace) {
                double least = 1e9;
                for (const std::size_t body : running)
                    least = std::min(least, static_cast<double>(trace.end.at(body).position.y - trace.start.at(body).position.y));
                return least;
            }));
    return awake({std::move(scene), view_of(low, high, 30, 15), low, high, 1.5f, std::move(promise)});
}

}  // namespace scree::demos
