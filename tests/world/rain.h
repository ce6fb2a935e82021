// A scene file whose grains rain into a box.
#pragma once

#include <string>

namespace scree::tests {

// `keys`: how many and how fast. `half`: half the width of the box, m.
inline std::string rain(const std::string& keys, float half = 0.6f) {
    const std::string h = std::to_string(half), out = std::to_string(half + 0.1f);
    const auto wall = [&](const std::string& x, const std::string& z, bool along_x) {
        return R"(, {"motion": "fixed", "shape": {"box": {"half_extents": [)" + std::string(along_x ? "2, 1, 0.1" : "0.1, 1, 2") +
               R"(]}}, "position": [)" + x + ", 1, " + z + "]}";
    };
    return R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}})" + wall(out, "0", false) + wall("-" + out, "0", false) +
           wall("0", out, true) + wall("0", "-" + out, true) +
           R"(], "grains": [{"name": "rain", "sieve": [{"size": 0.05, "passing": 0}, {"size": 0.09, "passing": 100}],
                "shapes": [{"form": {"polyhedron": {"variants": 3}}}, {"form": {"sphere": {}}}], "velocity": [0, -2, 0], )" +
           keys + R"(, "region": {"box": {"lower": [-)" + h + ", 0.9, -" + h + R"(], "upper": [)" + h + ", 1.3, " + h + "]}}}]}";
}

}  // namespace scree::tests
